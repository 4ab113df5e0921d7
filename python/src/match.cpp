// <morsel/match.hpp>: how alike two shapes are.
#include <pybind11/stl.h>

#include <morsel/match.hpp>
#include <morsel/partial.hpp>
#include <morsel/sketch.hpp>
#include <optional>
#include <string>

#include "arrays.hpp"
#include "bindings.hpp"
#include "options.hpp"
#include "segment.hpp"
#include "signature.hpp"
#include "work.hpp"

namespace morsel::python {
namespace {

py::tuple tuple_of(const Match& found) {
  py::list matched;
  for (const MatchedPart& pair : found.matched) {
    matched.append(py::make_tuple(pair.target, pair.source, pair.contribution));
  }
  std::vector<double> matrix(found.target_from_source.begin(), found.target_from_source.end());
  return py::make_tuple(found.score, array_from<double>(std::move(matrix), {4, 4}), found.mirrored,
                        matched, found.unmatched_target, found.unmatched_source);
}

py::tuple match_signatures(const std::string& target, const std::string& source,
                           const std::string& method, const std::string& mode, bool mirror,
                           bool same_scale) {
  const MatchOptions options = match_options(method, mode, mirror, same_scale);
  return tuple_of(
      short_work([&] { return match(signature_of(target), signature_of(source), options); }));
}

py::tuple match_pieces(const CutShape& target, const CutShape& source, const std::string& method,
                       bool mirror, bool same_scale) {
  const MatchOptions options = match_options(method, "partial", mirror, same_scale);
  return tuple_of(short_work([&] {
    const Sketch whole = make_sketch(*target.segmentation());
    const Sketch piece = make_sketch(*source.segmentation());
    return match_partial(Surface(whole.points, whole.parts), Surface(piece.points, piece.parts),
                         options);
  }));
}

}  // namespace

MatchOptions match_options(const std::string& method, const std::string& mode, bool mirror,
                           bool same_scale) {
  const std::optional<MatchMode> chosen = mode_named(mode);
  if (!chosen) {
    throw Error(ErrorCode::kUsage,
                "mode is '" + mode + "'; it must be 'rigid', 'articulated' or 'partial'");
  }
  const MatchOptions options{method_of(method), mirror, *chosen, same_scale};
  options.check();
  return options;
}

void bind_match(py::module_& module) {
  module.def("match", &match_signatures, py::arg("target"), py::arg("source"), py::arg("method"),
             py::arg("mode"), py::arg("mirror"), py::arg("same_scale"));
  module.def("match_partial", &match_pieces, py::arg("target"), py::arg("source"),
             py::arg("method"), py::arg("mirror"), py::arg("same_scale"));
}

}  // namespace morsel::python
