// morsel matrix --database DB --output M.csv: the scores of all pairs.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <morsel/database.hpp>
#include <morsel/error.hpp>
#include <morsel/picture.hpp>
#include <string>
#include <vector>

#include "commands.hpp"
#include "options.hpp"
#include "outputs.hpp"
#include "terminal.hpp"

namespace morsel::cli {
namespace {

constexpr const char* kExamples = R"(Examples:
  morsel matrix --database shapes.db --output scores.csv
  morsel matrix --database shapes.db --output scores.csv --picture scores.png

Shapes are ordered by class, then by name. The first row and the first column hold the names.)";

struct Arguments {
  std::filesystem::path database;
  MatchOptions match;
  int threads = 0;
  Output output{"--output", {}, {".csv"}};
  Output picture{"--picture", {}, {".png"}};
};

// A field of a CSV file as RFC 4180 has it.
std::string csv_field(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  return "\"" + CLI::detail::find_and_replace(text, "\"", "\"\"") + "\"";
}

std::string csv_text(const SimilarityMatrix& matrix) {
  std::string text;
  for (const ShapeInfo& shape : matrix.shapes) text += "," + csv_field(shape.name);
  text += "\n";
  const std::size_t count = matrix.shapes.size();
  for (std::size_t row = 0; row < count; ++row) {
    text += csv_field(matrix.shapes[row].name);
    for (std::size_t column = 0; column < count; ++column) {
      text += fmt::format(",{:.6f}", matrix.scores[row * count + column]);
    }
    text += "\n";
  }
  return text;
}

int run_matrix(const Arguments& arguments) {
  arguments.match.check();
  check_outputs({arguments.output, arguments.picture}, arguments.database);
  const Database database = Database::open(arguments.database, Access::kRead);
  Task task;
  const SimilarityMatrix matrix =
      database.matrix(arguments.match, arguments.threads, &task.progress());
  if (matrix.shapes.empty()) {
    throw Error(ErrorCode::kInput, database.file().string() + ": holds no shapes yet");
  }
  task.begin_writing();
  write_text(arguments.output.path, csv_text(matrix));
  say(fmt::format("wrote {} ({} shapes)\n", arguments.output.path.string(), matrix.shapes.size()));
  if (!arguments.picture.path.empty()) {
    std::vector<std::string> names;
    for (const ShapeInfo& shape : matrix.shapes) names.push_back(shape.name);
    write_png(arguments.picture.path, draw_heat_map(matrix.scores, names));
    say(fmt::format("wrote {} (picture)\n", arguments.picture.path.string()));
  }
  return kDone;
}

}  // namespace

void add_matrix(CLI::App& app, Command& chosen) {
  CLI::App* const command = app.add_subcommand("matrix", "Score all pairs of stored shapes");
  const auto arguments = std::make_shared<Arguments>();
  add_database(*command, arguments->database);
  add_output(*command, "-o,--output", "FILE.csv (required)", arguments->output,
             "The scores, with the shapes' names in the first row and column")
      ->required();
  add_output(*command, "--picture", "FILE.png", arguments->picture, "The scores as a heat map");
  add_match_options(*command, arguments->match, {MatchMode::kRigid, MatchMode::kArticulated});
  add_threads(*command, arguments->threads, "Score");
  command->footer(kExamples);
  command->group("Look-alikes");
  command->callback(
      [arguments, &chosen] { chosen = [arguments] { return run_matrix(*arguments); }; });
}

}  // namespace morsel::cli
