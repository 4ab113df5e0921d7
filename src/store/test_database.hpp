// Shapes and folders for the tests of the database.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <morsel/database.hpp>
#include <string>
#include <vector>

#include "base/random.hpp"
#include "base/test_folder.hpp"
#include "base/test_shapes.hpp"

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
