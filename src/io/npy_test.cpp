#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <string>

#include "io/bytes.hpp"
#include "io/test_files.hpp"

namespace morsel::io {
namespace {

class NpyTest : public FileTest {};

const Points kPoints = {{1, 2, 3}, {4, 5, 6}};

template <class T>
std::string npy(int version, const std::string& descr, bool fortran, bool big = false) {
  const std::string text = "{'descr': '" + descr +
                           "', 'fortran_order': " + (fortran ? "True" : "False") +
                           ", 'shape': (2, 3), }   \n";
  std::string bytes = "\x93NUMPY";
  bytes += static_cast<char>(version);
  bytes += '\0';
  if (version == 1) {
    append_bytes(bytes, static_cast<std::uint16_t>(text.size()));
  } else {
    append_bytes(bytes, static_cast<std::uint32_t>(text.size()));
  }
  bytes += text;
  const int by_rows[] = {1, 2, 3, 4, 5, 6};
  const int by_columns[] = {1, 4, 2, 5, 3, 6};
  for (const int value : fortran ? by_columns : by_rows) {
    std::string raw;
    append_bytes(raw, static_cast<T>(value));
    if (big) std::reverse(raw.begin(), raw.end());
    bytes += raw;
  }
  return bytes;
}

TEST_F(NpyTest, ReadsEveryTypeOrderAndVersion) {
  for (const int version : {1, 2, 3}) {
    for (const bool fortran : {false, true}) {
      EXPECT_EQ(read("a.npy", npy<double>(version, "<f8", fortran)).points, kPoints);
      EXPECT_EQ(read("a.npy", npy<double>(version, ">f8", fortran, true)).points, kPoints);
      EXPECT_EQ(read("a.npy", npy<float>(version, "<f4", fortran)).points, kPoints);
      EXPECT_EQ(read("a.npy", npy<std::int8_t>(version, "|i1", fortran)).points, kPoints);
      EXPECT_EQ(read("a.npy", npy<std::uint16_t>(version, ">u2", fortran, true)).points, kPoints);
      EXPECT_EQ(read("a.npy", npy<std::int32_t>(version, "<i4", fortran)).points, kPoints);
      EXPECT_EQ(read("a.npy", npy<std::int64_t>(version, "<i8", fortran)).points, kPoints);
    }
  }
}

TEST_F(NpyTest, EveryTruncationIsAnError) {
  const std::string bytes = npy<double>(1, "<f8", false);
  for (std::size_t length = 1; length < bytes.size(); ++length) {
    EXPECT_THROW(static_cast<void>(read("cut.npy", bytes.substr(0, length))), Error) << length;
  }
}

}  // namespace
}  // namespace morsel::io
