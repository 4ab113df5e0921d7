#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <cstring>
#include <string>

#include "io/bytes.hpp"
#include "io/test_files.hpp"

namespace morsel::io {
namespace {

class LasTest : public FileTest {};

template <class T>
void put(std::string& bytes, std::size_t at, T value) {
  std::string raw;
  append_bytes(raw, value);
  bytes.replace(at, raw.size(), raw);
}

std::string las(int minor, int format, std::size_t record, bool legacy_count) {
  const std::size_t header = minor == 4 ? 375 : minor == 3 ? 235 : 227;
  std::string bytes(header + 10, '\0');  // and ten bytes of something else before the points
  bytes.replace(0, 4, "LASF");
  put(bytes, 24, std::uint8_t{1});
  put(bytes, 25, static_cast<std::uint8_t>(minor));
  put(bytes, 94, static_cast<std::uint16_t>(header));
  put(bytes, 96, static_cast<std::uint32_t>(bytes.size()));
  put(bytes, 104, static_cast<std::uint8_t>(format));
  put(bytes, 105, static_cast<std::uint16_t>(record));
  if (legacy_count) put(bytes, 107, std::uint32_t{2});
  if (!legacy_count) put(bytes, 247, std::uint64_t{2});
  for (std::size_t axis = 0; axis < 3; ++axis) {
    put(bytes, 131 + 8 * axis, 0.001);
    put(bytes, 155 + 8 * axis, 1e6 * static_cast<double>(axis + 1));
  }
  for (std::int32_t row = 0; row < 2; ++row) {
    std::string point(record, '\x55');
    for (std::int32_t axis = 0; axis < 3; ++axis) {
      put(point, static_cast<std::size_t>(4 * axis), 1000 * row - 7 * axis);
    }
    bytes += point;
  }
  return bytes;
}

TEST_F(LasTest, ReadsEveryVersionAndPointFormat) {
  const std::array<std::size_t, 11> lengths = {20, 28, 26, 34, 57, 63, 30, 36, 38, 59, 67};
  const Points expected = {{0 * 0.001 + 1e6, -7 * 0.001 + 2e6, -14 * 0.001 + 3e6},
                           {1000 * 0.001 + 1e6, 993 * 0.001 + 2e6, 986 * 0.001 + 3e6}};
  for (int format = 0; format < 11; ++format) {
    const std::size_t length = lengths[static_cast<std::size_t>(format)];
    for (const int minor : {2, 3, 4}) {
      EXPECT_EQ(read("a.las", las(minor, format, length + 3, true)).points, expected);
    }
    EXPECT_EQ(read("a.las", las(4, format, length, false)).points, expected);
  }
}

TEST_F(LasTest, EveryTruncationIsAnError) {
  const std::string bytes = las(4, 6, 30, false);
  for (std::size_t length = 1; length < bytes.size(); ++length) {
    EXPECT_THROW(static_cast<void>(read("cut.las", bytes.substr(0, length))), Error) << length;
  }
}

}  // namespace
}  // namespace morsel::io
