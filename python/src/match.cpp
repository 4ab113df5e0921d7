// <morsel/match.hpp>: how alike two shapes are.
#include <pybind11/stl.h>

#include <morsel/match.hpp>
#include <string>

#include "arrays.hpp"
#include "bindings.hpp"
#include "options.hpp"
#include "signature.hpp"
#include "work.hpp"

namespace morsel::python {
namespace {

py::tuple match_signatures(const std::string& target, const std::string& source,
                           const std::string& method, const std::string& mode, bool mirror) {
  const MatchOptions options = match_options(method, mode, mirror);
  const Match found =
      short_work([&] { return match(signature_of(target), signature_of(source), options); });
  py::list matched;
  for (const MatchedPart& pair : found.matched) {
    matched.append(py::make_tuple(pair.target, pair.source, pair.contribution));
  }
  std::vector<double> matrix(found.target_from_source.begin(), found.target_from_source.end());
  return py::make_tuple(found.score, array_from<double>(std::move(matrix), {4, 4}), found.mirrored,
                        matched, found.unmatched_target, found.unmatched_source);
}

}  // namespace

MatchOptions match_options(const std::string& method, const std::string& mode, bool mirror) {
  if (mode != "rigid" && mode != "articulated") {
    throw Error(ErrorCode::kUsage, "mode is '" + mode + "'; it must be 'rigid' or 'articulated'");
  }
  const MatchOptions options{method_of(method), mirror,
                             mode == "rigid" ? MatchMode::kRigid : MatchMode::kArticulated};
  options.check();
  return options;
}

void bind_match(py::module_& module) {
  module.def("match", &match_signatures, py::arg("target"), py::arg("source"), py::arg("method"),
             py::arg("mode"), py::arg("mirror"));
}

}  // namespace morsel::python
