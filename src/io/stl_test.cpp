#include <gtest/gtest.h>

#include <cstdint>
#include <string>

#include "io/bytes.hpp"
#include "io/test_files.hpp"

namespace morsel::io {
namespace {

class StlTest : public FileTest {};

const Points kCorners = {{0, 0, 0}, {1.5, 0, 0}, {0, 1, 0}};

std::string binary(const std::string& head, const Points& corners) {
  std::string bytes = head;
  bytes.resize(80);
  append_bytes(bytes, static_cast<std::uint32_t>(corners.size() / 3));
  for (std::size_t i = 0; i < corners.size(); ++i) {
    if (i % 3 == 0) bytes += std::string(12, '\0');
    for (const double value : {corners[i].x, corners[i].y, corners[i].z}) {
      append_bytes(bytes, static_cast<float>(value));
    }
    if (i % 3 == 2) bytes += std::string(2, '\0');
  }
  return bytes;
}

TEST_F(StlTest, ReadsBinaryEvenIfItBeginsWithSolidOrHasAnotherName) {
  for (const char* head : {"", "solid of a liar", "COLOR=abc"}) {
    EXPECT_EQ(mesh("a.stl", binary(head, kCorners)).vertices, kCorners);
    EXPECT_EQ(mesh("a.dat", binary(head, kCorners)).triangles.size(), 1U);
  }
  EXPECT_EQ(mesh("a.stl", binary("", kCorners) + "tail").vertices, kCorners);
}

TEST_F(StlTest, ReadsText) {
  const std::string facet =
      "  facet normal 0 0 1\n    outer loop\n      vertex 0 0 0\n      vertex 1.5E+0 0 0\n"
      "      vertex 0 1 0\n    endloop\n  endfacet\n";
  const TriangleMesh got =
      mesh("a.stl", "solid one\n" + facet + "endsolid one\nsolid\n" + facet + facet + "endsolid\n");
  EXPECT_EQ(got.triangles.size(), 3U);
  EXPECT_EQ(got.vertices[7], kCorners[1]);
}

}  // namespace
}  // namespace morsel::io
