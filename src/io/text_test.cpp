#include <gtest/gtest.h>

#include <sstream>
#include <string>

#include "io/test_files.hpp"

namespace morsel::io {
namespace {

const Points kTwo = {{1, 2, 3}, {4.5, -5, 6e2}};

Points parse(const std::string& text) {
  std::istringstream stream(text);
  return read_xyz(stream, "text").points;
}

TEST(TextTest, TakesAnySeparator) {
  EXPECT_EQ(parse("1 2 3\n4.5 -5 6e2\n"), kTwo);
  EXPECT_EQ(parse("1\t2\t3\n4.5\t-5\t6e2"), kTwo);
  EXPECT_EQ(parse("1,2,3\n4.5,-5,6e2\n"), kTwo);
  EXPECT_EQ(parse("1, 2, 3\n4.5 ,-5 , 6e2\n"), kTwo);
  EXPECT_EQ(parse("1;2;3\n4.5; -5;\t6e2\n"), kTwo);
  EXPECT_EQ(parse("  1   2 3  \r\n\r\n4.5 -5 +6e2\r\n"), kTwo);
  EXPECT_EQ(parse("\xef\xbb\xbf"
                  "1 2 3\r4.5 -5 600"),
            kTwo);
}

TEST(TextTest, SkipsCommentsAndExtraColumns) {
  EXPECT_EQ(parse("# a\n//X Y Z\n1 2 3 255 0 0 tree\n\n  % b\n4.5 -5 6e2 7\n"), kTwo);
  EXPECT_EQ(parse("1,2,3,,\n4.5,-5,6e2,\"a, b\"\n"), kTwo);
}

TEST(TextTest, FindsColumnsByHeader) {
  EXPECT_EQ(parse("id,z,x,y\n7,3,1,2\n8,6e2,4.5,-5\n"), kTwo);
  EXPECT_EQ(parse("\"Name\";\"X [m]\";\"Y [m]\";\"Z [m]\"\na b;1;2;3\n;4.5;-5;6e2\n"), kTwo);
  EXPECT_EQ(parse("\"Points:2\",\"Points:0\",\"Points:1\"\n3,1,2\n600,4.5,-5\n"), kTwo);
  EXPECT_EQ(parse("n pos_x pos_y pos_z\n9 1 2 3\n9 4.5 -5 600\n"), kTwo);
  EXPECT_EQ(parse("x, y, z\n1 2 3\n4.5 -5 600\n"), kTwo);
  EXPECT_EQ(parse("a b c d\n1 2 3 4\n4.5 -5 600 4\n"), kTwo);
  EXPECT_EQ(parse("x\ty\tz\n\"1\"\t2\t3\n4.5\t-5\t600\n"), kTwo);
}

TEST(TextTest, TakesCountsOfPtsFiles) {
  EXPECT_EQ(parse("2\n1 2 3 -100 1 2 3\n4.5 -5 6e2 5 1 2 3\n"), kTwo);
  EXPECT_EQ(parse("1\r\n1 2 3\r\n1\r\n4.5 -5 6e2\r\n"), kTwo);
}

TEST(TextTest, KeepsEveryBitFarFromTheOrigin) {
  const Points points = {{1000000.1234567891, -4999999.0000000009, 6378137.3000000007}};
  EXPECT_EQ(parse("1000000.1234567891 -4999999.0000000009 6378137.3000000007"), points);
}

TEST(TextTest, NamesTheStreamAndTheLine) {
  EXPECT_EQ(error_of([] { parse("1 2 3\n1 2\n"); }), "text:2: z is missing; expected a number");
  EXPECT_TRUE(contains(error_of([] { parse(""); }), "text: holds no points"));
}

TEST(TextTest, DecimalCommasAreNotTakenForColumns) {
  EXPECT_TRUE(contains(error_of([] { parse("1,5 2,5 3,5\n"); }), "decimal commas"));
  EXPECT_TRUE(contains(error_of([] { parse("1,5;2,5;3,5\n"); }), "decimal commas"));
  EXPECT_EQ(parse("1,2,3 4,5,6\n").size(), 1U);
}

}  // namespace
}  // namespace morsel::io
