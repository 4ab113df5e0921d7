// morsel export --database DB: everything in a database as JSON lines.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>
#include <memory>
#include <morsel/database.hpp>
#include <string>

#include "base/atomic_file.hpp"
#include "commands.hpp"
#include "options.hpp"
#include "outputs.hpp"
#include "terminal.hpp"

namespace morsel::cli {
namespace {

constexpr const char* kExamples = R"(Examples:
  morsel export --database shapes.db --output shapes.jsonl
  morsel export --database shapes.db | gzip > shapes.jsonl.gz

The lines hold all that the database does; docs/database.md describes them.)";

struct Arguments {
  std::filesystem::path database;
  Output output{"--output", {}, {}};
};

int run_export(const Arguments& arguments) {
  check_outputs({arguments.output}, arguments.database);
  const Database database = Database::open(arguments.database, Access::kRead);
  const Task task;
  if (arguments.output.path.empty()) {
    database.export_lines(std::cout);
    say("");  // flushes, and tells a full disk
    return kDone;
  }
  AtomicFile file(arguments.output.path);
  database.export_lines(file.stream());
  file.commit();
  say(fmt::format("wrote {} ({} shapes)\n", arguments.output.path.string(), database.size()));
  return kDone;
}

}  // namespace

void add_export(CLI::App& app, Command& chosen) {
  CLI::App* const command = app.add_subcommand("export", "Write the database as JSON lines");
  const auto arguments = std::make_shared<Arguments>();
  add_database(*command, arguments->database);
  add_output(*command, "-o,--output", "FILE", arguments->output, "Instead of standard output");
  command->footer(kExamples);
  command->group("Database");
  command->callback(
      [arguments, &chosen] { chosen = [arguments] { return run_export(*arguments); }; });
}

}  // namespace morsel::cli
