// Shapes and folders for the tests of the database.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <morsel/database.hpp>
#include <string>
#include <vector>

#include "base/random.hpp"
#include "base/test_folder.hpp"
#include "base/test_shapes.hpp"
#include "store/connection.hpp"
#include "store/postgres.hpp"

namespace morsel::store {

/// What is stored of a dumbbell; other seeds give other points of the same shape, other bars
/// another shape.
inline ShapeData dumbbell_data(std::uint64_t seed = 1, double bar = 0.4) {
  const std::vector<Vec3> points = shapes::dumbbell(1500, bar, seed);
  const SegmentOptions options;
  return make_shape_data(segment(points, options), options, content_key(points, options));
}

/// Data of a content that no file has, from a signature that was changed a little at random.
inline ShapeData varied(ShapeData data, std::uint64_t seed) {
  Random random(seed);
  for (SignaturePart& part : data.signature.parts) {
    part.center = part.center + 0.2 * shapes::random_direction(random);
  }
  for (std::uint8_t& value : data.signature.tables) {
    value = static_cast<std::uint8_t>(value + random.below(std::min(20, 256 - value)));
  }
  data.signature = decode(encode(data.signature));
  const Vec3 key{static_cast<double>(seed), 0.0, 0.0};
  data.content = content_key(std::span(&key, 1), {});
  return data;
}

/// A folder of its own for each test.
class DatabaseTest : public ::testing::Test {
 protected:
  [[nodiscard]] Database create() const { return Database::open(file_, Access::kCreate); }

  [[nodiscard]] std::vector<std::string> names_in_folder() const {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder_)) {
      names.push_back(entry.path().filename().string());
    }
    std::sort(names.begin(), names.end());
    return names;
  }

  static std::string content(const std::filesystem::path& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }

  static void write(const std::filesystem::path& path, const std::string& bytes) {
    std::ofstream(path, std::ios::binary) << bytes;
  }

  TestFolder temporary_;
  std::filesystem::path folder_ = temporary_.path();
  std::filesystem::path file_ = folder_ / "shapes.db";
};

/// The same test for a file and, where tests/postgres.py runs it, for a PostgreSQL server.
class EachDatabaseTest : public DatabaseTest, public ::testing::WithParamInterface<const char*> {
 protected:
  void SetUp() override {
    if (!on_server()) return;
    const char* const address = std::getenv("MORSEL_TEST_POSTGRES");
    if (address == nullptr) GTEST_SKIP() << "run by tests/postgres.py";
    place_ = address;
    ::setenv("XDG_CACHE_HOME", folder_.c_str(), 1);
    // Made anew for each test.
    open_postgres(place_, Access::kCreate)->run_script("DROP SCHEMA IF EXISTS morsel CASCADE");
  }

  [[nodiscard]] bool on_server() const { return std::string(GetParam()) == "server"; }

  [[nodiscard]] Database open(Access access) const { return Database::open(place_, access); }
  [[nodiscard]] Database create() const { return open(Access::kCreate); }

  /// Statements past the program.
  void run(const std::string& statements) const {
    connect(place_, Access::kWrite)->run_script(statements);
  }
  [[nodiscard]] std::int64_t integer(const std::string& query) const {
    return connect(place_, Access::kRead)->integer(query).value();
  }

  std::string place_ = file_.string();
};

/// Runs the tests of a class derived from EachDatabaseTest. The names after the first are left out
/// by src/CMakeLists and run by tests/postgres.py.
#define MORSEL_FOR_EACH_DATABASE(Class)                             \
  INSTANTIATE_TEST_SUITE_P(File, Class, ::testing::Values("file")); \
  INSTANTIATE_TEST_SUITE_P(Server, Class, ::testing::Values("server"))

/// The message of the morsel::Error of `code` that `work` throws.
template <class Work>
std::string message_of(ErrorCode code, const Work& work) {
  try {
    work();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), code) << error.what();
    return error.what();
  }
  ADD_FAILURE() << "no Error was thrown";
  return {};
}

}  // namespace morsel::store
