#include <gtest/gtest.h>
#include <png.h>
#include <tbb/global_control.h>

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <morsel/error.hpp>
#include <morsel/picture.hpp>
#include <numbers>
#include <string>
#include <vector>

#include "base/random.hpp"
#include "base/test_folder.hpp"
#include "base/test_shapes.hpp"
#include "picture/contour.hpp"
#include "picture/raster.hpp"
#include "picture/surfels.hpp"
#include "picture/text.hpp"
#include "picture/views.hpp"

namespace morsel {
namespace {

namespace fs = std::filesystem;

struct Labelled {
  std::vector<Vec3> points;
  std::vector<int> labels;

  void add(const Vec3& point, int label) {
    points.push_back(point);
    labels.push_back(label);
  }
};

Vec3 random_direction(Random& random) {
  const double z = 2.0 * random.uniform() - 1.0;
  const double angle = 2.0 * std::numbers::pi * random.uniform();
  const double r = std::sqrt(1.0 - z * z);
  return {r * std::cos(angle), r * std::sin(angle), z};
}

// A sphere of three parts, slices around z.
Labelled sphere(std::size_t count, double radius = 1.0, const Vec3& center = {}) {
  Random random(5);
  Labelled cloud;
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3 p = random_direction(random);
    const double turn = (std::atan2(p.y, p.x) / std::numbers::pi + 1.0) * 1.5;
    cloud.add(center + radius * p, std::min(2, static_cast<int>(turn)));
  }
  return cloud;
}

// Parts whose hues can be told apart.
constexpr std::array<int, 6> kSides{0, 1, 2, 3, 6, 9};

// A box with sides 3, 2 and 1, one part a side.
Labelled box(std::size_t count) {
  Random random(9);
  Labelled cloud;
  for (std::size_t i = 0; i < count; ++i) {
    const double u = random.uniform();
    const double v = random.uniform();
    switch (random.below(6)) {
      case 0:
        cloud.add({0, 2 * u, v}, kSides[0]);
        break;
      case 1:
        cloud.add({3, 2 * u, v}, kSides[1]);
        break;
      case 2:
        cloud.add({3 * u, 0, v}, kSides[2]);
        break;
      case 3:
        cloud.add({3 * u, 2, v}, kSides[3]);
        break;
      case 4:
        cloud.add({3 * u, 2 * v, 0}, kSides[4]);
        break;
      default:
        cloud.add({3 * u, 2 * v, 1}, kSides[5]);
    }
  }
  return cloud;
}

double hue(double r, double g, double b) {
  return std::atan2(std::sqrt(3.0) * (g - b), 2.0 * r - g - b) * 180.0 / std::numbers::pi;
}

// Pixels of about the part's hue and enough colour to have one.
std::size_t pixels_of(const Image& image, int part) {
  const Color color = part_color(part);
  const double wanted = hue(color[0], color[1], color[2]);
  std::size_t count = 0;
  for (std::size_t i = 0; i < image.rgb.size(); i += 3) {
    const auto [low, high] = std::minmax({image.rgb[i], image.rgb[i + 1], image.rgb[i + 2]});
    if (high - low < 60) continue;
    const double difference = hue(image.rgb[i], image.rgb[i + 1], image.rgb[i + 2]) - wanted;
    if (std::abs(std::remainder(difference, 360.0)) < 12.0) ++count;
  }
  return count;
}

bool is_white(const Image& image, std::size_t x, std::size_t y) {
  const std::uint8_t* pixel = &image.rgb[(y * image.width + x) * 3];
  return pixel[0] == 255 && pixel[1] == 255 && pixel[2] == 255;
}

std::size_t coloured_pixels(const Image& image) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < image.width * image.height; ++i) {
    if (!is_white(image, i % image.width, i / image.width)) ++count;
  }
  return count;
}

