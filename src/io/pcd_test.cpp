#include <gtest/gtest.h>
#include <liblzf/lzf.h>

#include <cstdint>
#include <string>
#include <vector>

#include "io/bytes.hpp"
#include "io/test_files.hpp"

namespace morsel::io {
namespace {

class PcdTest : public FileTest {};

const std::string kHeader =
    "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\nFIELDS _ z x hist y i rgb\n"
    "SIZE 1 8 4 2 4 2 4\nTYPE U F F I F U U\nCOUNT 3 1 1 2 1 1 1\nWIDTH 2\nHEIGHT 20\n"
    "VIEWPOINT 0 0 0 1 0 0 0\nPOINTS 40\nDATA ";

Points expected_points() {
  Points points;
  for (int i = 0; i < 40; ++i) points.push_back({i + 0.5, -1.0 * i, 1e6 + 0.1 * i});
  return points;
}

// Field by field if `columns`, else point by point.
std::string binary_points(bool columns) {
  std::vector<std::string> fields(7);
  std::string rows;
  for (int i = 0; i < 40; ++i) {
    const Vec3 p = expected_points()[static_cast<std::size_t>(i)];
    std::vector<std::string> row(7);
    row[0] = "pad";
    append_bytes(row[1], p.z);
    append_bytes(row[2], static_cast<float>(p.x));
    append_bytes(row[3], std::int32_t{77});
    append_bytes(row[4], static_cast<float>(p.y));
    append_bytes(row[5], static_cast<std::uint16_t>(3 * i));
    append_bytes(row[6], std::uint32_t{0xff0000});
    for (std::size_t f = 0; f < 7; ++f) {
      rows += row[f];
      fields[f] += row[f];
    }
  }
  std::string joined;
  for (const std::string& field : fields) joined += field;
  return columns ? joined : rows;
}

void expect_all(const PointCloud& cloud) {
  EXPECT_EQ(cloud.points, expected_points());
  const auto i = values_of<std::uint16_t>(cloud, "i");
  ASSERT_EQ(i.size(), 40U);
  EXPECT_EQ(i[39], 117);
  EXPECT_EQ(cloud.properties.size(), 1U);
}

TEST_F(PcdTest, ReadsBinary) {
  expect_all(read("a.pcd", kHeader + "binary\n" + binary_points(false)));
}

TEST_F(PcdTest, ReadsCompressed) {
  const std::string data = binary_points(true);
  std::string packed(data.size() + 100, '\0');
  packed.resize(lzf_compress(data.data(), static_cast<unsigned>(data.size()), packed.data(),
                             static_cast<unsigned>(packed.size())));
  ASSERT_FALSE(packed.empty());
  std::string sizes;
  append_bytes(sizes, static_cast<std::uint32_t>(packed.size()));
  append_bytes(sizes, static_cast<std::uint32_t>(data.size()));
  expect_all(read("a.pcd", kHeader + "binary_compressed\n" + sizes + packed));
}

TEST_F(PcdTest, ReadsAsciiWithoutCountAndWithNanNormals) {
  const PointCloud cloud = read("a.pcd",
                                "VERSION .7\r\nFIELDS x y z normal_x\r\nSIZE 4 4 4 4\r\n"
                                "TYPE F F F F\r\nPOINTS 2\r\nDATA ascii\r\n1 2 3 nan\r\n"
                                "4000000.125 5 6 0.5\r\n");
  EXPECT_EQ(cloud.points, (Points{{1, 2, 3}, {4000000.125, 5, 6}}));
  EXPECT_EQ(values_of<float>(cloud, "normal_x")[1], 0.5F);
}

TEST_F(PcdTest, EveryTruncationIsAnError) {
  const std::string bytes = kHeader + "binary\n" + binary_points(false);
  for (std::size_t length = 1; length < bytes.size(); ++length) {
    EXPECT_THROW(static_cast<void>(read("cut.pcd", bytes.substr(0, length))), Error) << length;
  }
}

}  // namespace
}  // namespace morsel::io
