// morsel compare A B: how alike two shapes are, and which parts lie on which.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <morsel/database.hpp>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "commands.hpp"
#include "options.hpp"
#include "outputs.hpp"
#include "shapes.hpp"
#include "terminal.hpp"

namespace morsel::cli {
namespace {

constexpr const char* kExamples = R"(Examples:
  morsel compare cat.off dog.off                        two files
  morsel compare cat.off dog.off --picture both.png
  morsel compare cat.off paw.xyz --mode partial         where B is a piece of A
  morsel compare --database shapes.db scan.ply models/cat.off

A and B are looked up among the names in the database, if one is given, then taken as files.)";

struct Arguments {
  std::string a;
  std::string b;
  std::filesystem::path database;
  MatchOptions match;
  ReadOptions read;
  bool json = false;
  Output picture{"--picture", {}, {".png"}};
};

std::string part_list(const std::vector<int>& parts) {
  return parts.empty() ? "-" : fmt::format("{}", fmt::join(parts, " "));
}

std::string table(const Subject& a, const Subject& b, const Match& match) {
  std::string text = fmt::format("{:.3f}  {}  {} and {}{}\n\n", match.score, score_bar(match.score),
                                 a.name, b.name, match.mirrored ? ", one of them mirrored" : "");
  text += "part of A  part of B  share %\n";
  for (const MatchedPart& pair : match.matched) {
    text +=
        fmt::format("{:9}  {:9}  {:7.1f}\n", pair.target, pair.source, 100.0 * pair.contribution);
  }
  text += fmt::format("without counterpart: {} of A, {} of B\n", part_list(match.unmatched_target),
                      part_list(match.unmatched_source));
  text += "\nB onto A, row by row:\n";
  for (std::size_t row = 0; row < 4; ++row) {
    const double* const m = match.target_from_source.data() + 4 * row;
    text += fmt::format("{:12.5g} {:12.5g} {:12.5g} {:12.5g}\n", m[0], m[1], m[2], m[3]);
  }
  return text;
}

std::string json_text(const Subject& a, const Subject& b, const Match& match) {
  using Json = nlohmann::ordered_json;
  Json json;
  json["target"] = a.name;
  json["source"] = b.name;
  json.update(Json::parse(to_json(match)));
  return pretty(json);
}

int run_compare(const Arguments& arguments) {
  arguments.match.check();
  for (const std::string& input : {arguments.a, arguments.b}) {
    check_outputs({arguments.picture}, input);
  }
  std::optional<Database> database;
  if (!arguments.database.empty()) database = Database::open(arguments.database, Access::kRead);
  const Database* const stored = database ? &*database : nullptr;
  Task task;
  const Subject a = find_subject(arguments.a, stored, arguments.read, task.progress());
  const Subject b = find_subject(arguments.b, stored, arguments.read, task.progress());
  const Match result = match_subjects(a, b, arguments.match);
  task.begin_writing();
  if (!arguments.picture.path.empty()) {
    const bool partial = arguments.match.mode == MatchMode::kPartial;
    write_png(arguments.picture.path,
              partial ? draw_placed(b, {{&a, result}}) : draw_aligned(a, {{&b, result}}));
  }
  say(arguments.json ? json_text(a, b, result) : table(a, b, result));
  return kDone;
}

}  // namespace

void add_compare(CLI::App& app, Command& chosen) {
  CLI::App* const command = app.add_subcommand("compare", "Score two shapes and align them");
  const auto arguments = std::make_shared<Arguments>();
  command->add_option("A", arguments->a, "File, or name of a stored shape")
      ->required()
      ->option_text(" ");
  command->add_option("B", arguments->b, "Another")->required()->option_text(" ");
  add_database(*command, arguments->database, false);
  add_json(*command, arguments->json);
  add_output(*command, "--picture", "FILE.png", arguments->picture,
             "Both side by side, B turned onto A");
  add_comparison_options(*command, arguments->match, arguments->read);
  command->footer(kExamples);
  command->group("Look-alikes");
  command->callback(
      [arguments, &chosen] { chosen = [arguments] { return run_compare(*arguments); }; });
}

}  // namespace morsel::cli