Image decode_png(const fs::path& path) {
  png_image header;
  std::memset(&header, 0, sizeof header);
  header.version = PNG_IMAGE_VERSION;
  Image image;
  if (png_image_begin_read_from_file(&header, path.c_str()) == 0) return image;
  header.format = PNG_FORMAT_RGB;
  image = {header.width, header.height, std::vector<std::uint8_t>(PNG_IMAGE_SIZE(header))};
  png_image_finish_read(&header, nullptr, image.rgb.data(), 0, nullptr);
  return image;
}

std::string content(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

template <typename Body>
void expect_error(ErrorCode code, const std::string& part, const Body& body) {
  try {
    body();
    FAIL() << "no error; expected one about " << part;
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), code);
    EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
  }
}

class PictureFileTest : public ::testing::Test {
 protected:
  TestFolder temporary_;
  fs::path folder_ = temporary_.path();
};

TEST(PictureTest, ShowsEveryPartInItsColourOnWhite) {
  const Labelled cloud = sphere(4000);
  const Image image = render_parts(cloud.points, cloud.labels, {.width = 300, .views = 4});
  ASSERT_EQ(image.width, 300U);
  ASSERT_EQ(image.rgb.size(), image.width * image.height * 3);
  for (int part = 0; part < 3; ++part) EXPECT_GT(pixels_of(image, part), 500U) << part;
  for (const int part : {3, 6, 9}) EXPECT_LT(pixels_of(image, part), 30U) << part;
  EXPECT_TRUE(is_white(image, 0, 0));
  EXPECT_TRUE(is_white(image, image.width - 1, 0));
  EXPECT_TRUE(is_white(image, 0, image.height - 1));
  EXPECT_TRUE(is_white(image, image.width - 1, image.height - 1));
}

TEST(PictureTest, FillsItsCellAndClosesTheSurface) {
  const Labelled cloud = sphere(4000);
  const Image image = render_parts(cloud.points, cloud.labels, {.width = 200, .views = 1});
  EXPECT_NEAR(static_cast<double>(image.height), 200.0, 4.0);
  // A disc of 0.93 of the width.
  const double disc = std::numbers::pi / 4.0 * std::pow(0.93 * 200.0, 2);
  EXPECT_NEAR(static_cast<double>(coloured_pixels(image)), disc, 0.05 * disc);
  for (std::size_t x = 40; x < 160; ++x) EXPECT_FALSE(is_white(image, x, image.height / 2));
}

TEST(PictureTest, InnerPartsAreHidden) {
  Labelled cloud = sphere(6000);
  std::fill(cloud.labels.begin(), cloud.labels.end(), 0);
  const Labelled core = sphere(3000, 0.6);
  for (const Vec3& p : core.points) cloud.add(p, 3);
  const Image image = render_parts(cloud.points, cloud.labels, {.width = 300, .views = 2});
  EXPECT_GT(pixels_of(image, 0), 5000U);
  EXPECT_LT(pixels_of(image, 3), 20U);
}

// The same two sheets from both sides.
TEST(PictureTest, TheFrontOfTwoSheetsWins) {
  Random random(2);
  picture::Cloud cloud;
  for (int i = 0; i < 6000; ++i) {
    const auto x = static_cast<float>(2.0 * random.uniform() - 1.0);
    const auto y = static_cast<float>(2.0 * random.uniform() - 1.0);
    cloud.points.emplace_back(x, y, i % 2 == 0 ? 0.3F : -0.3F);
    cloud.labels.push_back(i % 2);
  }
  const std::vector<picture::Surfel> surfels = picture::make_surfels(cloud);
  picture::Camera camera{Eigen::Matrix3f::Identity(), 50.0F, 60.0F, 60.0F, 120, 120};
  for (const int front : {0, 1}) {
    const picture::Surface surface = picture::rasterize(surfels, camera, 0.5F);
    for (std::size_t y = 20; y < 100; ++y) {
      for (std::size_t x = 20; x < 100; ++x) {
        ASSERT_TRUE(surface.at(x, y).is_surface()) << x << ' ' << y;
        ASSERT_EQ(surface.at(x, y).label, front) << x << ' ' << y;
        ASSERT_NEAR(surface.at(x, y).depth, 15.0F, 0.5F);
      }
    }
    camera.rotation = Eigen::Vector3f(-1, 1, -1).asDiagonal();  // half a turn about y
  }
}

