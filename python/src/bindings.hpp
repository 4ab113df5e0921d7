// What module.cpp puts together, one file a module of the library.
//
// The bindings are thin: plain values, tuples and NumPy arrays in and out. What users see, with its
// documentation, is python/morsel.
#pragma once

#include <pybind11/pybind11.h>

namespace morsel::python {

namespace py = pybind11;

void bind_errors(py::module_& module);
void bind_io(py::module_& module);
void bind_segment(py::module_& module);
void bind_signature(py::module_& module);
void bind_match(py::module_& module);
void bind_html(py::module_& module);
void bind_database(py::module_& module);

}  // namespace morsel::python
