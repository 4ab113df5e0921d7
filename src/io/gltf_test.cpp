#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "io/bytes.hpp"
#include "io/test_files.hpp"

namespace morsel::io {
namespace {

class GltfTest : public FileTest {};

using Triangle = std::array<std::uint32_t, 3>;

// Four corners of a square as floats with 4 bytes between them, then the indices 0 1 2 3 as bytes.
std::string square_bytes() {
  std::string bytes;
  for (const Vec3& p : {Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{1, 1, 0}}) {
    for (const double value : {p.x, p.y, p.z, 9.0}) append_bytes(bytes, static_cast<float>(value));
  }
  return bytes + std::string("\0\1\2\3", 4);
}

std::string document(const std::string& nodes, int mode, const std::string& buffer,
                     int indices = 4) {
  return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":)" + nodes +
         R"(,"meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1,"mode":)" +
         std::to_string(mode) +
         R"(}]}],"accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3"},)"
         R"({"bufferView":1,"componentType":5121,"count":)" +
         std::to_string(indices) +
         R"(,"type":"SCALAR"}],"bufferViews":[{"buffer":0,"byteLength":64,"byteStride":16},)"
         R"({"buffer":0,"byteOffset":64,"byteLength":4}],"buffers":[{"byteLength":68)" +
         buffer + "}]}";
}

std::string glb(std::string json, const std::string& binary) {
  json.append((4 - json.size() % 4) % 4, ' ');
  std::string bytes = "glTF";
  append_bytes(bytes, std::uint32_t{2});
  append_bytes(bytes, static_cast<std::uint32_t>(28 + json.size() + binary.size()));
  append_bytes(bytes, static_cast<std::uint32_t>(json.size()));
  bytes += "JSON" + json;
  append_bytes(bytes, static_cast<std::uint32_t>(binary.size()));
  return bytes + std::string("BIN\0", 4) + binary;
}

TEST_F(GltfTest, ReadsTrianglesStripsAndFans) {
  const auto triangles = [&](int mode, int indices) {
    return mesh("a.glb", glb(document(R"([{"mesh":0}])", mode, "", indices), square_bytes()))
        .triangles;
  };
  EXPECT_EQ(triangles(4, 3), (std::vector<Triangle>{{0, 1, 2}}));
  EXPECT_EQ(triangles(5, 4), (std::vector<Triangle>{{0, 1, 2}, {1, 3, 2}}));
  EXPECT_EQ(triangles(6, 4), (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}}));
}

TEST_F(GltfTest, AppliesTheTransformsOfNodesInDoubles) {
  // Far away, then turned by 90 degrees about z and doubled; the second instance by a matrix.
  const std::string nodes =
      R"([{"translation":[1000000.125,0,0],"children":[1,2]},)"
      R"({"mesh":0,"rotation":[0,0,0.7071067811865476,0.7071067811865476],"scale":[2,2,2]},)"
      R"({"mesh":0,"matrix":[1,0,0,0,0,1,0,0,0,0,1,0,0,0,5,1]}])";
  const TriangleMesh got = mesh("a.glb", glb(document(nodes, 5, ""), square_bytes()));
  ASSERT_EQ(got.vertices.size(), 8U);
  EXPECT_EQ(got.triangles.size(), 4U);
  const Vec3& moved = got.vertices[1];
  const Vec3& turned = got.vertices[5];
  EXPECT_EQ(moved, (Vec3{1000001.125, 0, 5}));
  EXPECT_NEAR(turned.x, 1000000.125, 1e-9);
  EXPECT_NEAR(turned.y, 2.0, 1e-12);
}

TEST_F(GltfTest, ReadsBuffersBesideTheFile) {
  write("the buffer.bin", square_bytes());
  const std::string text = document(R"([{"mesh":0}])", 5, R"(,"uri":"the%20buffer.bin")");
  EXPECT_EQ(mesh("a.gltf", text).triangles.size(), 2U);
  EXPECT_TRUE(is_mesh_file(path("a.gltf")));
}

TEST_F(GltfTest, ReadsBuffersWithinTheFile) {
  // Three floats (0, 0, 1), (1, 0, 1) … would be long; zeros but for the last: 36 bytes.
  const std::string text =
      R"({"asset":{"version":"2.0"},"nodes":[{"mesh":0}],"meshes":[{"primitives":)"
      R"([{"attributes":{"POSITION":0}}]}],"accessors":[{"bufferView":0,"componentType":5126,)"
      R"("count":3,"type":"VEC3"}],"bufferViews":[{"buffer":0,"byteLength":36}],"buffers":)"
      R"([{"byteLength":36,"uri":"data:application/gltf-buffer;base64,)"
      R"(AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]})";
  EXPECT_EQ(mesh("a.gltf", text).vertices, (Points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
}

TEST_F(GltfTest, EveryTruncationAndEveryChangedByteIsAnErrorOrAMesh) {
  const std::string bytes = glb(document(R"([{"mesh":0}])", 5, ""), square_bytes());
  for (std::size_t i = 4; i < bytes.size(); ++i) {
    EXPECT_THROW(static_cast<void>(read("cut.glb", bytes.substr(0, i))), Error) << i;
    for (const char byte : {'9', '\xff'}) {
      std::string damaged = bytes;
      damaged[i] = byte;
      try {
        static_cast<void>(mesh("damaged.glb", damaged));
      } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::kInput) << error.what();
      }
    }
  }
}

}  // namespace
}  // namespace morsel::io
