// morsel-bench: what is common to the reports.
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <morsel/morsel.hpp>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace morsel::bench {

/// The positions in `ids` of each category's models.
[[nodiscard]] std::map<int, std::vector<std::size_t>> group_by_category(std::span<const int> ids);

/// Mean of the two middle ones for an even number; 0 without values.
[[nodiscard]] double median(std::vector<double> values);
/// Of each value over its counterpart, of which there are as many.
[[nodiscard]] double median_ratio(std::vector<double> values, std::span<const double> to);
[[nodiscard]] double mean(std::span<const double> values);

[[nodiscard]] std::string_view verdict_name(Verdict verdict);

/// Now, in UTC, as in 2004-06-02T12:00:00Z.
[[nodiscard]] std::string utc_now();

/// Throws Error(kOutput).
void write_json(const std::filesystem::path& path, const nlohmann::ordered_json& json);

}  // namespace morsel::bench
