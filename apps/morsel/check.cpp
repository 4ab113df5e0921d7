// morsel check --database DB: whether a database is as it was written.
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
  morsel check --database shapes.db
  morsel check --database shapes.db --repair

Every row is read and decoded, every checksum compared. What is wrong comes on standard error, a
line each, and the exit status is 3. --repair drops the shapes that are damaged and names them;
index these again.)";

struct Arguments {
  std::filesystem::path database;
  bool repair = false;
};

void repair(const std::filesystem::path& place) {
  Database database = Database::open(place, Access::kWrite);
  for (const std::string& reason : database.repair()) complain("dropped: " + reason);
}

int run_check(const Arguments& arguments) {
  if (arguments.repair) repair(arguments.database);
  const Database database = Database::open(arguments.database, Access::kRead);
  Task task;
  const std::vector<std::string> findings = database.check(&task.progress());
  task.begin_writing();
  for (const std::string& finding : findings) complain(finding);
  if (!findings.empty()) return kBadInput;
  say(fmt::format("{}: {} shapes, nothing wrong\n", database.file().string(), database.size()));
  return kDone;
}

}  // namespace

void add_check(CLI::App& app, Command& chosen) {
  CLI::App* const command = app.add_subcommand("check", "Verify every byte of the database");
  const auto arguments = std::make_shared<Arguments>();
  add_database(*command, arguments->database);
  command->add_flag("--repair", arguments->repair, "First drop what is damaged");
  command->footer(kExamples);
  command->group("Database");
  command->callback(
      [arguments, &chosen] { chosen = [arguments] { return run_check(*arguments); }; });
}

}  // namespace morsel::cli
