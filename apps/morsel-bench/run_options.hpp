// morsel-bench: the options that the subcommands over a folder of models share.
#pragma once

#include <CLI/CLI.hpp>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <morsel/morsel.hpp>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "dataset.hpp"
#include "sampling.hpp"

namespace morsel::bench {

struct RunOptions {
  std::filesystem::path folder;
  std::string ids = "all";
  std::size_t points = 20000;
  std::vector<double> noise;  ///< one run over all models each; none means 0
  double outliers = 0.0;
  double hole = 0.0;
  int threads = 2;  ///< models at a time; each model has one thread
  std::uint64_t seed = 1;
  std::string method = "default";
  std::string denoise = "auto";
  std::filesystem::path json;

  [[nodiscard]] std::vector<double> noise_levels() const;
  [[nodiscard]] CloudOptions cloud(double noise_level) const;
  /// Throws Error(kUsage).
  [[nodiscard]] SegmentOptions segment() const;
  /// Checks all options and lists the models. Throws Error(kUsage), Error(kInput).
  [[nodiscard]] std::vector<Model> models() const;
};

/// Declares the options on a subcommand; `options` outlives it.
void add_run_options(CLI::App& command, RunOptions& options);

/// Program, version, date and all options: the head of every JSON report.
[[nodiscard]] nlohmann::ordered_json report_head(const std::string& command,
                                                 const RunOptions& options);

}  // namespace morsel::bench
