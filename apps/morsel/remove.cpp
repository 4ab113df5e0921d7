// morsel remove --database DB NAME…: takes shapes out of a database.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <morsel/database.hpp>
#include <string>
#include <vector>

#include "commands.hpp"
#include "options.hpp"
#include "terminal.hpp"

namespace morsel::cli {
namespace {

constexpr const char* kExamples = R"(Examples:
  morsel remove --database shapes.db models/cat.off models/dog.off

All of them are removed, or none when one is not there.)";

struct Arguments {
  std::filesystem::path database;
  std::vector<std::string> names;
};

int run_remove(const Arguments& arguments) {
  Database database = Database::open(arguments.database, Access::kWrite);
  database.remove(arguments.names);
  say(fmt::format("removed {}; {} shapes are left\n", arguments.names.size(), database.size()));
  return kDone;
}

}  // namespace

void add_remove(CLI::App& app, Command& chosen) {
  CLI::App* const command = app.add_subcommand("remove", "Take shapes out of the database");
  const auto arguments = std::make_shared<Arguments>();
  command->add_option("NAME", arguments->names, "Of the shapes")->required()->option_text("...");
  add_database(*command, arguments->database);
  command->footer(kExamples);
  command->group("Database");
  command->callback(
      [arguments, &chosen] { chosen = [arguments] { return run_remove(*arguments); }; });
}

}  // namespace morsel::cli
