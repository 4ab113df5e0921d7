// morsel rename --database DB OLD NEW: gives a stored shape another name.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <morsel/database.hpp>
#include <string>

#include "commands.hpp"
#include "options.hpp"
#include "terminal.hpp"

namespace morsel::cli {
namespace {

constexpr const char* kExamples = R"(Examples:
  morsel rename --database shapes.db models/cat.off tom)";

struct Arguments {
  std::filesystem::path database;
  std::string from;
  std::string to;
};

int run_rename(const Arguments& arguments) {
  Database database = Database::open(arguments.database, Access::kWrite);
  database.rename(arguments.from, arguments.to);
  say(fmt::format("renamed {} to {}\n", arguments.from, arguments.to));
  return kDone;
}

}  // namespace

void add_rename(CLI::App& app, Command& chosen) {
  CLI::App* const command = app.add_subcommand("rename", "Give a stored shape another name");
  const auto arguments = std::make_shared<Arguments>();
  command->add_option("OLD", arguments->from, "Its name")->required()->option_text(" ");
  command->add_option("NEW", arguments->to, "Its name to be")->required()->option_text(" ");
  add_database(*command, arguments->database);
  command->footer(kExamples);
  command->group("Database");
  command->callback(
      [arguments, &chosen] { chosen = [arguments] { return run_rename(*arguments); }; });
}

}  // namespace morsel::cli
