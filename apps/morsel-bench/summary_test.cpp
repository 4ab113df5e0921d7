#include "summary.hpp"

#include <gtest/gtest.h>

#include "base/test_folder.hpp"

namespace morsel::bench {
namespace {

TEST(Summary, GroupsByCategory) {
  const auto groups = group_by_category(std::vector<int>{41, 1, 20, 43});
  ASSERT_EQ(groups.size(), 2U);
  EXPECT_EQ(groups.at(0), (std::vector<std::size_t>{1, 2}));
  EXPECT_EQ(groups.at(2), (std::vector<std::size_t>{0, 3}));
}

TEST(Summary, HasMeanAndMedian) {
  EXPECT_EQ(median({5.0, 1.0, 2.0}), 2.0);
  EXPECT_EQ(median({4.0, 1.0, 2.0, 9.0}), 3.0);
  EXPECT_EQ(median({}), 0.0);
  EXPECT_EQ(mean(std::vector<double>{1.0, 2.0, 6.0}), 3.0);
  EXPECT_EQ(mean(std::vector<double>{}), 0.0);
}

TEST(Summary, WritesJsonOrSaysWhyNot) {
  const TestFolder folder;
  const auto path = folder.path() / "summary.json";
  write_json(path, {{"a", 1}});
  EXPECT_GT(std::filesystem::file_size(path), 0U);
  EXPECT_THROW(write_json("/nowhere/at/all.json", {}), Error);
}

}  // namespace
}  // namespace morsel::bench
