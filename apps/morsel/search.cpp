// morsel search --database DB QUERY: the stored shapes that look most like one.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <morsel/database.hpp>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "commands.hpp"
#include "numbers.hpp"
#include "options.hpp"
#include "outputs.hpp"
#include "shapes.hpp"
#include "terminal.hpp"

namespace morsel::cli {
namespace {

constexpr const char* kExamples = R"(Examples:
  morsel search --database shapes.db scan.ply --top 5
  morsel search --database shapes.db models/cat.off     a shape that is stored already
  morsel search --database shapes.db scan.ply --picture hits.png
  morsel search --database shapes.db limb.xyz --mode partial     what is it a piece of?
  morsel search --database shapes.db scan.ply --json | jq '.hits[0]'

QUERY is looked up among the stored names first, then taken as a file.)";

struct Arguments {
  std::filesystem::path database;
  std::string query;
  std::size_t top = 10;
  MatchOptions match;
  ReadOptions read;
  bool json = false;
  Output picture{"--picture", {}, {".png"}};
};

struct Answer {
  std::string database;
  Subject query;
  std::vector<LookAlike> hits;
  std::vector<Subject> shapes;  // of the hits
  std::vector<Match> matches;   // target: the query; in partial mode it is the source
};

// Columns as wide as their widest entry.
std::string table(const Answer& answer) {
  std::size_t widest = 4;
  for (const LookAlike& hit : answer.hits) widest = std::max(widest, hit.info.name.size());
  std::string text = fmt::format("   #  score  {:20}  {:{}}  class\n", "", "name", widest);
  for (std::size_t i = 0; i < answer.hits.size(); ++i) {
    const LookAlike& hit = answer.hits[i];
    text +=
        fmt::format("{:4}  {:.3f}  {}  {:{}}  {}\n", i + 1, hit.score, score_bar(hit.score),
                    hit.info.name, widest, hit.info.class_name.empty() ? "-" : hit.info.class_name);
  }
  return text;
}

std::string json_text(const Answer& answer, const Arguments& arguments) {
  using Json = nlohmann::ordered_json;
  Json json;
  json["query"] = answer.query.name;
  json["database"] = answer.database;
  json["method"] = arguments.match.method == Method::kPaper ? "paper" : "default";
  json["mode"] = mode_name(arguments.match.mode);
  json["hits"] = Json::array();
  for (std::size_t i = 0; i < answer.hits.size(); ++i) {
    const LookAlike& hit = answer.hits[i];
    Json entry;
    entry["rank"] = i + 1;
    entry["name"] = hit.info.name;
    entry["class"] = hit.info.class_name;
    entry["tags"] = hit.info.tags;
    entry["source"] = hit.info.source;
    entry.update(Json::parse(to_json(answer.matches[i])));
    json["hits"].push_back(std::move(entry));
  }
  return pretty(json);
}

Answer find_answer(const Arguments& arguments, const Progress& progress) {
  const Database database = Database::open(arguments.database, Access::kRead);
  Answer answer;
  answer.database = database.file().string();
  answer.query = find_subject(arguments.query, &database, arguments.read, progress);
  const bool partial = arguments.match.mode == MatchMode::kPartial;
  answer.hits = partial
                    ? database.search_partial(answer.query.sketch, arguments.top, arguments.match,
                                              arguments.read.threads, &progress)
                    : database.search(answer.query.signature, arguments.top, arguments.match);
  if (!arguments.json && arguments.picture.path.empty()) return answer;
  for (const LookAlike& hit : answer.hits) {
    answer.shapes.push_back(stored_subject(database, hit.info.name));
    const Subject& shape = answer.shapes.back();
    answer.matches.push_back(partial ? match_subjects(shape, answer.query, arguments.match)
                                     : match_subjects(answer.query, shape, arguments.match));
  }
  return answer;
}

Image draw(const Answer& answer, MatchMode mode) {
  std::vector<Aligned> others;
  for (std::size_t i = 0; i < answer.hits.size(); ++i) {
    others.push_back({&answer.shapes[i], answer.matches[i]});
  }
  return mode == MatchMode::kPartial ? draw_placed(answer.query, others)
                                     : draw_aligned(answer.query, others);
}

int run_search(const Arguments& arguments) {
  arguments.match.check();
  check_outputs({arguments.picture}, arguments.query);
  Task task;
  const Answer answer = find_answer(arguments, task.progress());
  task.begin_writing();
  if (!arguments.picture.path.empty()) {
    write_png(arguments.picture.path, draw(answer, arguments.match.mode));
  }
  say(arguments.json ? json_text(answer, arguments) : table(answer));
  return kDone;
}

}  // namespace

void add_search(CLI::App& app, Command& chosen) {
  CLI::App* const command = app.add_subcommand("search", "Find the stored shapes most like one");
  const auto arguments = std::make_shared<Arguments>();
  command->add_option("QUERY", arguments->query, "Name of a stored shape, file, or - for XYZ")
      ->required()
      ->option_text(" ");
  add_database(*command, arguments->database);
  add(*command, "--top", "K", "Show this many [10]",
      [arguments](const std::string& name, const std::string& text) {
        arguments->top = whole_number(name, text, 1, 1'000'000);
      });
  add_json(*command, arguments->json);
  add_output(*command, "--picture", "FILE.png", arguments->picture,
             "The query and what was found, side by side in one pose");
  add_comparison_options(*command, arguments->match, arguments->read);
  command->footer(kExamples);
  command->group("Look-alikes");
  command->callback(
      [arguments, &chosen] { chosen = [arguments] { return run_search(*arguments); }; });
}

}  // namespace morsel::cli