TEST(PictureTest, EdgesOfABoxStaySharp) {
  const Labelled cloud = box(12000);
  const picture::Cloud normal = picture::normalize(cloud.points, cloud.labels);
  std::size_t slanted = 0;
  for (const picture::Surfel& surfel : picture::make_surfels(normal)) {
    if (surfel.normal.cwiseAbs().maxCoeff() < 0.95F) ++slanted;
  }
  EXPECT_LT(slanted, 12000U / 25U);
}

TEST(PictureTest, NoiseIsSmoothedAway) {
  Labelled cloud = sphere(20000);
  Random random(4);
  for (Vec3& p : cloud.points) p = (1.0 + 0.012 * random.normal()) * p;
  const picture::Cloud normal = picture::normalize(cloud.points, cloud.labels);
  double squares = 0.0;
  double cosines = 0.0;
  const std::vector<picture::Surfel> surfels = picture::make_surfels(normal);
  const double radius = 1.0 / (1.0 + 4.0 * 0.012);  // about, in the normalized frame
  for (const picture::Surfel& surfel : surfels) {
    const double r = surfel.position.norm();
    squares += std::pow(r / radius - 1.0, 2) / static_cast<double>(surfels.size());
    cosines += std::abs(surfel.position.normalized().dot(surfel.normal)) /
               static_cast<double>(surfels.size());
  }
  EXPECT_LT(std::sqrt(squares), 0.03);
  EXPECT_GT(cosines, 0.99);
}

TEST(PictureTest, ViewsAreProperRotationsAndDiffer) {
  const Labelled cloud = box(12000);
  const picture::Cloud normal = picture::normalize(cloud.points, cloud.labels);
  const std::vector<Eigen::Matrix3f> views = picture::choose_views(normal.points, 4);
  ASSERT_EQ(views.size(), 4U);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(views[i].determinant(), 1.0F, 1e-4F);
    EXPECT_LT((views[i] * views[i].transpose() - Eigen::Matrix3f::Identity()).norm(), 1e-4F);
    for (std::size_t j = 0; j < i; ++j) EXPECT_GT((views[i] - views[j]).norm(), 0.5F);
  }
  // Front and back together show more sides than one view can.
  const Image one = render_parts(cloud.points, cloud.labels, {.width = 300, .views = 1});
  const Image four = render_parts(cloud.points, cloud.labels, {.width = 600, .views = 4});
  const auto sides = [](const Image& image) {
    int count = 0;
    for (const int part : kSides) count += pixels_of(image, part) > 600 ? 1 : 0;
    return count;
  };
  EXPECT_LE(sides(one), 3);
  EXPECT_GE(sides(four), 5);
}

TEST(PictureTest, SameBytesForAnyNumberOfThreads) {
  const Labelled cloud = sphere(20000);
  const PictureOptions options{.width = 200, .views = 2, .title = "threads"};
  const Image many = render_parts(cloud.points, cloud.labels, options);
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 1);
  const Image one = render_parts(cloud.points, cloud.labels, options);
  EXPECT_EQ(one.rgb, many.rgb);
}

