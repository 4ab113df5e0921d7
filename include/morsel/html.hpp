// morsel: the parts as one page that any browser opens from the disk.
#pragma once

#include <cstddef>
#include <filesystem>
#include <morsel/segment.hpp>
#include <morsel/vec3.hpp>
#include <optional>
#include <span>
#include <string>

namespace morsel {

/// What the page says and shows at first.
struct HtmlOptions {
  std::string name = {};  ///< what the page calls the shape, such as a file name; any bytes
  std::optional<double> merge_ratio =
      {};                             ///< cut shown at first, >= 1; none: the tree's natural one
  std::size_t most_points = 200'000;  ///< more are merged and the page says so, 1000 … 5'000'000

  /// Throws Error(kUsage) that names field, value and range.
  void check() const;
};

/// Whether this build holds the viewer; one made without Node.js does not.
[[nodiscard]] bool has_html_viewer() noexcept;

/// A page, UTF-8, that shows the points, (n, 3) in any unit and pose, in the colours of their parts
/// and walks through all cuts of `tree`, whose `piece_of_point` must have n values. It holds all it
/// needs and loads nothing. Points that are not finite are left out; noisy ones are shown smoothed.
/// Positions are kept to 1/65535 of the longest side of the bounding box, pieces and merges
/// exactly. The same bytes for any number of threads. Thread-safe. Cost: O(n log n); about 0.7 MB
/// and 19 bytes a point. Throws Error(kUsage) for bad options, when the sizes differ, or without a
/// viewer.
[[nodiscard]] std::string html_page(std::span<const Vec3> points, const MergeTree& tree,
                                    const HtmlOptions& options = {});

/// Writes that page, atomically. Throws as html_page, Error(kOutput).
void write_html(const std::filesystem::path& path, std::span<const Vec3> points,
                const MergeTree& tree, const HtmlOptions& options = {});

}  // namespace morsel
