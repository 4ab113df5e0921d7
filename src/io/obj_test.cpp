#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <string>

#include "io/test_files.hpp"

namespace morsel::io {
namespace {

class ObjTest : public FileTest {};

using Triangle = std::array<std::uint32_t, 3>;

TEST_F(ObjTest, ReadsFacesOfEveryKind) {
  const TriangleMesh got = mesh("a.obj",
                                "mtllib a.mtl\no thing\nf 1/1/1 2//2 3/3\nv 0 0 0\nv 1 0 0 1.0\n"
                                "v 1 1 0 0.5 0.5 0.5\nv 0 1 0\nvt 0 0\nvn 0 0 1\ng a\ns off\n"
                                "usemtl red\nf -4 -3 -2 -1\nf 1 \\\n 2 4 # tail\nl 1 2\n");
  EXPECT_EQ(got.vertices.size(), 4U);
  EXPECT_EQ(got.triangles, (std::vector<Triangle>{{0, 1, 2}, {0, 1, 2}, {0, 2, 3}, {0, 1, 3}}));
}

TEST_F(ObjTest, WithoutFacesItIsACloudOfDoubles) {
  EXPECT_EQ(read("a.obj", "# c\r\nv 1000000.123456789 2 3\r\nv 4 5 6\r\n").points,
            (Points{{1000000.123456789, 2, 3}, {4, 5, 6}}));
}

}  // namespace
}  // namespace morsel::io
