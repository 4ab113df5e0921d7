// What Python holds of a segmentation: the whole of it and the cut that is looked at.
#pragma once

#include <memory>
#include <morsel/morsel.hpp>
#include <string>
#include <vector>

#include "arrays.hpp"

namespace morsel::python {

/// One cut. Several share the segmentation that they were cut from and the points.
struct CutShape {
  std::shared_ptr<const Segmentation> whole;  ///< as cut at first
  PointArray points;
  SegmentOptions options;  ///< of this cut
  bool is_first = true;    ///< `parts` and `whole->parts` are the same cut
  Parts parts;

  /// The segmentation with this cut. Cost: a copy, and a new signature, of all but the first cut.
  [[nodiscard]] std::shared_ptr<const Segmentation> segmentation() const;
  [[nodiscard]] const std::vector<int>& labels() const;
};

}  // namespace morsel::python
