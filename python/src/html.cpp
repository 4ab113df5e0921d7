// <morsel/html.hpp>, <morsel/color.hpp>: shapes on the screen.
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <filesystem>
#include <morsel/color.hpp>
#include <morsel/html.hpp>
#include <string>

#include "bindings.hpp"
#include "segment.hpp"
#include "work.hpp"

namespace morsel::python {
namespace {

HtmlOptions options_for(const CutShape& shape, const std::string& name) {
  HtmlOptions options;
  options.name = name;
  options.merge_ratio = shape.parts.merge_ratio;
  return options;
}

std::string page_of(const CutShape& shape, const std::string& name) {
  return short_work(
      [&] { return html_page(view(shape.points), shape.whole->tree, options_for(shape, name)); });
}

void write_page(const CutShape& shape, const std::filesystem::path& path, const std::string& name) {
  short_work(
      [&] { write_html(path, view(shape.points), shape.whole->tree, options_for(shape, name)); });
}

}  // namespace

void bind_html(py::module_& module) {
  module.def("has_viewer", &has_html_viewer);
  module.def("html_page", &page_of, py::arg("shape"), py::arg("name"));
  module.def("write_html", &write_page, py::arg("shape"), py::arg("path"), py::arg("name"));
  module.def("part_color", &part_color, py::arg("part"));
}

}  // namespace morsel::python
