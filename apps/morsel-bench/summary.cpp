#include "summary.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <ctime>
#include <fstream>
#include <numeric>

#include "dataset.hpp"

namespace morsel::bench {

std::map<int, std::vector<std::size_t>> group_by_category(std::span<const int> ids) {
  std::map<int, std::vector<std::size_t>> groups;
  for (std::size_t i = 0; i < ids.size(); ++i) groups[category_of(ids[i])].push_back(i);
  return groups;
}

double median(std::vector<double> values) {
  if (values.empty()) return 0.0;
  std::sort(values.begin(), values.end());
  const std::size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half] : 0.5 * (values[half - 1] + values[half]);
}

double median_ratio(std::vector<double> values, std::span<const double> to) {
  for (std::size_t i = 0; i < values.size(); ++i) values[i] /= to[i];
  return median(std::move(values));
}

double mean(std::span<const double> values) {
  if (values.empty()) return 0.0;
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

std::string_view verdict_name(Verdict verdict) {
  switch (verdict) {
    case Verdict::kSolid:
      return "solid";
    case Verdict::kTooFewPoints:
      return "too_few_points";
    case Verdict::kFlat:
      return "flat";
    case Verdict::kNotSolid:
      return "not_solid";
  }
  return "unknown";
}

std::string utc_now() {
  return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)));
}

void write_json(const std::filesystem::path& path, const nlohmann::ordered_json& json) {
  std::ofstream file(path);
  file << json.dump(2) << '\n';
  file.close();
  if (!file) {
    throw Error(ErrorCode::kOutput, fmt::format("{}: cannot be written", path.string()));
  }
}

}  // namespace morsel::bench
