#include <gtest/gtest.h>

#include <string>

#include "io/test_files.hpp"

namespace morsel::io {
namespace {

class OffTest : public FileTest {};

const Points kPoints = {{0, 0, 0}, {1000000.25, 0, 0}, {1000000.25, 1e-7, 0}, {0, 1, 0}};

TEST_F(OffTest, ReadsEveryVariantOfHeaderAndVertex) {
  const std::string vertices = "0 0 0\n1000000.25 0 0\n1000000.25 1e-7 0\n0 1 0\n";
  const std::string colored =
      "0 0 0 255 0 0 255\n1000000.25 0 0 1 2 3 4\n1000000.25 1e-7 0 1 2 3 4\n0 1 0 1 2 3 4\n";
  const std::string faces = "4 0 1 2 3 1 0 0\n2 0 1\n3 0 1 2 # red\n";
  for (const std::string& text :
       {"OFF\n4 3 0\n" + vertices + faces, "OFF 4 3 0\n" + vertices + faces,
        "OFF4 3 0\n" + vertices + faces, "4 3 0\n" + vertices + faces,
        "# c\nOFF # d\n\n4 3\n# e\n" + vertices + "\n" + faces, "COFF\n4 3 0\n" + colored + faces,
        "NOFF\r\n4 3 0\r\n" + colored + faces, "STCNOFF\n4 3 0\n" + colored + faces}) {
    const TriangleMesh got = mesh("a.off", text);
    EXPECT_EQ(got.vertices, kPoints) << text;
    EXPECT_EQ(got.triangles.size(), 3U) << text;
  }
}

TEST_F(OffTest, WithoutFacesItIsACloud) {
  EXPECT_EQ(read("a.off", "COFF\n1 0 0\n1 2 3 255 255 255\n").points, (Points{{1, 2, 3}}));
  EXPECT_FALSE(is_mesh_file(path("a.off")));
  EXPECT_TRUE(contains(error_of([&] { static_cast<void>(read_mesh(path("a.off"))); }), "no face"));
}

}  // namespace
}  // namespace morsel::io
