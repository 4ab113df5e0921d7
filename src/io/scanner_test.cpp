#include "io/scanner.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace morsel::io {
namespace {

std::vector<std::string> lines_of(const std::string& bytes) {
  const Source source{"name", "", "", bytes};
  LineScanner scanner(source);
  std::vector<std::string> lines;
  while (scanner.next()) lines.emplace_back(scanner.line());
  return lines;
}

TEST(ScannerTest, KnowsEveryLineEnd) {
  const std::vector<std::string> expected = {"a", "", "b"};
  EXPECT_EQ(lines_of("a\n\nb"), expected);
  EXPECT_EQ(lines_of("a\n\nb\n"), expected);
  EXPECT_EQ(lines_of("a\r\n\r\nb\r\n"), expected);
  EXPECT_EQ(lines_of("a\r\rb\r"), expected);
  EXPECT_EQ(lines_of("\xef\xbb\xbf"
                     "a\n\nb"),
            expected);
  EXPECT_TRUE(lines_of("").empty());
}

TEST(ScannerTest, ParsesDoublesExactlyAndWhole) {
  double value = 0.0;
  EXPECT_EQ(parse_double("+1234567.123456789", value), NumberResult::kOk);
  EXPECT_EQ(value, 1234567.123456789);
  EXPECT_EQ(parse_double("-.5e-3", value), NumberResult::kOk);
  EXPECT_EQ(value, -.5e-3);
  for (const char* bad : {"", "+", "-", "+-1", "1.5x", "0x10", "1,5", "1e", "abc", "1 "}) {
    EXPECT_EQ(parse_double(bad, value), NumberResult::kNotANumber) << bad;
  }
}

TEST(ScannerTest, TellsTooLargeFromTooSmall) {
  double value = 1.0;
  EXPECT_EQ(parse_double("1e-999", value), NumberResult::kOk);
  EXPECT_EQ(value, 0.0);
  EXPECT_EQ(parse_double("0." + std::string(400, '0') + "1", value), NumberResult::kOk);
  EXPECT_EQ(value, 0.0);
  EXPECT_EQ(parse_double("1e999", value), NumberResult::kOutOfRange);
  EXPECT_EQ(parse_double("-" + std::string(400, '9'), value), NumberResult::kOutOfRange);
}

TEST(ScannerTest, ParsesIntegersWithinTheirType) {
  std::int32_t value = 0;
  EXPECT_TRUE(parse_integer("-2147483648", value));
  EXPECT_EQ(value, std::numeric_limits<std::int32_t>::min());
  EXPECT_FALSE(parse_integer("2147483648", value));
  EXPECT_FALSE(parse_integer("1.0", value));
  std::uint64_t count = 0;
  EXPECT_FALSE(parse_integer("-1", count));
  EXPECT_TRUE(parse_integer("+7", count));
}

TEST(ScannerTest, QuotesForMessagesStayOnOneLine) {
  EXPECT_EQ(in_quotes("a\nb\x01"), "'a\\x0ab\\x01'");
  EXPECT_LT(in_quotes(std::string(1000, 'x')).size(), 60U);
}

}  // namespace
}  // namespace morsel::io
