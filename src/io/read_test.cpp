#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fstream>
#include <string>
#include <thread>

#include "io/test_files.hpp"

namespace morsel::io {
namespace {

class ReadTest : public FileTest {};

const Points kOne = {{1, 2, 3}};
const std::string kPly =
    "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\n"
    "property float z\nend_header\n1 2 3\n";

TEST_F(ReadTest, ContentDecidesWhereItIsUnmistakable) {
  EXPECT_EQ(read("a.xyz", kPly).points, kOne);
  EXPECT_EQ(read("a", kPly).points, kOne);
  EXPECT_EQ(read("a.ply", "OFF\n1 0 0\n1 2 3\n").points, kOne);
  EXPECT_EQ(read("a.xyz", "# comment\nv 1 2 3\n").points, kOne);
  EXPECT_EQ(read("a.csv",
                 "# .PCD v0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nPOINTS 1\n"
                 "DATA ascii\n1 2 3\n")
                .points,
            kOne);
}

TEST_F(ReadTest, PlainNumbersNeedNoExtension) {
  EXPECT_EQ(read("scan", "1 2 3\n").points, kOne);
  EXPECT_EQ(read("scan.dat", "x y z\n1 2 3\n").points, kOne);
  EXPECT_EQ(read("SCAN.XYZ", "1 2 3\n").points, kOne);
}

TEST_F(ReadTest, NamesWhatIsNotAFile) {
  const auto message = [&](const std::filesystem::path& path) {
    return error_of([&] { static_cast<void>(read_points(path)); });
  };
  EXPECT_TRUE(contains(message(folder_), "is a directory; name a file"));
  EXPECT_TRUE(contains(message(path("none.ply")), "none.ply: cannot read: No such file"));
  EXPECT_TRUE(contains(message(write("empty.xyz", "")), "is empty"));
  EXPECT_FALSE(contains(message(path("two\nlines.ply")), "\n"));
}

TEST_F(ReadTest, UnreadableFilesAreAnError) {
  const auto file = write("secret.xyz", "1 2 3\n");
  std::filesystem::permissions(file, std::filesystem::perms::none);
  const uid_t user = ::geteuid();
  constexpr uid_t kNobody = 65534;
  if (user == 0) {  // root may read everything
    ASSERT_EQ(::seteuid(kNobody), 0);
  }
  const std::string message = error_of([&] { static_cast<void>(read_points(file)); });
  ASSERT_EQ(::seteuid(user), 0);
  EXPECT_TRUE(contains(message, "secret.xyz: cannot read: Permission denied")) << message;
}

TEST_F(ReadTest, PipesAreReadToTheirEnd) {
  ASSERT_EQ(::mkfifo(path("pipe").c_str(), 0600), 0);
  std::thread writer([&] {
    std::ofstream out(path("pipe"));
    for (int i = 0; i < 50000; ++i) out << i << " 2 3\n";
  });
  const PointCloud cloud = read_points(path("pipe"));
  writer.join();
  EXPECT_EQ(cloud.points.size(), 50000U);
  EXPECT_EQ(cloud.points.back(), (Vec3{49999, 2, 3}));
}

TEST_F(ReadTest, DashIsStandardInput) {
  const auto file = write("input.xyz", "1 2 3\n");
  const int saved = ::dup(STDIN_FILENO);
  const int replacement = ::open(file.c_str(), O_RDONLY);
  ::dup2(replacement, STDIN_FILENO);
  EXPECT_FALSE(is_mesh_file("-"));
  EXPECT_EQ(read_points("-").points, kOne);
  ::dup2(saved, STDIN_FILENO);
  ::close(saved);
  ::close(replacement);
}

TEST_F(ReadTest, MeshesAreSampledAsAsked) {
  const auto file = write("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  const PointCloud cloud = read_points(file, {.count = 50, .seed = 3});
  EXPECT_EQ(cloud.points, sample_surface(read_mesh(file), {.count = 50, .seed = 3}).points);
  error_of([&] { static_cast<void>(read_points(file, {.count = 0})); }, ErrorCode::kUsage);
}

TEST(ParsePoints, ReadsBytesByTheirNameAndNoOtherFile) {
  const PointCloud cloud = parse_points("1 2 3\n4 5 6\n", "a.xyz");
  ASSERT_EQ(cloud.points.size(), 2U);
  EXPECT_EQ(cloud.points[1], (Vec3{4, 5, 6}));
  const auto failure = [](std::string bytes, const std::string& name) -> std::string {
    try {
      (void)parse_points(std::move(bytes), name);
    } catch (const Error& error) {
      return error.what();
    }
    return {};
  };
  EXPECT_TRUE(failure("", "a\nb.ply").starts_with("a\\x0ab.ply: "));
  const std::string gltf =
      R"({"asset":{"version":"2.0"},"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],)"
      R"("meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],)"
      R"("accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}],)"
      R"("bufferViews":[{"buffer":0,"byteLength":36}],)"
      R"("buffers":[{"byteLength":36,"uri":"../secret.bin"}]})";
  EXPECT_NE(failure(gltf, "a.gltf").find("another file"), std::string::npos);
}

}  // namespace
}  // namespace morsel::io
