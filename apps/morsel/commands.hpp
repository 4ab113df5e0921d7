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

/// Adds `morsel segment` to `app`; when it is given, `chosen` becomes its work.
void add_segment(CLI::App& app, Command& chosen);

}  // namespace morsel::cli
