// morsel-bench: one run over all models for each noise level.
#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <vector>

#include "isolated.hpp"
#include "run_options.hpp"

namespace morsel::bench {

/// What is measured on one model at one noise level; called in a child process.
using Evaluate = std::function<nlohmann::json(const Model& model, double noise)>;

/// Prints the outcomes of one noise level, one a model, and returns its entry of the report.
using ReportLevel = std::function<nlohmann::ordered_json(
    const std::vector<Model>& models, const std::vector<Outcome>& outcomes, double noise)>;

/// Evaluates all models at all levels, options.threads at a time, then reports level by level into
/// `report["runs"]` and writes the report where the options want it.
/// Throws Error(kUsage), Error(kInput), Error(kResource), Error(kOutput).
void run_levels(const RunOptions& options, nlohmann::ordered_json report, const Evaluate& evaluate,
                const ReportLevel& report_level);

}  // namespace morsel::bench
