// <morsel/io.hpp>: points from files and to files.
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <filesystem>
#include <morsel/io.hpp>

#include "arrays.hpp"
#include "bindings.hpp"
#include "work.hpp"

namespace morsel::python {
namespace {

py::array_t<double> read(const std::filesystem::path& path, std::size_t sample, double noise,
                         std::uint64_t seed) {
  PointCloud cloud = short_work([&] { return read_points(path, {sample, noise, seed}); });
  const auto count = static_cast<py::ssize_t>(cloud.points.size());
  return array_from<double>(std::move(cloud.points), {count, 3});
}

void write(const std::filesystem::path& path, const py::object& points, const py::object& labels) {
  const PointArray array = points_of(points);
  const LabelArray parts = labels_of(labels);
  if (array.shape(0) != parts.shape(0)) {
    throw py::value_error("labels: got " + std::to_string(parts.shape(0)) + " for " +
                          std::to_string(array.shape(0)) + " points; wanted is one each");
  }
  short_work([&] {
    const std::span<const Vec3> all = view(array);
    const PointCloud cloud{{all.begin(), all.end()}, {}};
    write_points(path, cloud, {parts.data(), all.size()});
  });
}

}  // namespace

void bind_io(py::module_& module) {
  module.def("read_points", &read, py::arg("path"), py::arg("sample"), py::arg("noise"),
             py::arg("seed"));
  module.def("write_points", &write, py::arg("path"), py::arg("points"), py::arg("labels"));
}

}  // namespace morsel::python
