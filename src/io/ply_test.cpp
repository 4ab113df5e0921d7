#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "base/random.hpp"
#include "io/bytes.hpp"
#include "io/test_files.hpp"

namespace morsel::io {
namespace {

class PlyTest : public FileTest {};

TEST_F(PlyTest, ReadsAsciiWithOtherElementsAround) {
  const PointCloud cloud =
      read("a.ply",
           "ply\r\nformat ascii 1.0\r\ncomment hello\r\nobj_info x\r\n"
           "element camera 1\r\nproperty list uchar int ids\r\n"
           "element vertex 2\r\nproperty uchar red\r\nproperty double z\r\n"
           "property float y\r\nproperty list uint8 float weights\r\n"
           "property int x\r\nelement tail 1\r\nproperty float t\r\n"
           "end_header\r\n3 1 2 3\r\n255 1.5 2 2 0.5 0.5 7\r\n0 2 1e3 0 -8\r\n9\r\n");
  EXPECT_EQ(cloud.points, (Points{{7, 2, 1.5}, {-8, 1000, 2}}));
  EXPECT_EQ(values_of<std::uint8_t>(cloud, "red"), (std::vector<std::uint8_t>{255, 0}));
  EXPECT_EQ(cloud.properties.size(), 1U);
}

TEST_F(PlyTest, FacesMakeAMeshAndPolygonsAreFanned) {
  const std::string text =
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
      "property float z\nelement face 2\nproperty uchar flag\n"
      "property list uchar uint vertex_index\nproperty list uchar float texcoord\n"
      "end_header\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n1 4 0 1 2 3 2 0.5 0.5\n0 2 0 1 0\n";
  const TriangleMesh quad = mesh("quad.ply", text);
  EXPECT_EQ(quad.triangles.size(), 2U);
  EXPECT_EQ(quad.triangles[1], (std::array<std::uint32_t, 3>{0, 2, 3}));
  EXPECT_TRUE(is_mesh_file(path("quad.ply")));
  EXPECT_EQ(read_points(path("quad.ply"), {.count = 10}).points.size(), 10U);
}

// A file made of random properties: what was written, byte for byte by this test, must be read.
struct RandomPly {
  struct Property {
    std::string name;
    ScalarType type;
    bool is_list = false;
  };
  std::vector<Property> properties;
  std::string bytes;
  Points points;
  std::vector<std::vector<double>> values;  // per property
};

constexpr std::array<const char*, 8> kShort = {"char", "uchar", "short", "ushort",
                                               "int",  "uint",  "float", "double"};
constexpr std::array<const char*, 8> kLong = {"int8",  "uint8",  "int16",   "uint16",
                                              "int32", "uint32", "float32", "float64"};
constexpr std::array<ScalarType, 8> kTypes = {
    ScalarType::kInt8,  ScalarType::kUint8,  ScalarType::kInt16,   ScalarType::kUint16,
    ScalarType::kInt32, ScalarType::kUint32, ScalarType::kFloat32, ScalarType::kFloat64};

enum class Coding { kAscii, kLittle, kBig };

template <class T>
void append_as(std::string& to, double value, bool big) {
  std::string raw;
  append_bytes(raw, static_cast<T>(value));
  if (big) std::reverse(raw.begin(), raw.end());
  to += raw;
}

void append_scalar(std::string& to, ScalarType type, double value, Coding coding) {
  if (coding == Coding::kAscii) {
    std::array<char, 40> text;
    std::snprintf(text.data(), text.size(), "%.17g ", value);
    to += text.data();
    return;
  }
  const bool big = coding == Coding::kBig;
  switch (type) {
    case ScalarType::kInt8:
      return append_as<std::int8_t>(to, value, big);
    case ScalarType::kUint8:
      return append_as<std::uint8_t>(to, value, big);
    case ScalarType::kInt16:
      return append_as<std::int16_t>(to, value, big);
    case ScalarType::kUint16:
      return append_as<std::uint16_t>(to, value, big);
    case ScalarType::kInt32:
      return append_as<std::int32_t>(to, value, big);
    case ScalarType::kUint32:
      return append_as<std::uint32_t>(to, value, big);
    case ScalarType::kFloat32:
      return append_as<float>(to, value, big);
    default:
      return append_as<double>(to, value, big);
  }
}

double random_value(ScalarType type, Random& random) {
  if (type == ScalarType::kFloat64) return 2e6 * random.uniform() - 1e6;
  if (type == ScalarType::kFloat32) return static_cast<float>(random.normal());
  const double span = std::ldexp(1.0, static_cast<int>(8 * size_of(type)));
  return std::floor(random.uniform() * span) - (is_signed(type) ? span / 2 : 0.0);
}

RandomPly make_random(Random& random, Coding coding) {
  RandomPly ply;
  const auto pick = [&] { return kTypes[random.below(kTypes.size())]; };
  for (const char* name : {"x", "y", "z"}) ply.properties.push_back({name, pick()});
  for (std::uint64_t i = random.below(5); i > 0; --i) {
    ply.properties.push_back({"p" + std::to_string(i), pick(), random.below(3) == 0});
  }
  for (std::size_t i = ply.properties.size(); i > 1; --i) {
    std::swap(ply.properties[i - 1], ply.properties[random.below(i)]);
  }
  const std::array<const char*, 3> format = {"ascii", "binary_little_endian", "binary_big_endian"};
  const std::size_t rows = 1 + random.below(20);
  ply.bytes = std::string("ply\nformat ") + format[static_cast<std::size_t>(coding)] +
              " 1.0\nelement vertex " + std::to_string(rows) + "\n";
  for (const auto& property : ply.properties) {
    const auto type = static_cast<std::size_t>(
        std::find(kTypes.begin(), kTypes.end(), property.type) - kTypes.begin());
    ply.bytes += std::string("property ") + (property.is_list ? "list uchar " : "") +
                 (random.below(2) == 0 ? kShort[type] : kLong[type]) + " " + property.name + "\n";
  }
  ply.bytes += "end_header\n";
  ply.values.resize(ply.properties.size());
  for (std::size_t row = 0; row < rows; ++row) {
    Vec3 point;
    for (std::size_t i = 0; i < ply.properties.size(); ++i) {
      const auto& [name, type, is_list] = ply.properties[i];
      const std::uint64_t count = is_list ? random.below(4) : 1;
      if (is_list) append_scalar(ply.bytes, ScalarType::kUint8, static_cast<double>(count), coding);
      for (std::uint64_t k = 0; k < count; ++k) {
        const double value = random_value(type, random);
        append_scalar(ply.bytes, type, value, coding);
        if (name == "x") point.x = value;
        if (name == "y") point.y = value;
        if (name == "z") point.z = value;
        ply.values[i].push_back(value);
      }
    }
    if (coding == Coding::kAscii) ply.bytes += "\n";
    ply.points.push_back(point);
  }
  return ply;
}

TEST_F(PlyTest, ReadsAnyPropertiesInAnyOrderTypeAndByteOrder) {
  Random random(11);
  for (int round = 0; round < 300; ++round) {
    const auto coding = static_cast<Coding>(round % 3);
    const RandomPly ply = make_random(random, coding);
    const PointCloud cloud = read("random.ply", ply.bytes);
    ASSERT_EQ(cloud.points, ply.points) << "round " << round;
    std::size_t next = 0;
    for (std::size_t i = 0; i < ply.properties.size(); ++i) {
      if (ply.properties[i].is_list || ply.properties[i].name.size() == 1) continue;
      const PointProperty& property = cloud.properties.at(next++);
      ASSERT_EQ(property.name, ply.properties[i].name);
      std::visit(
          [&](const auto& values) {
            ASSERT_TRUE(std::equal(values.begin(), values.end(), ply.values[i].begin(),
                                   ply.values[i].end(),
                                   [](auto a, double b) { return static_cast<double>(a) == b; }));
          },
          property.values);
    }
    ASSERT_EQ(next, cloud.properties.size());
  }
}

TEST_F(PlyTest, EveryTruncationAndEveryChangedByteIsAnErrorOrACloud) {
  Random random(5);
  for (const Coding coding : {Coding::kAscii, Coding::kLittle, Coding::kBig}) {
    const std::string bytes = make_random(random, coding).bytes;
    for (std::size_t i = 1; i < bytes.size(); ++i) {
      std::string damaged = bytes;
      damaged[i] = static_cast<char>(random.next());
      for (const std::string& file : {bytes.substr(0, i), damaged}) {
        try {
          static_cast<void>(read("damaged.ply", file));
        } catch (const Error& error) {
          ASSERT_EQ(error.code(), ErrorCode::kInput);
          ASSERT_FALSE(contains(error.what(), "\n"));
        }
      }
    }
  }
}

TEST_F(PlyTest, FloatTextKeepsTheDigitsThatAreThere) {
  const PointCloud cloud =
      read("far.ply",
           "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\n"
           "property float z\nend_header\n1000000.123 -2000000.456 0.1\n");
  EXPECT_EQ(cloud.points, (Points{{1000000.123, -2000000.456, 0.1}}));
}

}  // namespace
}  // namespace morsel::io
