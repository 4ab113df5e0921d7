// The subcommands of the program and the exit statuses that they share.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>

namespace morsel::cli {

/// What the shell gets to see; documented in docs/man/morsel.1.
enum ExitStatus : int {
  kDone = 0,
  kInternalError = 1,
  kWrongUsage = 2,
  kBadInput = 3,  ///< also an output that cannot be written, and memory that does not suffice
  kNoSolid = 4,
  kInterrupted = 130,  ///< as shells report a program that SIGINT ended
};

/// The work that the command line asks for, set while it is parsed; returns the exit status.
using Command = std::function<int()>;

/// Each adds the command of its name to `app`; when it is given, `chosen` becomes its work.
void add_segment(CLI::App& app, Command& chosen);
void add_index(CLI::App& app, Command& chosen);
void add_search(CLI::App& app, Command& chosen);
void add_compare(CLI::App& app, Command& chosen);
void add_matrix(CLI::App& app, Command& chosen);
void add_serve(CLI::App& app, Command& chosen);
void add_list(CLI::App& app, Command& chosen);
void add_show(CLI::App& app, Command& chosen);
void add_remove(CLI::App& app, Command& chosen);
void add_rename(CLI::App& app, Command& chosen);
void add_export(CLI::App& app, Command& chosen);
void add_import(CLI::App& app, Command& chosen);
void add_check(CLI::App& app, Command& chosen);

}  // namespace morsel::cli
