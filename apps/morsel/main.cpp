// The program `morsel`: reads the command line, runs the subcommand, turns errors into a line on
// standard error and an exit status.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <memory>
#include <morsel/error.hpp>
#include <morsel/morsel.hpp>
#include <new>
#include <string>
#include <utility>
#include <vector>

#include "commands.hpp"
#include "suggest.hpp"
#include "terminal.hpp"

namespace morsel::cli {
namespace {

constexpr const char* kExamples = R"(Examples:
  morsel segment scan.ply                           show the parts of a scan
  morsel segment scan.ply -o parts.ply              write the points in their parts' colours
  morsel segment chair.off --picture chair.png      sample a mesh, draw its parts
  morsel index --database shapes.db models/         store the shapes of a folder
  morsel search --database shapes.db scan.ply       find those that look like a scan
  morsel serve --database shapes.db                 look at them in a browser

'morsel COMMAND --help' lists the options; 'man morsel' has it all.)";

// CLI11's layout without its double blank lines, and with one above the usage.
class HelpFormatter : public CLI::Formatter {
 public:
  std::string make_help(const CLI::App* app, std::string name,
                        CLI::AppFormatMode mode) const override {
    const std::string text = CLI::Formatter::make_help(app, std::move(name), mode);
    return CLI::detail::find_and_replace(text, "\n\n\n", "\n\n");
  }
  std::string make_usage(const CLI::App* app, std::string name) const override {
    return "\n" + CLI::Formatter::make_usage(app, std::move(name));
  }
};

int status_of(ErrorCode code) {
  switch (code) {
    case ErrorCode::kUsage:
      return kWrongUsage;
    case ErrorCode::kInput:
    case ErrorCode::kOutput:
    case ErrorCode::kResource:
      return kBadInput;
    case ErrorCode::kCancelled:
      return kInterrupted;
    case ErrorCode::kInternal:
      break;
  }
  return kInternalError;
}

// Where the help is that fits what was typed.
std::string help_command(const CLI::App& app) {
  const auto given = app.get_subcommands();
  return given.empty() ? "morsel --help" : "morsel " + given.front()->get_name() + " --help";
}

std::vector<std::string> names_of_options(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    for (const std::string& name : option->get_snames()) names.push_back("-" + name);
  }
  return names;
}

std::vector<std::string> names_of_commands(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
    names.push_back(command->get_name());
  }
  return names;
}

// What to say about words that no option takes, or "" when there are none.
std::string unknown_words(const CLI::App& app) {
  const auto given = app.get_subcommands();
  const CLI::App& level = given.empty() ? app : *given.front();
  const std::vector<std::string> words = level.remaining();
  if (words.empty()) return {};
  const std::string typed = words.front().substr(0, words.front().find('='));
  const bool option = typed.starts_with('-');
  const bool command = !option && given.empty();
  const char* const kind = option ? "unknown option" : command ? "unknown command" : "unexpected";
  const std::string meant = option    ? nearest_name(typed, names_of_options(level))
                            : command ? nearest_name(typed, names_of_commands(app))
                                      : std::string();
  return fmt::format("{} '{}'{}", kind, typed,
                     meant.empty() ? "" : fmt::format("; did you mean {}?", meant));
}

// Prints help and version, or the one line about what the command line has wrong.
int report(const CLI::App& app, const CLI::ParseError& error) {
  if (error.get_exit_code() == 0) {
    const auto given = app.get_subcommands();
    if (dynamic_cast<const CLI::CallForVersion*>(&error) != nullptr) {
      say(std::string(error.what()) + "\n");
    } else {
      say(given.empty() ? app.help() : given.front()->help("morsel"));
    }
    return kDone;
  }
  // A misspelt option is the cause of what it leaves missing.
  const std::string unknown = unknown_words(app);
  complain(fmt::format("{} (see '{}')", unknown.empty() ? error.what() : unknown.c_str(),
                       help_command(app)));
  return kWrongUsage;
}

int run(int argc, char** argv) {
  CLI::App app("Cuts noisy point clouds of solid objects into their parts and finds look-alikes.",
               "morsel");
  app.set_help_flag("-h,--help", "Show this help");
  app.set_version_flag(
      "--version", [] { return "morsel " + version(); }, "Show the version");
  const auto formatter = std::make_shared<HelpFormatter>();
  formatter->column_width(29);
  formatter->label("SUBCOMMAND", "COMMAND");
  formatter->label("Positionals", "Input");
  app.formatter(formatter);  // subcommands that are added from here on take it over
  app.footer(kExamples);
  app.require_subcommand(0, 1);
  Command chosen;
  for (const auto add :
       {add_segment, add_index, add_search, add_compare, add_matrix, add_serve, add_list, add_show,
        add_remove, add_rename, add_export, add_import, add_check}) {
    add(app, chosen);
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return report(app, error);
  }
  if (!chosen) {
    complain("name a command, for example 'morsel segment FILE' (see 'morsel --help')");
    return kWrongUsage;
  }
  catch_interrupts();
  return chosen();
}

}  // namespace
}  // namespace morsel::cli

int main(int argc, char** argv) {
  using morsel::cli::complain;
  try {
    return morsel::cli::run(argc, argv);
  } catch (const morsel::Error& error) {
    complain(error.what());
    return morsel::cli::status_of(error.code());
  } catch (const std::bad_alloc&) {
    complain("there is not enough memory for this input; use fewer points");
    return morsel::cli::kBadInput;
  } catch (const std::exception& error) {
    complain(fmt::format("internal error, please report it: {}", error.what()));
    return morsel::cli::kInternalError;
  }
}
