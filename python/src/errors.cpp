// Errors of the library as the exceptions that a Python user expects.
#include "errors.hpp"

#include <morsel/error.hpp>
#include <string_view>
#include <utility>

#include "bindings.hpp"

namespace morsel::python {
namespace {

constexpr const char* kErrorText =
    "A file or database that cannot be used as it is: the text names it, the line, byte or value,\n"
    "and what would be right.";

PyObject* error_type = nullptr;  // lives as long as the process, as the module does

PyObject* exception_for(ErrorCode code) {
  switch (code) {
    case ErrorCode::kUsage:
      return PyExc_ValueError;
    case ErrorCode::kOutput:
      return PyExc_OSError;
    case ErrorCode::kResource:
      return PyExc_MemoryError;
    case ErrorCode::kCancelled:
      return PyExc_KeyboardInterrupt;
    case ErrorCode::kInternal:
      return PyExc_RuntimeError;
    case ErrorCode::kInput:
      break;
  }
  return error_type;
}

void set_error(PyObject* type, std::string_view text) {
  // A file's name need not be UTF-8.
  PyObject* const message =
      PyUnicode_DecodeUTF8(text.data(), static_cast<Py_ssize_t>(text.size()), "backslashreplace");
  if (message == nullptr) return;
  PyErr_SetObject(type, message);
  Py_DECREF(message);
}

void translate(std::exception_ptr failure) {
  try {
    if (failure) std::rethrow_exception(std::move(failure));
  } catch (const BadValue& error) {
    set_error(PyExc_ValueError, error.what());
  } catch (const Error& error) {
    set_error(exception_for(error.code()), error.what());
  }
}

}  // namespace

void bind_errors(py::module_& module) {
  error_type = PyErr_NewExceptionWithDoc("morsel.Error", kErrorText, PyExc_Exception, nullptr);
  if (error_type == nullptr) throw py::error_already_set();
  module.attr("Error") = py::handle(error_type);
  py::register_exception_translator(&translate);
}

}  // namespace morsel::python
