// morsel import --database DB FILE: stores what morsel export wrote.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <memory>
#include <morsel/database.hpp>
#include <morsel/error.hpp>
#include <string>

#include "commands.hpp"
#include "options.hpp"
#include "terminal.hpp"

namespace morsel::cli {
namespace {

constexpr const char* kExamples = R"(Examples:
  morsel import --database copy.db shapes.jsonl
  zcat shapes.jsonl.gz | morsel import --database copy.db -

The database is made if it is not there. Shapes of the same names are replaced. All lines are
stored, or none when one is wrong.)";

struct Arguments {
  std::filesystem::path database;
  std::string file;
};

int run_import(const Arguments& arguments) {
  std::ifstream file;
  if (arguments.file != "-") {
    file.open(arguments.file, std::ios::binary);
    if (!file || std::filesystem::is_directory(arguments.file)) {
      throw Error(ErrorCode::kInput,
                  fmt::format("{}: cannot read: {}", arguments.file,
                              file ? "it is a directory" : std::strerror(errno)));
    }
  }
  Database database = Database::open(arguments.database, Access::kCreate);
  const std::size_t count = arguments.file == "-"
                                ? database.import_lines(std::cin, "standard input")
                                : database.import_lines(file, arguments.file);
  say(fmt::format("stored {}; {} shapes in all\n", count, database.size()));
  return kDone;
}

}  // namespace

void add_import(CLI::App& app, Command& chosen) {
  CLI::App* const command = app.add_subcommand("import", "Store what export wrote");
  const auto arguments = std::make_shared<Arguments>();
  command->add_option("FILE", arguments->file, "JSON lines; - is standard input")
      ->required()
      ->option_text(" ");
  add_database(*command, arguments->database);
  command->footer(kExamples);
  command->group("Database");
  command->callback(
      [arguments, &chosen] { chosen = [arguments] { return run_import(*arguments); }; });
}

}  // namespace morsel::cli
