// morsel-bench: the subcommands; each adds itself to the program.
#pragma once

#include <CLI/CLI.hpp>

namespace morsel::bench {

void add_articulated(CLI::App& app);
void add_clutter(CLI::App& app);
void add_database(CLI::App& app);
void add_interior(CLI::App& app);
void add_partial(CLI::App& app);
void add_peers(CLI::App& app);
void add_retrieval(CLI::App& app);
void add_scaling(CLI::App& app);
void add_search(CLI::App& app);
void add_segmentation(CLI::App& app);
void add_stability(CLI::App& app);

}  // namespace morsel::bench
