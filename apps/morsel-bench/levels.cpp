#include "levels.hpp"

#include <span>
#include <utility>

#include "summary.hpp"

namespace morsel::bench {

void run_levels(const RunOptions& options, nlohmann::ordered_json report, const Evaluate& evaluate,
                const ReportLevel& report_level) {
  const std::vector<Model> models = options.models();
  const std::vector<double> levels = options.noise_levels();
  const std::size_t count = models.size();
  const std::vector<Outcome> outcomes = run_isolated(
      count * levels.size(), options.threads,
      [&](std::size_t job) { return evaluate(models[job % count], levels[job / count]); });
  for (std::size_t level = 0; level < levels.size(); ++level) {
    const auto own = std::span(outcomes).subspan(level * count, count);
    report["runs"].push_back(report_level(models, {own.begin(), own.end()}, levels[level]));
  }
  if (!options.json.empty()) write_json(options.json, report);
}

}  // namespace morsel::bench
