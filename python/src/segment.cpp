// <morsel/morsel.hpp>, <morsel/segment.hpp>: the parts of a cloud and all cuts of it.
#include "segment.hpp"

#include <pybind11/stl.h>

#include <optional>
#include <utility>

#include "bindings.hpp"
#include "errors.hpp"
#include "options.hpp"
#include "work.hpp"

namespace morsel::python {

std::shared_ptr<const Segmentation> CutShape::segmentation() const {
  if (is_first) return whole;
  return std::make_shared<const Segmentation>(recut(*whole, options.cut));
}

const std::vector<int>& CutShape::labels() const {
  return is_first ? whole->labels : parts.part_of_point;
}

Method method_of(const std::string& name) {
  if (name == "default") return Method::kDefault;
  if (name == "paper") return Method::kPaper;
  throw Error(ErrorCode::kUsage, "method is '" + name + "'; it must be 'default' or 'paper'");
}

namespace {

GroundMode ground_of(const std::string& name) {
  if (const auto mode = ground_mode_named(name)) return *mode;
  throw Error(ErrorCode::kUsage, "ground is '" + name + "'; it must be 'auto', 'keep' or 'remove'");
}

}  // namespace

SegmentOptions segment_options(const std::string& method, std::optional<int> denoise,
                               const std::string& ground, int threads) {
  SegmentOptions options;
  options.ground.mode = ground_of(ground);
  options.interior.method = method_of(method);
  options.denoise.rounds = denoise;
  options.threads = threads;
  if (denoise && options.interior.method == Method::kPaper) {
    throw Error(ErrorCode::kUsage,
                "denoise is " + std::to_string(*denoise) +
                    "; the paper's method takes the points as they are and knows no denoise");
  }
  if (ground != "auto" && options.interior.method == Method::kPaper) {
    throw Error(ErrorCode::kUsage, "ground is '" + ground +
                                       "'; the paper's method takes the points as they are and "
                                       "knows no ground");
  }
  if (threads < 0 || threads > 1024) {
    throw Error(ErrorCode::kUsage,
                "threads is " + std::to_string(threads) + "; it must be 0 to 1024");
  }
  options.check();
  return options;
}

namespace {

using Shape = std::shared_ptr<CutShape>;

Shape make_shape(const py::object& points, std::optional<std::size_t> parts,
                 std::optional<double> merge_ratio, const std::string& method,
                 std::optional<int> denoise, const std::string& ground, int threads,
                 const py::object& progress) {
  auto shape = std::make_shared<CutShape>();
  shape->options = segment_options(method, denoise, ground, threads);
  shape->options.cut = {parts, merge_ratio};
  shape->points = points_of(points);
  const std::span<const Vec3> cloud = view(shape->points);
  shape->whole = long_work(progress, [&](const Progress& watched) {
    return on_values([&] {
      return std::make_shared<const Segmentation>(segment(cloud, shape->options, &watched));
    });
  });
  shape->parts = shape->whole->parts;
  return shape;
}

Shape cut_again(const Shape& shape, std::optional<std::size_t> parts,
                std::optional<double> merge_ratio) {
  auto other = std::make_shared<CutShape>(*shape);
  other->options.cut = {parts, merge_ratio};
  other->options.cut.check();
  if (shape->whole->verdict == Verdict::kSolid) {
    other->parts = short_work([&] { return cut(shape->whole->tree, other->options.cut); });
    other->is_first = false;
  }
  return other;
}

py::list parts_of(const CutShape& shape) {
  py::list list;
  for (const Part& part : shape.parts.parts) {
    py::list neighbours;
    for (const PartNeighbor& neighbor : part.neighbors) {
      neighbours.append(py::make_tuple(neighbor.part, neighbor.neck_radius));
    }
    list.append(py::make_tuple(part.volume, vector_array(part.center),
                               symmetric_array(part.covariance), vector_array(part.ball_center),
                               part.ball_radius, part.point_count, part.object, neighbours));
  }
  return list;
}

py::list levels_of(const CutShape& shape) {
  py::list list;
  if (shape.whole->verdict != Verdict::kSolid) return list;
  for (const MergeTree::Level& level : shape.whole->tree.levels()) {
    list.append(py::make_tuple(level.parts, level.from_ratio, level.to_ratio));
  }
  return list;
}

// Message, report and signature of the cut, the latter as bytes.
py::tuple findings_of(const Shape& shape) {
  std::string report;
  std::vector<std::byte> signature;
  std::string message;
  short_work([&] {
    const std::shared_ptr<const Segmentation> segmentation = shape->segmentation();
    message = segmentation->message;
    report = report_json(*segmentation, shape->options, "");
    signature = encode(make_signature(*segmentation, shape->options.threads));
  });
  return py::make_tuple(
      message, report,
      py::bytes(reinterpret_cast<const char*>(signature.data()), signature.size()));
}

}  // namespace

void bind_segment(py::module_& module) {
  py::class_<CutShape, Shape>(module, "Shape")
      .def_property_readonly("labels",
                             [](const py::object& self) {
                               return view_of(self.cast<const CutShape&>().labels(), self);
                             })
      .def_property_readonly("points", [](const CutShape& shape) { return shape.points; })
      .def_property_readonly("parts", &parts_of)
      .def_property_readonly("levels", &levels_of)
      .def_property_readonly("merge_ratio",
                             [](const CutShape& shape) { return shape.parts.merge_ratio; })
      .def_property_readonly(
          "is_solid", [](const CutShape& shape) { return shape.whole->verdict == Verdict::kSolid; })
      .def("findings", &findings_of)
      .def("cut", &cut_again, py::arg("parts"), py::arg("merge_ratio"));
  module.def("segment", &make_shape, py::arg("points"), py::arg("parts"), py::arg("merge_ratio"),
             py::arg("method"), py::arg("denoise"), py::arg("ground"), py::arg("threads"),
             py::arg("progress"));
}

}  // namespace morsel::python
