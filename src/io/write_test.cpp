#include <gtest/gtest.h>
#include <zlib.h>

#include <cstdint>
#include <limits>
#include <morsel/color.hpp>
#include <string>
#include <vector>

#include "io/bytes.hpp"
#include "io/test_files.hpp"

namespace morsel::io {
namespace {

class WriteTest : public FileTest {};

// Doubles that no float holds, far from the origin, tiny and of every sign.
const Points kFar = {{1000000.1234567891, -4999999.0000000009, 6378137.3000000007},
                     {1e-300, -0.1, 1e300},
                     {1.0 / 3.0, 0.0, -1e22}};
const std::vector<int> kLabels = {0, -1, 25};

PointCloud with_properties() {
  return {kFar,
          {{"intensity", std::vector<std::uint16_t>{1, 2, 65535}},
           {"red", std::vector<std::uint8_t>{9, 9, 9}},
           {"nx", std::vector<float>{0.1F, -2.0F, 3e-38F}},
           {"part", std::vector<double>{1, 2, 3}},
           {"i8", std::vector<std::int8_t>{-128, 0, 127}},
           {"time", std::vector<double>{1e-300, 0.1, 3e9}},
           {"i16", std::vector<std::int16_t>{-32768, 0, 32767}},
           {"i32", std::vector<std::int32_t>{-2147483647, 0, 7}},
           {"u32", std::vector<std::uint32_t>{4294967295U, 0, 7}},
           {"alpha", std::vector<std::uint8_t>{255, 0, 1}}}};
}

TEST_F(WriteTest, LabelsAreOneALine) {
  write_labels(path("labels.txt"), kLabels);
  EXPECT_EQ(content(path("labels.txt")), "0\n-1\n25\n");
  write_labels(path("labels.txt"), {});
  EXPECT_EQ(content(path("labels.txt")), "");
}

TEST_F(WriteTest, PlyKeepsPropertiesAndAddsPartAndColour) {
  const PointCloud cloud = with_properties();
  write_points(path("out.PLY"), cloud, kLabels);
  const PointCloud back = read_points(path("out.PLY"));
  EXPECT_EQ(back.points, kFar);
  for (const PointProperty& property : cloud.properties) {
    if (property.name == "red" || property.name == "part") continue;
    std::visit(
        [&](const auto& values) {
          using T = typename std::remove_cvref_t<decltype(values)>::value_type;
          EXPECT_EQ(values_of<T>(back, property.name), values) << property.name;
        },
        property.values);
  }
  EXPECT_EQ(back.properties.size(), 12U);
  EXPECT_EQ(values_of<std::int32_t>(back, "part"), kLabels);
  EXPECT_EQ(values_of<std::uint8_t>(back, "red")[1], 160);
  EXPECT_EQ(values_of<std::uint8_t>(back, "blue")[2], part_color(25)[2]);
}

TEST_F(WriteTest, CoordinatesAreFloatsOnlyWhenNothingIsLost) {
  const PointCloud near{{{0.5, -1.25, 3e20F}}, {}};
  for (const char* name : {"out.ply", "out.pcd"}) {
    write_points(path(name), near, std::vector<int>{3});
    EXPECT_EQ(read_points(path(name)).points, near.points);
  }
  EXPECT_TRUE(contains(content(path("out.ply")), "property float x\n"));
  EXPECT_TRUE(contains(content(path("out.pcd")), "SIZE 4 4 4 4 4\n"));
  write_points(path("out.ply"), {kFar, {}}, kLabels);
  EXPECT_TRUE(contains(content(path("out.ply")), "property double x\n"));
}

TEST_F(WriteTest, PcdRoundTrips) {
  write_points(path("out.pcd"), with_properties(), kLabels);
  const PointCloud back = read_points(path("out.pcd"));
  EXPECT_EQ(back.points, kFar);
  EXPECT_EQ(values_of<std::int32_t>(back, "part"), kLabels);
}

TEST_F(WriteTest, XyzRoundTripsInTheShortestText) {
  write_points(path("out.xyz"), {{{0.1, 1e6, -2.5}}, {}}, std::vector<int>{7});
  EXPECT_EQ(content(path("out.xyz")), "0.1 1e+06 -2.5 7\n");
  write_points(path("out.xyz"), {kFar, {}}, kLabels);
  EXPECT_EQ(read_points(path("out.xyz")).points, kFar);
}

// Walks the archive by its local headers, as stored members allow.
std::string zip_member(const std::string& bytes, const std::string& name) {
  std::size_t at = 0;
  while (bytes.compare(at, 4, "PK\x03\x04") == 0) {
    const auto crc = load_as<std::uint32_t>(&bytes[at + 14]);
    const auto size = load_as<std::uint32_t>(&bytes[at + 22]);
    const auto name_size = load_as<std::uint16_t>(&bytes[at + 26]);
    const std::string member = bytes.substr(at + 30 + name_size, size);
    EXPECT_EQ(crc, ::crc32_z(0, reinterpret_cast<const Bytef*>(member.data()), member.size()));
    if (bytes.compare(at + 30, name_size, name) == 0) return member;
    at += 30 + name_size + size;
  }
  ADD_FAILURE() << "no member " << name;
  return {};
}

TEST_F(WriteTest, NpzHoldsPointsAndLabels) {
  write_points(path("out.npz"), {kFar, {}}, kLabels);
  const std::string bytes = content(path("out.npz"));
  EXPECT_EQ(read("points.npy", zip_member(bytes, "points.npy")).points, kFar);
  const std::string labels = zip_member(bytes, "labels.npy");
  EXPECT_TRUE(contains(labels, "'descr': '<i4', 'fortran_order': False, 'shape': (3,)"));
  EXPECT_EQ((labels.size() - 12) % 64, 0U);
  EXPECT_EQ(load_as<std::int32_t>(&labels[labels.size() - 8]), -1);
  const std::size_t end = bytes.size() - 22;
  EXPECT_EQ(bytes.substr(end, 4), "PK\x05\x06");
  EXPECT_EQ(bytes.substr(load_as<std::uint32_t>(&bytes[end + 16]), 4), "PK\x01\x02");
}

TEST_F(WriteTest, SameInputSameBytes) {
  for (const std::string name : {"ply", "pcd", "xyz", "npz"}) {
    write_points(path("a." + name), with_properties(), kLabels);
    write_points(path("b." + name), with_properties(), kLabels);
    EXPECT_EQ(content(path("a." + name)), content(path("b." + name)));
  }
}

TEST_F(WriteTest, LargeFilesAreWhole) {
  PointCloud cloud;
  std::vector<int> labels;
  for (int i = 0; i < 200000; ++i) {
    cloud.points.push_back({i * 0.1, i * 0.2, i * 0.3});
    labels.push_back(i % 7);
  }
  for (const char* name : {"out.ply", "out.pcd", "out.xyz"}) {
    write_points(path(name), cloud, labels);
    EXPECT_EQ(read_points(path(name)).points, cloud.points) << name;
  }
}

TEST_F(WriteTest, RefusesWhatItCannotWriteAndLeavesNothing) {
  const PointCloud cloud{kFar, {}};
  EXPECT_TRUE(
      contains(error_of([&] { write_points(path("out.docx"), cloud, kLabels); }, ErrorCode::kUsage),
               "cannot write points as '.docx'; expected .ply, .pcd, .xyz or .npz"));
  error_of([&] { write_points(path("out.ply"), cloud, std::vector<int>{1}); }, ErrorCode::kUsage);
  const PointCloud ragged{kFar, {{"a", std::vector<float>{1}}}};
  error_of([&] { write_points(path("out.ply"), ragged, kLabels); }, ErrorCode::kUsage);
  error_of([&] { write_points(path("none/out.ply"), cloud, kLabels); }, ErrorCode::kOutput);
  error_of([&] { write_labels(path("none/labels.txt"), kLabels); }, ErrorCode::kOutput);
  EXPECT_TRUE(std::filesystem::is_empty(folder_));
}

}  // namespace
}  // namespace morsel::io
