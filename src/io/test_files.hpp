// Helpers of the io tests: a folder that goes away, files in it, and errors by their text.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <morsel/error.hpp>
#include <morsel/io.hpp>
#include <string>
#include <variant>
#include <vector>

#include "base/test_folder.hpp"

namespace morsel::io {

class FileTest : public ::testing::Test {
 protected:
  [[nodiscard]] std::filesystem::path path(const std::string& name) const { return folder_ / name; }
  std::filesystem::path write(const std::string& name, const std::string& bytes) const {
    std::ofstream(path(name), std::ios::binary) << bytes;
    return path(name);
  }
  PointCloud read(const std::string& name, const std::string& bytes) const {
    return read_points(write(name, bytes));
  }
  TriangleMesh mesh(const std::string& name, const std::string& bytes) const {
    return read_mesh(write(name, bytes));
  }

  TestFolder temporary_;
  std::filesystem::path folder_ = temporary_.path();
};

inline std::string content(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// The message of the Error that `action` throws; its code must be `code`.
template <class Action>
std::string error_of(Action action, ErrorCode code = ErrorCode::kInput) {
  try {
    action();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), code) << error.what();
    return error.what();
  }
  ADD_FAILURE() << "no error";
  return {};
}

inline bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// The values of property `name`, which must be there and hold T.
template <class T>
std::vector<T> values_of(const PointCloud& cloud, const std::string& name) {
  for (const PointProperty& property : cloud.properties) {
    if (property.name == name) return std::get<std::vector<T>>(property.values);
  }
  ADD_FAILURE() << "no property " << name;
  return {};
}

inline void PrintTo(const Vec3& p, std::ostream* out) {
  *out << '(' << p.x << ' ' << p.y << ' ' << p.z << ')';
}

using Points = std::vector<Vec3>;

}  // namespace morsel::io
