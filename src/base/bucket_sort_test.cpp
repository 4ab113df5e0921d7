#include "base/bucket_sort.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "base/random.hpp"

namespace morsel {
namespace {

struct Sized {
  double size;
  std::uint32_t index;

  friend bool operator==(const Sized&, const Sized&) = default;
  friend bool operator<(const Sized& a, const Sized& b) {
    return a.size != b.size ? a.size > b.size : a.index < b.index;
  }
};

std::size_t bucket(const Sized& value) { return size_bucket(value.size); }

TEST(BucketSortTest, AsAPlainSort) {
  Random random(1);
  std::vector<Sized> values;
  for (std::uint32_t i = 0; i < 20000; ++i) {
    // From 1e-4 to 1e4, some of them equal, and most of them close together.
    values.push_back(
        {i % 7 == 0 ? 1.5 : std::pow(10.0, std::pow(random.uniform(), 3) * 8.0 - 4.0), 20000 - i});
  }
  values.push_back({0.0, 0});
  values.push_back({std::numeric_limits<double>::infinity(), 0});
  std::vector<Sized> expected = values;
  std::ranges::sort(expected, std::less<>());
  for (const int threads : {1, 2}) {
    std::vector<Sized> sorted = values;
    bucket_sort(sorted, kSizeBuckets, threads, bucket);
    EXPECT_EQ(sorted, expected) << threads;
  }
}

TEST(BucketSortTest, Nothing) {
  std::vector<Sized> none;
  bucket_sort(none, kSizeBuckets, 1, bucket);
  EXPECT_TRUE(none.empty());
}

TEST(BucketSortTest, LargerSizesComeFirst) {
  EXPECT_EQ(size_bucket(std::numeric_limits<double>::infinity()), 0U);
  EXPECT_EQ(size_bucket(256.0), 0U);
  EXPECT_LT(size_bucket(1.0), size_bucket(0.999));
  EXPECT_EQ(size_bucket(0.0), kSizeBuckets - 1);
  EXPECT_EQ(size_bucket(std::numeric_limits<double>::quiet_NaN()), kSizeBuckets - 1);
}

}  // namespace
}  // namespace morsel