TEST(PictureTest, PositionAndScaleDoNotMatter) {
  const Labelled near = sphere(3000);
  // 2^20 and 2^-30 keep the coordinates exact enough to compare pictures by area.
  const Labelled far = sphere(3000, 1.0, {1048576.0, -1048576.0, 2097152.0});
  const Labelled tiny = sphere(3000, 0x1p-30);
  const Labelled huge = sphere(3000, 1e300);
  const PictureOptions options{.width = 128, .views = 1};
  const std::vector<std::uint8_t> expected = render_parts(near.points, near.labels, options).rgb;
  EXPECT_EQ(render_parts(tiny.points, tiny.labels, options).rgb, expected);
  const auto area =
      static_cast<double>(coloured_pixels(render_parts(near.points, near.labels, options)));
  for (const Labelled& cloud : {far, huge}) {
    const Image image = render_parts(cloud.points, cloud.labels, options);
    EXPECT_NEAR(static_cast<double>(coloured_pixels(image)), area, 0.02 * area);
  }
}

TEST(PictureTest, DegenerateCloudsDraw) {
  struct Case {
    const char* name;
    Labelled cloud;
    bool visible = true;
  };
  std::vector<Case> cases(7);
  cases[0] = {"empty", {}, false};
  cases[1].name = "one point";
  cases[1].cloud.add({3, 4, 5}, 1);
  cases[2].name = "two points";
  cases[2].cloud.add({0, 0, 0}, 1);
  cases[2].cloud.add({1, 1, 1}, -7);
  cases[3].name = "all the same";
  cases[4].name = "on a line";
  cases[5].name = "in a plane";
  cases[6].name = "a grid";
  Random random(1);
  for (int i = 0; i < 1000; ++i) {
    cases[3].cloud.add({1e6, 1e6, 1e6}, i % 3);
    cases[4].cloud.add(random.uniform() * Vec3{1, 2, 3}, i % 3);
    cases[5].cloud.add({random.uniform(), 1.0, random.uniform()}, i % 3);
    cases[6].cloud.add({1.0 * (i % 10), 1.0 * (i / 10 % 10), 1.0 * (i / 100)}, i % 3);
  }
  for (const Case& test : cases) {
    SCOPED_TRACE(test.name);
    for (const std::size_t views : {1U, 2U, 3U, 4U}) {
      const Image image =
          render_parts(test.cloud.points, test.cloud.labels, {.width = 128, .views = views});
      EXPECT_EQ(image.width, 128U);
      EXPECT_EQ(image.rgb.size(), image.width * image.height * 3);
      EXPECT_LE(image.height, 140U);
      EXPECT_EQ(coloured_pixels(image) > 20, test.visible);
    }
  }
}

TEST(PictureTest, PointsThatAreNotFiniteAreLeftOut) {
  Labelled cloud = sphere(1000);
  const Image expected = render_parts(cloud.points, cloud.labels, {.width = 100, .views = 1});
  cloud.add({std::nan(""), 0, 0}, 0);
  cloud.add({0, INFINITY, 0}, 0);
  EXPECT_EQ(render_parts(cloud.points, cloud.labels, {.width = 100, .views = 1}).rgb, expected.rgb);
}

TEST(PictureTest, AFewOutliersDoNotShrinkTheObject) {
  Labelled cloud = sphere(5000);
  const PictureOptions options{.width = 200, .views = 1};
  const auto area =
      static_cast<double>(coloured_pixels(render_parts(cloud.points, cloud.labels, options)));
  Random random(3);
  for (int i = 0; i < 10; ++i) cloud.add(5.0 * random_direction(random), 1);
  const Image image = render_parts(cloud.points, cloud.labels, options);
  EXPECT_GT(static_cast<double>(coloured_pixels(image)), 0.9 * area);
}

TEST(PictureTest, TitleIsDrawnAboveAndCutToTheWidth) {
  const Labelled cloud = sphere(1000);
  PictureOptions options{.width = 200, .views = 1};
  const Image plain = render_parts(cloud.points, cloud.labels, options);
  options.title = "A title";
  const Image titled = render_parts(cloud.points, cloud.labels, options);
  EXPECT_GT(titled.height, plain.height);
  EXPECT_GT(coloured_pixels(titled), coloured_pixels(plain));
  options.title = std::string(500, 'W') + "\xc3\xa9";
  const Image cut = render_parts(cloud.points, cloud.labels, options);
  EXPECT_EQ(cut.height, titled.height);
  for (std::size_t y = 0; y < cut.height; ++y) EXPECT_TRUE(is_white(cut, 0, y));
}

