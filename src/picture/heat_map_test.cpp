#include <gtest/gtest.h>

#include <array>
#include <morsel/error.hpp>
#include <morsel/picture.hpp>
#include <string>
#include <vector>

namespace morsel {
namespace {

Color pixel(const Image& image, std::size_t x, std::size_t y) {
  const std::size_t at = 3 * (y * image.width + x);
  return {image.rgb[at], image.rgb[at + 1], image.rgb[at + 2]};
}

TEST(HeatMap, CellsHaveTheColoursOfTheirValues) {
  const std::vector<double> values{1.0, 0.0, 0.5, -3.0};
  const Image image = draw_heat_map(values, std::vector<std::string>{"a", "b"});
  const std::size_t right = image.width - 9;
  const std::size_t bottom = image.height - 9;
  EXPECT_EQ(pixel(image, right, 8), (Color{68, 1, 84}));          // 0
  EXPECT_EQ(pixel(image, right - 28, 8), (Color{253, 231, 37}));  // 1
  EXPECT_EQ(pixel(image, right - 28, bottom), (Color{33, 144, 141}));
  EXPECT_EQ(pixel(image, right, bottom), (Color{68, 1, 84}));  // below 0
  EXPECT_EQ(pixel(image, 0, 0), (Color{255, 255, 255}));
}

TEST(HeatMap, ManyRowsStayWithinAPicture) {
  const std::vector<std::string> names(700, "shape");
  const Image image = draw_heat_map(std::vector<double>(700 * 700, 0.5), names);
  EXPECT_EQ(image.width, 700 * 2 + 16U);
  EXPECT_EQ(image.height, image.width);
}

TEST(HeatMap, NumbersMustFit) {
  EXPECT_THROW((void)draw_heat_map(std::vector<double>(3), std::vector<std::string>(2)), Error);
  EXPECT_THROW((void)draw_heat_map({}, {}), Error);
}

}  // namespace
}  // namespace morsel
