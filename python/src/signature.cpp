// <morsel/signature.hpp>. In Python a signature is its bytes, which hold all of it.
#include "signature.hpp"

#include <morsel/signature.hpp>

#include "bindings.hpp"
#include "errors.hpp"

namespace morsel::python {

Signature signature_of(std::string_view bytes) {
  return decode(std::as_bytes(std::span(bytes.data(), bytes.size())), "signature");
}

void bind_signature(py::module_& module) {
  module.def(
      "signature_to_json",
      [](const py::bytes& bytes) {
        return to_json(on_values([&] { return signature_of(bytes); }));
      },
      py::arg("bytes"));
  module.def(
      "signature_from_json",
      [](const std::string& text) {
        const std::vector<std::byte> bytes =
            on_values([&] { return encode(signature_from_json(text, "signature")); });
        return py::bytes(reinterpret_cast<const char*>(bytes.data()), bytes.size());
      },
      py::arg("text"));
}

}  // namespace morsel::python
