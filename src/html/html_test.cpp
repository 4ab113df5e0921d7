#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <morsel/morsel.hpp>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "base/base64.hpp"
#include "base/test_folder.hpp"
#include "base/test_shapes.hpp"
#include "html/shape_json.hpp"
#include "html/test_tree.hpp"
#include "html/viewer.hpp"

namespace morsel {
namespace {

using Json = nlohmann::json;

template <typename Value>
std::vector<Value> decoded(const Json& field) {
  const std::string bytes = decode_base64(field["data"].get<std::string>()).value();
  std::vector<Value> values(bytes.size() / sizeof(Value));
  std::memcpy(values.data(), bytes.data(), values.size() * sizeof(Value));
  return values;
}

struct Case {
  shapes::Points points = shapes::dumbbell(3000);
  MergeTree tree = shapes::random_tree(60, 3000);

  [[nodiscard]] Json json(const HtmlOptions& options = {}) const {
    return Json::parse(shape_json(points, tree, options));
  }
};

TEST(ShapeJson, HoldsTheTreeExactly) {
  const Case shape;
  const Json tree = shape.json()["tree"];
  const auto moments = decoded<double>(tree["moments"]);
  const auto ratios = decoded<double>(tree["merge_ratio"]);
  const auto a = decoded<std::uint32_t>(tree["merge_a"]);
  const auto significant = decoded<std::uint8_t>(tree["merge_significant"]);
  ASSERT_EQ(moments.size(), 10 * shape.tree.moments.size());
  ASSERT_EQ(ratios.size(), shape.tree.merges.size());
  for (std::size_t i = 0; i < ratios.size(); ++i) {
    EXPECT_EQ(ratios[i], shape.tree.merges[i].ratio);
    EXPECT_EQ(a[i], shape.tree.merges[i].a);
    EXPECT_EQ(significant[i] != 0, shape.tree.merges[i].significant);
  }
  EXPECT_EQ(moments[10], shape.tree.moments[1].volume);
  EXPECT_EQ(moments[19], shape.tree.moments[1].second[5]);
  EXPECT_EQ(decoded<std::uint32_t>(tree["point_count"]), shape.tree.point_count);
  EXPECT_EQ(tree["objects"], 3);
}

TEST(ShapeJson, PointsAreWhereTheyWere) {
  const Case shape{.points = shapes::moved(shapes::even_sphere(3000), {5, 6, 7})};
  const Json json = shape.json();
  const auto positions = decoded<std::uint16_t>(json["points"]["positions"]);
  const auto pieces = decoded<std::uint16_t>(json["points"]["pieces"]);
  ASSERT_EQ(positions.size(), 3 * shape.points.size());
  ASSERT_EQ(pieces.size(), shape.points.size());
  const double scale = json["scale"];
  for (std::size_t i = 0; i < shape.points.size(); ++i) {
    const Vec3 p{json["center"][0].get<double>() + scale * (positions[3 * i] / 32767.5 - 1.0),
                 json["center"][1].get<double>() + scale * (positions[3 * i + 1] / 32767.5 - 1.0),
                 json["center"][2].get<double>() + scale * (positions[3 * i + 2] / 32767.5 - 1.0)};
    // Points are shown on the surface that their neighbours span.
    EXPECT_LT(distance(p, shape.points[i]), 0.01);
    EXPECT_EQ(pieces[i], shape.tree.piece_of_point[i]);
  }
}

TEST(ShapeJson, TellsTheCutAndTheColours) {
  const Case shape;
  EXPECT_EQ(shape.json()["merge_ratio"], 1.4);
  EXPECT_EQ(shape.json({.merge_ratio = 2.5})["merge_ratio"], 2.5);
  const Json palette = shape.json()["palette"];
  ASSERT_EQ(palette.size(), 240U);
  for (int part = 0; part < 240; ++part) {
    EXPECT_EQ(palette[part].get<Color>(), part_color(part));
  }
}

TEST(ShapeJson, NoNameBreaksOut) {
  const Case shape;
  const std::string name = "</script><script>alert(1)</script><!--\"\\\n\xff";
  const std::string text = shape_json(shape.points, shape.tree, {.name = name});
  EXPECT_EQ(text.find('<'), std::string::npos);
  EXPECT_EQ(Json::parse(text)["name"], "</script><script>alert(1)</script><!--\"\\\n\xef\xbf\xbd");
}

TEST(ShapeJson, MorePointsThanWantedAreMerged) {
  const std::size_t count = 30'000;
  const shapes::Points points = shapes::torus(count, 2.0, 0.6);
  const MergeTree tree = shapes::random_tree(1000, count);
  const Json json = Json::parse(shape_json(points, tree, {.most_points = 5000}));
  const std::size_t shown = decoded<std::uint16_t>(json["points"]["pieces"]).size();
  EXPECT_LE(shown, 5000U);
  EXPECT_GT(shown, 2500U);
  EXPECT_EQ(json["points_of_input"], count);
}

TEST(ShapeJson, ManyPiecesAndPointsWithoutOne) {
  const std::uint32_t pieces = 70'000;
  Case shape;
  shape.tree = shapes::random_tree(pieces, shape.points.size());
  shape.tree.piece_of_point[5] = kNoBasin;
  const Json field = shape.json()["points"]["pieces"];
  EXPECT_EQ(field["type"], "u32");
  EXPECT_EQ(decoded<std::uint32_t>(field)[5], pieces);
}

TEST(ShapeJson, FewPointsAreBalls) {
  const shapes::Points points = shapes::sphere(50);
  const MergeTree tree = shapes::random_tree(4, points.size());
  const Json json = Json::parse(shape_json(points, tree, {}));
  const auto radii = decoded<std::uint8_t>(json["points"]["radii"]);
  ASSERT_EQ(radii.size(), 100U);
  EXPECT_EQ(radii[0], 255);
  EXPECT_EQ(radii[1], 0);
}

TEST(PictureJson, PiecesAreTheParts) {
  const shapes::Points points = shapes::even_sphere(500);
  std::vector<int> parts(points.size(), 1);
  parts[0] = -1;
  const Json json = Json::parse(picture_json(points, parts, 2));
  const auto pieces = decoded<std::uint16_t>(json["points"]["pieces"]);
  ASSERT_EQ(pieces.size(), points.size());
  EXPECT_EQ(pieces[0], 2);
  EXPECT_EQ(pieces[1], 1);
  EXPECT_EQ(json["palette"].size(), 240U);
  EXPECT_FALSE(json.contains("tree"));
}

TEST(HtmlPage, OptionsAndSizesAreChecked) {
  const Case shape;
  EXPECT_THROW(HtmlOptions{.merge_ratio = 0.5}.check(), Error);
  EXPECT_THROW(HtmlOptions{.most_points = 10}.check(), Error);
  EXPECT_THROW((void)html_page(shapes::sphere(5), shape.tree), Error);
}

TEST(HtmlPage, HoldsTheViewerAndTheShape) {
  const Case shape;
  if (!has_html_viewer()) {
    EXPECT_THROW((void)html_page(shape.points, shape.tree), Error);
    GTEST_SKIP() << "built without the viewer";
  }
  EXPECT_LT(viewer_page().size(), 3'000'000U);
  const std::string page = html_page(shape.points, shape.tree, {.name = "a<b"});
  EXPECT_TRUE(page.starts_with("<!doctype html>"));
  EXPECT_EQ(page.find(kShapeMark), std::string::npos);
  EXPECT_NE(page.find("\"name\":\"a\\u003cb\""), std::string::npos);
  EXPECT_NE(page.find("default-src 'none'"), std::string::npos);
  EXPECT_EQ(page, html_page(shape.points, shape.tree, {.name = "a<b"}));
  const TestFolder folder;
  const auto path = folder.path() / "page.html";
  write_html(path, shape.points, shape.tree, {.name = "a<b"});
  std::ifstream file(path, std::ios::binary);
  EXPECT_EQ(std::string(std::istreambuf_iterator<char>(file), {}), page);
}

}  // namespace
}  // namespace morsel
