// morsel-bench: how well and how fast morsel does.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <morsel/morsel.hpp>

#include "commands.hpp"

namespace {

constexpr int kInternalStatus = 1;
constexpr int kUsageStatus = 2;
constexpr int kInputStatus = 3;

int exit_status(morsel::ErrorCode code) {
  switch (code) {
    case morsel::ErrorCode::kUsage:
      return kUsageStatus;
    case morsel::ErrorCode::kInput:
    case morsel::ErrorCode::kOutput:
      return kInputStatus;
    default:
      return kInternalStatus;
  }
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Measures the accuracy and the speed of morsel.", "morsel-bench"};
  app.set_version_flag("--version", morsel::version());
  app.require_subcommand(1);
  morsel::bench::add_segmentation(app);
  morsel::bench::add_peers(app);
  morsel::bench::add_interior(app);
  morsel::bench::add_retrieval(app);
  morsel::bench::add_articulated(app);
  morsel::bench::add_partial(app);
  morsel::bench::add_clutter(app);
  morsel::bench::add_stability(app);
  morsel::bench::add_search(app);
  morsel::bench::add_database(app);
  morsel::bench::add_scaling(app);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : kUsageStatus;
  } catch (const morsel::Error& error) {
    fmt::print(stderr, "morsel-bench: {}\n", error.what());
    return exit_status(error.code());
  } catch (const std::exception& error) {
    fmt::print(stderr, "morsel-bench: {}\n", error.what());
    return kInternalStatus;
  }
  return 0;
}
