// NumPy arrays to values of the library and back, without copies where the memory allows.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <array>
#include <cstddef>
#include <memory>
#include <morsel/vec3.hpp>
#include <span>
#include <utility>
#include <vector>

namespace morsel::python {

namespace py = pybind11;

/// Rows of three aligned doubles, as std::vector<Vec3> holds them.
using PointArray = py::array_t<double, py::array::c_style | py::array::forcecast |
                                           py::detail::npy_api::NPY_ARRAY_ALIGNED_>;

/// The points of an array (n, 3) of float32 or float64: the array itself when it is float64 in C
/// order, else a copy. Throws py::value_error that says what came and what is wanted.
[[nodiscard]] PointArray points_of(const py::object& object);

/// The points in place. Needs no GIL; valid as long as the array.
[[nodiscard]] std::span<const Vec3> view(const PointArray& points);

/// The labels (n) of integers in place or copied, as points_of.
using LabelArray = py::array_t<int, py::array::c_style | py::array::forcecast |
                                        py::detail::npy_api::NPY_ARRAY_ALIGNED_>;
[[nodiscard]] LabelArray labels_of(const py::object& object);

/// An array that takes over the vector's memory.
template <class T, class Value>
py::array_t<T> array_from(std::vector<Value>&& values, std::vector<py::ssize_t> shape) {
  auto owned = std::make_unique<std::vector<Value>>(std::move(values));
  const T* const data = reinterpret_cast<const T*>(owned->data());
  const py::capsule owner(owned.release(),
                          [](void* memory) { delete static_cast<std::vector<Value>*>(memory); });
  return py::array_t<T>(std::move(shape), data, owner);
}

/// A read-only array over memory that `owner` keeps.
template <class T>
py::array_t<T> view_of(const std::vector<T>& values, const py::object& owner) {
  py::array_t<T> array(static_cast<py::ssize_t>(values.size()), values.data(), owner);
  array.attr("setflags")(py::arg("write") = false);
  return array;
}

/// A vector (3).
[[nodiscard]] py::array_t<double> vector_array(const Vec3& v);

/// A symmetric matrix (3, 3) from xx, xy, xz, yy, yz, zz.
[[nodiscard]] py::array_t<double> symmetric_array(const std::array<double, 6>& m);

}  // namespace morsel::python
