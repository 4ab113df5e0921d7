#include "arrays.hpp"

#include <string>

namespace morsel::python {
namespace {

std::string class_of(const py::object& object) {
  return py::str(py::type::of(object).attr("__qualname__"));
}

std::string shape_text(const py::array& array) {
  return py::str(py::tuple(array.attr("shape"))).cast<std::string>() + " of " +
         py::str(array.dtype()).cast<std::string>();
}

bool is_float(const py::array& array) {
  return py::isinstance<py::array_t<double>>(array) || py::isinstance<py::array_t<float>>(array);
}

}  // namespace

PointArray points_of(const py::object& object) {
  const std::string wanted = "; wanted is an array (n, 3) of float32 or float64";
  if (!py::isinstance<py::array>(object)) {
    throw py::value_error("points: got an object of type " + class_of(object) + wanted);
  }
  const auto array = py::reinterpret_borrow<py::array>(object);
  if (array.ndim() != 2 || array.shape(1) != 3 || !is_float(array)) {
    throw py::value_error("points: got an array " + shape_text(array) + wanted);
  }
  PointArray points = PointArray::ensure(array);
  if (!points) throw py::error_already_set();
  return points;
}

std::span<const Vec3> view(const PointArray& points) {
  static_assert(sizeof(Vec3) == 3 * sizeof(double));
  return {reinterpret_cast<const Vec3*>(points.data()), static_cast<std::size_t>(points.shape(0))};
}

LabelArray labels_of(const py::object& object) {
  const std::string wanted = "; wanted is an array (n,) of integers";
  if (!py::isinstance<py::array>(object)) {
    throw py::value_error("labels: got an object of type " + class_of(object) + wanted);
  }
  const auto array = py::reinterpret_borrow<py::array>(object);
  if (array.ndim() != 1 || (array.dtype().kind() != 'i' && array.dtype().kind() != 'u')) {
    throw py::value_error("labels: got an array " + shape_text(array) + wanted);
  }
  LabelArray labels = LabelArray::ensure(array);
  if (!labels) throw py::error_already_set();
  return labels;
}

py::array_t<double> vector_array(const Vec3& v) {
  py::array_t<double> array(3);
  auto x = array.mutable_unchecked<1>();
  x(0) = v.x;
  x(1) = v.y;
  x(2) = v.z;
  return array;
}

py::array_t<double> symmetric_array(const std::array<double, 6>& m) {
  py::array_t<double> array({3, 3});
  auto x = array.mutable_unchecked<2>();
  std::size_t next = 0;
  for (py::ssize_t row = 0; row < 3; ++row) {
    for (py::ssize_t column = row; column < 3; ++column) {
      x(row, column) = x(column, row) = m[next++];
    }
  }
  return array;
}

}  // namespace morsel::python
