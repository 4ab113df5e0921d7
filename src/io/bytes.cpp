#include "io/bytes.hpp"

#include <fmt/format.h>

namespace morsel::io {

double load_scalar(const char* from, ScalarType type, std::endian order) {
  switch (type) {
    case ScalarType::kInt8:
      return load_as<std::int8_t>(from, order);
    case ScalarType::kUint8:
      return load_as<std::uint8_t>(from, order);
    case ScalarType::kInt16:
      return load_as<std::int16_t>(from, order);
    case ScalarType::kUint16:
      return load_as<std::uint16_t>(from, order);
    case ScalarType::kInt32:
      return load_as<std::int32_t>(from, order);
    case ScalarType::kUint32:
      return load_as<std::uint32_t>(from, order);
    case ScalarType::kInt64:
      return static_cast<double>(load_as<std::int64_t>(from, order));
    case ScalarType::kUint64:
      return static_cast<double>(load_as<std::uint64_t>(from, order));
    case ScalarType::kFloat32:
      return load_as<float>(from, order);
    case ScalarType::kFloat64:
      return load_as<double>(from, order);
  }
  return 0.0;
}

const char* ByteReader::take(std::size_t count, std::string_view what) {
  if (count > remaining()) {
    fail(fmt::format("the file ends within {}: {} bytes expected, {} left; it is truncated", what,
                     count, remaining()));
  }
  const char* begin = source_.bytes.data() + offset_;
  offset_ += count;
  return begin;
}

}  // namespace morsel::io
