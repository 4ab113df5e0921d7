#include <morsel/morsel.hpp>

#include "bindings.hpp"

PYBIND11_MODULE(_morsel, module) {
  module.doc() = "The compiled part of morsel; use the package morsel.";
  module.def("version", &morsel::version);
  morsel::python::bind_errors(module);
  morsel::python::bind_io(module);
  morsel::python::bind_segment(module);
  morsel::python::bind_signature(module);
  morsel::python::bind_match(module);
  morsel::python::bind_html(module);
  morsel::python::bind_database(module);
}
