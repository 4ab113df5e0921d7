// Numbers in binary files: typed, of either byte order, never read past the end.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

#include "io/source.hpp"

namespace morsel::io {

enum class ScalarType {
  kInt8,
  kUint8,
  kInt16,
  kUint16,
  kInt32,
  kUint32,
  kInt64,
  kUint64,
  kFloat32,
  kFloat64
};

[[nodiscard]] constexpr std::size_t size_of(ScalarType type) {
  constexpr std::array<std::size_t, 10> kSizes = {1, 1, 2, 2, 4, 4, 8, 8, 4, 8};
  return kSizes[static_cast<std::size_t>(type)];
}
[[nodiscard]] constexpr bool is_float(ScalarType type) {
  return type == ScalarType::kFloat32 || type == ScalarType::kFloat64;
}
[[nodiscard]] constexpr bool is_signed(ScalarType type) {
  return is_float(type) || static_cast<std::size_t>(type) % 2 == 0;
}

/// The T whose bytes begin at `from`, in byte order `order`. The caller has checked the bounds.
template <class T>
[[nodiscard]] T load_as(const char* from, std::endian order = std::endian::little) {
  std::array<char, sizeof(T)> raw;
  std::memcpy(raw.data(), from, sizeof(T));
  if (order != std::endian::native) std::reverse(raw.begin(), raw.end());
  return std::bit_cast<T>(raw);
}

/// A scalar of a type known at run time. Exact but for 64-bit integers above 2^53.
[[nodiscard]] double load_scalar(const char* from, ScalarType type, std::endian order);

/// Appends the bytes of `value` in little-endian order.
template <class T>
void append_bytes(std::string& to, T value) {
  auto raw = std::bit_cast<std::array<char, sizeof(T)>>(value);
  if constexpr (std::endian::native == std::endian::big) std::reverse(raw.begin(), raw.end());
  to.append(raw.data(), raw.size());
}

/// Walks the bytes of a source; every access is checked.
class ByteReader {
 public:
  ByteReader(const Source& source, std::size_t offset, std::endian order = std::endian::little)
      : source_(source), offset_(offset), order_(order) {}

  [[nodiscard]] std::size_t offset() const { return offset_; }
  [[nodiscard]] std::size_t remaining() const {
    return source_.bytes.size() - std::min(offset_, source_.bytes.size());
  }

  /// The next `count` bytes; throws when the file ends before, naming `what`.
  const char* take(std::size_t count, std::string_view what);
  template <class T>
  T read(std::string_view what) {
    return load_as<T>(take(sizeof(T), what), order_);
  }
  double read(ScalarType type, std::string_view what) {
    return load_scalar(take(size_of(type), what), type, order_);
  }
  [[noreturn]] void fail(const std::string& message) const {
    fail_at_byte(source_.name, offset_, message);
  }

 private:
  const Source& source_;
  std::size_t offset_;
  std::endian order_;
};

}  // namespace morsel::io