TEST(PictureTest, BadArgumentsAreNamed) {
  const Labelled cloud = sphere(10);
  const auto render = [&](const PictureOptions& options) {
    return [&cloud, options] { (void)render_parts(cloud.points, cloud.labels, options); };
  };
  expect_error(ErrorCode::kUsage, "width is 63; it must be 64 to 8192", render({.width = 63}));
  expect_error(ErrorCode::kUsage, "width is 8193", render({.width = 8193}));
  expect_error(ErrorCode::kUsage, "views is 0; it must be 1 to 4", render({.views = 0}));
  expect_error(ErrorCode::kUsage, "views is 5", render({.views = 5}));
  expect_error(ErrorCode::kUsage, "9 labels for 10 points",
               [&] { (void)render_parts(cloud.points, std::span(cloud.labels).first(9)); });
}

TEST_F(PictureFileTest, PngDecodesToTheImage) {
  const Labelled cloud = sphere(2000);
  const PictureOptions options{.width = 160, .views = 2};
  write_picture(folder_ / "sphere.PNG", cloud.points, cloud.labels, options);
  const Image expected = render_parts(cloud.points, cloud.labels, options);
  const Image decoded = decode_png(folder_ / "sphere.PNG");
  EXPECT_EQ(decoded.width, 160U);
  EXPECT_EQ(decoded.height, expected.height);
  EXPECT_EQ(decoded.rgb, expected.rgb);
}

TEST_F(PictureFileTest, WritingErrorsNameTheFileAndLeaveNothing) {
  const Labelled cloud = sphere(100);
  const auto write = [&](const fs::path& path) {
    return [&cloud, path] { write_picture(path, cloud.points, cloud.labels, {.width = 64}); };
  };
  expect_error(ErrorCode::kUsage, "a.jpg: a picture's name must end in .png or .svg",
               write(folder_ / "a.jpg"));
  expect_error(ErrorCode::kUsage, "must end in", write(folder_ / "noextension"));
  expect_error(ErrorCode::kOutput, "missing/a.png", write(folder_ / "missing" / "a.png"));
  expect_error(ErrorCode::kOutput, "missing/a.svg", write(folder_ / "missing" / "a.svg"));
  const fs::path path = folder_ / "b.png";
  expect_error(ErrorCode::kUsage, "image of 0 x 0", [&] { write_png(path, {}); });
  expect_error(ErrorCode::kUsage, "with 5 bytes", [&] {
    write_png(path, {1, 2, std::vector<std::uint8_t>(5)});
  });
  EXPECT_TRUE(fs::is_empty(folder_));
}

// Checks that tags nest and that no markup is left bare: enough of XML for this writer.
void expect_well_formed(const std::string& xml) {
  std::vector<std::string> open;
  for (std::size_t i = 0; i < xml.size();) {
    const std::size_t tag = xml.find('<', i);
    const std::string text = xml.substr(i, tag - i);
    EXPECT_EQ(text.find('>'), std::string::npos) << text.substr(0, 80);
    if (tag == std::string::npos) break;
    const std::size_t end = xml.find('>', tag);
    ASSERT_NE(end, std::string::npos);
    const std::string body = xml.substr(tag + 1, end - tag - 1);
    i = end + 1;
    if (body.front() == '?' || body.back() == '/') continue;
    if (body.front() == '/') {
      ASSERT_FALSE(open.empty());
      EXPECT_EQ(open.back(), body.substr(1));
      open.pop_back();
    } else {
      open.push_back(body.substr(0, body.find(' ')));
    }
  }
  EXPECT_TRUE(open.empty());
}

