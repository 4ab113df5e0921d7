#include <cmath>
#include <morsel/error.hpp>
#include <morsel/html.hpp>
#include <string>
#include <string_view>

#include "base/atomic_file.hpp"
#include "html/shape_json.hpp"
#include "html/viewer.hpp"

namespace morsel {

void HtmlOptions::check() const {
  if (merge_ratio && !(*merge_ratio >= 1.0)) {
    throw Error(ErrorCode::kUsage,
                "merge_ratio is " + std::to_string(*merge_ratio) + "; it must be at least 1");
  }
  if (most_points < 1000 || most_points > 5'000'000) {
    throw Error(ErrorCode::kUsage,
                "most_points is " + std::to_string(most_points) + "; it must be 1000 to 5000000");
  }
}

bool has_html_viewer() noexcept { return !viewer_page().empty(); }

std::string html_page(std::span<const Vec3> points, const MergeTree& tree,
                      const HtmlOptions& options) {
  options.check();
  if (!has_html_viewer()) {
    throw Error(ErrorCode::kUsage,
                "this build of morsel has no viewer; install Node.js and npm and build it again");
  }
  if (points.size() != tree.piece_of_point.size()) {
    throw Error(ErrorCode::kUsage, "page: a merge tree of " +
                                       std::to_string(tree.piece_of_point.size()) + " points for " +
                                       std::to_string(points.size()) +
                                       " points; give the points that were segmented");
  }
  const std::string_view page = viewer_page();
  const std::size_t mark = page.find(kShapeMark);
  std::string text(page.substr(0, mark));
  text += shape_json(points, tree, options);
  return text.append(page.substr(mark + kShapeMark.size()));
}

void write_html(const std::filesystem::path& path, std::span<const Vec3> points,
                const MergeTree& tree, const HtmlOptions& options) {
  const std::string page = html_page(points, tree, options);
  AtomicFile file(path);
  file.stream() << page;
  file.commit();
}

}  // namespace morsel
