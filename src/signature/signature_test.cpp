#include <gtest/gtest.h>

#include <cmath>
#include <morsel/error.hpp>
#include <morsel/morsel.hpp>
#include <nlohmann/json.hpp>

#include "base/test_shapes.hpp"
#include "signature/tables.hpp"

namespace morsel {
namespace {

using shapes::Points;

// In general position: among points on one plane or sphere rounding decides which cells there are.
Points shape() {
  const Points both = shapes::joined(shapes::dumbbell(4000),
                                     shapes::moved(shapes::torus(3000, 1.5, 0.6), {6, 1, 0}));
  return shapes::noisy(both, 0.003);
}

Signature signature_of(const Points& points, int threads = 1) {
  SegmentOptions options;
  options.threads = threads;
  return make_signature(segment(points, options), threads);
}

TEST(SignatureTest, SurvivesBytesAndJson) {
  const Signature signature = signature_of(shape());
  ASSERT_GT(signature.parts.size(), 1U);
  const auto bytes = encode(signature);
  EXPECT_LE(bytes.size(), kMostSignatureBytes);
  EXPECT_EQ(decode(bytes), signature);
  EXPECT_EQ(signature_from_json(to_json(signature)), signature);
  EXPECT_EQ(encode(signature_from_json(to_json(signature))), bytes);
}

TEST(SignatureTest, EachDamagedByteIsNoticed) {
  const auto bytes = encode(signature_of(shape()));
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    auto damaged = bytes;
    damaged[i] ^= std::byte{1};
    EXPECT_THROW((void)decode(damaged, "file"), Error);
    EXPECT_THROW((void)decode(std::span(bytes).first(i)), Error);
  }
}

TEST(SignatureTest, SaysWhatIsWrong) {
  auto bytes = encode(signature_of(shape()));
  const auto message = [](const auto& call) -> std::string {
    try {
      call();
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::kInput);
      return error.what();
    }
    return {};
  };
  EXPECT_EQ(message([&] { (void)decode({}, "a.sig"); }),
            "a.sig: signature has 0 bytes; at least 48 are needed");
  bytes[4] = std::byte{9};
  EXPECT_EQ(message([&] { (void)decode(bytes); }),
            "signature is of version 9; this program reads version 1");
  EXPECT_NE(message([&] { (void)signature_from_json("{}", "a.json"); }).find("a.json"),
            std::string::npos);
  auto json = nlohmann::json::parse(to_json(signature_of(shape())));
  auto broken = json;
  broken["tables"][0] = 300;
  EXPECT_EQ(message([&] { (void)signature_from_json(broken.dump(), "a.json"); }),
            "a.json: not a signature: 300 where a whole number from 0 to 255 is expected");
  for (const nlohmann::json& wrong :
       {nlohmann::json(1e23), nlohmann::json(-1), nlohmann::json("1")}) {
    broken["tables"][0] = wrong;
    EXPECT_NE(message([&] { (void)signature_from_json(broken.dump()); }).find("a whole number"),
              std::string::npos);
  }
  json["parts"][0]["neighbors"] = {{{"part", 99}, {"neck_radius", 1.0}}};
  EXPECT_NE(message([&] { (void)signature_from_json(json.dump()); }).find("part 99"),
            std::string::npos);
}

TEST(SignatureTest, TheLargestFitsAKilobyte) {
  Signature signature;
  signature.size = 1.0;
  signature.tables.assign(kTableSize, 255);
  signature.parts.resize(kMostSignatureParts);
  for (int a = 0; a < static_cast<int>(kMostSignatureParts); ++a) {
    for (int b = 0; b < static_cast<int>(kMostSignatureParts); ++b) {
      if (a != b) signature.parts[a].neighbors.push_back({b, 1.0});
    }
  }
  EXPECT_LE(encode(signature).size(), kMostSignatureBytes);
  EXPECT_EQ(decode(encode(decode(encode(signature)))), decode(encode(signature)));
  signature.parts.emplace_back();
  EXPECT_THROW((void)encode(signature), Error);
}

// Values may move by one step of rounding, no more; and few of them do.
void expect_same_tables(const Signature& a, const Signature& b) {
  ASSERT_EQ(a.tables.size(), b.tables.size());
  int changed = 0;
  for (std::size_t i = 0; i < a.tables.size(); ++i) {
    EXPECT_LE(std::abs(a.tables[i] - b.tables[i]), 1) << "value " << i;
    changed += a.tables[i] != b.tables[i] ? 1 : 0;
  }
  EXPECT_LE(changed, 3);
}

TEST(SignatureTest, PoseScaleAndMirroringChangeNothing) {
  const Points points = shape();
  const Signature base = signature_of(points);
  expect_same_tables(signature_of(shapes::turned(points, shapes::rotation())), base);
  expect_same_tables(signature_of(shapes::moved(points, {30, -20, 10})), base);
  expect_same_tables(signature_of(shapes::scaled(points, 1e3)), base);
  const auto mirror = [](const Vec3& p) { return Vec3{-p.x, p.y, p.z}; };
  expect_same_tables(signature_of(shapes::changed(points, mirror)), base);
}

// Most landmarks stand for a few points then.
TEST(SignatureTest, PoseChangesNothingWithFewPoints) {
  const Points points = shapes::noisy(shapes::dumbbell(700), 0.01);
  const Points exchanged = shapes::changed(points, [](const Vec3& p) {
    return Vec3{p.z + 3.0, p.x - 2.0, p.y + 1.0};
  });
  SegmentOptions options;
  options.denoise.rounds = 0;
  const auto signature = [&](const Points& cloud) {
    return make_signature(segment(cloud, options));
  };
  const Signature base = signature(points);
  expect_same_tables(signature(exchanged), base);
  expect_same_tables(signature(shapes::turned(points, shapes::rotation())), base);
}

TEST(SignatureTest, OrderAndThreadsChangeNoBit) {
  const Points points = shape();
  const Signature base = signature_of(points);
  EXPECT_EQ(signature_of(points, 2), base);
  EXPECT_EQ(signature_of(shapes::permuted(points, shapes::permutation(points.size()))), base);
}

TEST(SignatureTest, ThePartsAreThoseOfTheSegmentation) {
  const Segmentation s = segment(shape());
  const Signature signature = make_signature(s);
  ASSERT_EQ(signature.parts.size(), std::min(s.parts.parts.size(), kMostSignatureParts));
  for (std::size_t i = 0; i < signature.parts.size(); ++i) {
    const Part& part = s.parts.parts[i];
    EXPECT_NEAR(signature.parts[i].weight, part.volume / s.interior.volume, 2e-5);
    const Vec3 center = signature.centroid + signature.size * signature.parts[i].center;
    EXPECT_LT(distance(center, part.center), 1e-3 * signature.size);
  }
}

TEST(SignatureTest, CloudsThatAreNoSolid) {
  EXPECT_EQ(signature_of({}).size, 0.0);
  EXPECT_EQ(signature_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}).size, 0.0);
  const Signature cube = signature_of(shapes::cube_cloud(200));
  EXPECT_GT(cube.size, 0.0);
  EXPECT_EQ(decode(encode(cube)), cube);
  const Signature tetrahedron = signature_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}});
  EXPECT_EQ(decode(encode(tetrahedron)), tetrahedron);
}

}  // namespace
}  // namespace morsel