TEST_F(PictureFileTest, SvgIsWellFormedVectorAndEscaped) {
  const Labelled cloud = sphere(3000);
  const fs::path path = folder_ / "sphere.svg";
  write_picture(path, cloud.points, cloud.labels,
                {.width = 200, .views = 2, .title = "a < b & \"c\" > d \xc3\xa9 \x01 \xff"});
  const std::string svg = content(path);
  expect_well_formed(svg);
  EXPECT_NE(svg.find("a &lt; b &amp; &quot;c&quot; &gt; d \xc3\xa9 \xef\xbf\xbd \xef\xbf\xbd<"),
            std::string::npos);
  EXPECT_NE(svg.find("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"200\""), std::string::npos);
  EXPECT_EQ(svg.find("<image"), std::string::npos);
  EXPECT_GT(std::count(svg.begin(), svg.end(), 'M'), 20);
  EXPECT_LT(svg.size(), 300'000U);
  EXPECT_EQ(svg.find("nan"), std::string::npos);
  write_picture(folder_ / "large.svg", cloud.points, cloud.labels, {.width = 2400, .views = 1});
  EXPECT_NE(content(folder_ / "large.svg").find("width=\"2400\""), std::string::npos);
  EXPECT_NE(content(folder_ / "large.svg").find("viewBox=\"0 0 1200 "), std::string::npos);
  write_picture(folder_ / "empty.svg", {}, {}, {.width = 64});
  expect_well_formed(content(folder_ / "empty.svg"));
}

TEST(SheetTest, PlacesCellsInRows) {
  const auto plain = [](std::size_t width, std::size_t height, std::uint8_t value) {
    return Image{width, height, std::vector<std::uint8_t>(width * height * 3, value)};
  };
  const std::vector<Image> cells{plain(30, 20, 10), plain(30, 20, 20), plain(10, 20, 30)};
  const Image sheet = make_sheet(cells, {}, 2);
  EXPECT_EQ(sheet.width, 2U * 40U + 10U);
  EXPECT_EQ(sheet.height, 2U * 30U + 10U);
  const auto value = [&](std::size_t x, std::size_t y) {
    return static_cast<int>(sheet.rgb[(y * sheet.width + x) * 3]);
  };
  EXPECT_EQ(value(9, 10), 255);
  EXPECT_EQ(value(10, 10), 10);
  EXPECT_EQ(value(39, 29), 10);
  EXPECT_EQ(value(40, 10), 255);
  EXPECT_EQ(value(50, 10), 20);
  EXPECT_EQ(value(19, 45), 255);  // the narrow one is centred
  EXPECT_EQ(value(20, 45), 30);
  EXPECT_EQ(value(29, 45), 30);
  EXPECT_EQ(value(30, 45), 255);
}

TEST(SheetTest, CaptionsGoBelow) {
  const std::vector<Image> cells(3, {30, 20, std::vector<std::uint8_t>(30 * 20 * 3, 255)});
  const std::vector<std::string> captions{"one", "", "a very long caption"};
  const Image sheet = make_sheet(cells, captions, 3);
  bool below_first = false;
  bool below_second = false;
  for (std::size_t y = 30; y < sheet.height; ++y) {
    for (std::size_t x = 0; x < 40; ++x) below_first |= !is_white(sheet, x, y);
    for (std::size_t x = 50; x < 80; ++x) below_second |= !is_white(sheet, x, y);
  }
  EXPECT_TRUE(below_first);
  EXPECT_FALSE(below_second);
}

TEST(SheetTest, BadArgumentsAreNamed) {
  const std::vector<Image> cells(2, {1, 1, {0, 0, 0}});
  const std::vector<std::string> captions{"one"};
  expect_error(ErrorCode::kUsage, "columns is 0", [&] { (void)make_sheet(cells, {}, 0); });
  expect_error(ErrorCode::kUsage, "2 pictures has 1 captions",
               [&] { (void)make_sheet(cells, captions, 1); });
  const std::vector<Image> broken{{2, 2, {0, 0, 0}}};
  expect_error(ErrorCode::kUsage, "2 x 2 pixels has 3 bytes; it needs 12",
               [&] { (void)make_sheet(broken, {}, 1); });
  EXPECT_EQ(make_sheet({}, {}, 4).height, 10U);
}

TEST(TextTest, EveryPrintableCharacterLeavesItsOwnInk) {
  std::vector<std::vector<std::uint8_t>> seen;
  for (char c = '!'; c <= '~'; ++c) {
    Image image{24, 24, std::vector<std::uint8_t>(24 * 24 * 3, 255)};
    picture::draw_text(image, std::string(1, c), 4.0F, 16.0F, 14.0F);
    EXPECT_GT(coloured_pixels(image), 2U) << c;
    EXPECT_EQ(std::count(seen.begin(), seen.end(), image.rgb), 0) << c;
    seen.push_back(std::move(image.rgb));
  }
  EXPECT_EQ(picture::fit_text("short", 10.0F, 500.0F), "short");
  const std::string cut = picture::fit_text("much too long for this", 10.0F, 60.0F);
  EXPECT_TRUE(cut.ends_with("..."));
  EXPECT_LE(picture::text_width(cut, 10.0F), 60.0F);
}

// Outlines of a disc and of a ring enclose their areas; a saddle gives two loops.
TEST(ContourTest, EnclosesTheInside) {
  picture::Field disc{41, 41, {}};
  picture::Field ring{41, 41, {}};
  for (int y = 0; y < 41; ++y) {
    for (int x = 0; x < 41; ++x) {
      const auto r = static_cast<float>(std::hypot(x - 20, y - 20));
      disc.values.push_back(15.0F - r);
      ring.values.push_back(std::min(15.0F - r, r - 8.0F));
    }
  }
  const auto area = [](const std::vector<picture::Loop>& loops) {
    float sum = 0.0F;
    for (const picture::Loop& loop : loops) sum += picture::signed_area(loop);
    return std::abs(sum);
  };
  const auto loops = picture::trace_contours(disc);
  ASSERT_EQ(loops.size(), 1U);
  EXPECT_NEAR(area(loops), std::numbers::pi_v<float> * 225.0F, 5.0F);
  const picture::Loop simple = picture::simplify(loops[0], 0.1F);
  EXPECT_LT(simple.size(), loops[0].size() / 2);
  EXPECT_NEAR(std::abs(picture::signed_area(simple)), area(loops), 10.0F);
  EXPECT_EQ(picture::trace_contours(ring).size(), 2U);
  EXPECT_NEAR(area(picture::trace_contours(ring)), std::numbers::pi_v<float> * 161.0F, 8.0F);
  EXPECT_EQ(picture::trace_contours({2, 2, {1, -1, -1, 1}}).size(), 2U);
  EXPECT_EQ(picture::trace_contours({1, 1, {1}}).size(), 1U);
  EXPECT_TRUE(picture::trace_contours({2, 1, {-1, -1}}).empty());
}

// Seen in the pose of another, an object is not stood upright for itself.
TEST(RenderParts, TakesThePoseOfAnother) {
  Labelled lying;
  for (const Vec3& p : shapes::box(4000, {3.0, 1.0, 1.0})) lying.add(p, 0);
  std::vector<Vec3> standing;
  for (const Vec3& p : lying.points) standing.push_back({p.y, p.z, p.x});
  const PictureOptions plain{.width = 128, .views = 1};
  PictureOptions posed = plain;
  posed.pose_of = standing;
  EXPECT_NE(render_parts(lying.points, lying.labels, posed).rgb,
            render_parts(lying.points, lying.labels, plain).rgb);
  EXPECT_NEAR(static_cast<double>(render_parts(standing, lying.labels, posed).height),
              static_cast<double>(render_parts(standing, lying.labels, plain).height), 2.0);
}

}  // namespace
}  // namespace morsel
