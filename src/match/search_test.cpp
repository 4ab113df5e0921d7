#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <morsel/morsel.hpp>

#include "base/random.hpp"
#include "base/test_folder.hpp"
#include "match/block.hpp"
#include "signature/tables.hpp"

namespace morsel {
namespace {

namespace fs = std::filesystem;

// Kinds of sets that a search by bounds could get wrong.
enum class Set { kRandom, kAllEqual, kEqualSums, kOneApart, kEmptyOnes, kExtremes, kFamilies };

Signature random_signature(Set set, Random& random) {
  Signature signature;
  signature.size = set == Set::kEmptyOnes && random.below(2) == 0 ? 0.0 : 1.0;
  signature.tables.assign(kTableSize, 100);
  for (std::size_t i = 1; i + 1 < kTableSize; i += 2) {
    std::uint8_t& a = signature.tables[i];
    std::uint8_t& b = signature.tables[i + 1];
    switch (set) {
      case Set::kAllEqual:
        break;
      case Set::kEqualSums: {  // sketches that tell nothing
        const auto by = static_cast<std::uint8_t>(random.below(50));
        a = static_cast<std::uint8_t>(a + by);
        b = static_cast<std::uint8_t>(b - by);
        break;
      }
      default:
        a = static_cast<std::uint8_t>(random.below(256));
        b = static_cast<std::uint8_t>(random.below(256));
    }
  }
  if (set == Set::kOneApart) {
    signature.tables.assign(kTableSize, 100);
    signature.tables[1 + random.below(kTableSize - 1)] = 101;
  }
  if (set == Set::kExtremes) {  // the largest sums that there can be, and the smallest
    signature.tables.assign(kTableSize, random.below(2) == 0 ? 0 : 255);
    signature.tables[random.below(kTableSize)] = static_cast<std::uint8_t>(random.below(256));
    return signature;
  }
  if (set == Set::kFamilies) {  // a few shapes, each many times and hardly changed
    Random family(random.below(5));
    for (std::uint8_t& value : signature.tables) {
      value = static_cast<std::uint8_t>(family.below(250) + random.below(3));
    }
    return signature;
  }
  signature.tables[0] = static_cast<std::uint8_t>(set == Set::kRandom ? random.below(256) : 255);
  return signature;
}

std::vector<Hit> exhaustive(const SearchBlock& block, const Signature& query, std::size_t k,
                            const MatchOptions& options) {
  std::vector<Hit> hits;
  for (std::size_t i = 0; i < block.size(); ++i) {
    hits.push_back({i, match_score(query, block.signature(i), options)});
  }
  std::ranges::sort(hits, [&](const Hit& a, const Hit& b) {
    return a.score != b.score ? a.score > b.score : block.name(a.index) < block.name(b.index);
  });
  hits.resize(std::min(k, hits.size()));
  return hits;
}

class SearchTest : public ::testing::TestWithParam<Set> {
 protected:
  const TestFolder folder_;
  const fs::path path_ = folder_.path() / "block";
};

// Names so that ties are not in the order of the rows.
struct Shapes {
  Shapes(Set set, std::size_t count, Random& random) {
    for (std::size_t i = 0; i < count; ++i) {
      names.push_back("shape " + std::to_string(random.below(100000)));
      signatures.push_back(random_signature(set, random));
    }
  }
  std::vector<std::string> names;
  std::vector<Signature> signatures;
};

void expect_exhaustive(const SearchBlock& block, const Signature& query, std::size_t k,
                       const MatchOptions& options) {
  const auto hits = block.search(query, k, options);
  const auto expected = exhaustive(block, query, k, options);
  ASSERT_EQ(hits.size(), expected.size());
  for (std::size_t i = 0; i < hits.size(); ++i) {
    EXPECT_EQ(block.name(hits[i].index), block.name(expected[i].index));
    EXPECT_EQ(hits[i].score, expected[i].score);
  }
}

TEST_P(SearchTest, EqualsTheExhaustiveAnswer) {
  Random random(3);
  const Shapes shapes(GetParam(), 600, random);
  write_search_block(path_, shapes.names, shapes.signatures);
  const SearchBlock block = SearchBlock::open(path_);
  ASSERT_EQ(block.size(), 600U);
  EXPECT_EQ(block.name(17), shapes.names[17]);
  EXPECT_EQ(block.signature(17), shapes.signatures[17]);
  for (const std::size_t k : {0U, 1U, 10U, 599U, 1000U}) {
    for (const bool mirror : {true, false}) {
      const Signature query = k == 1 ? shapes.signatures[5] : random_signature(GetParam(), random);
      expect_exhaustive(block, query, k, {.mirror = mirror});
      expect_exhaustive(block, query, k, {.mirror = mirror, .mode = MatchMode::kArticulated});
    }
  }
  fs::remove(path_);
}

TEST_P(SearchTest, EqualsTheExhaustiveAnswerInSeveralGroups) {
  Random random(7);
  const Shapes shapes(GetParam(), 2 * block::kGroupRows + 1, random);
  write_search_block(path_, shapes.names, shapes.signatures);
  const SearchBlock block = SearchBlock::open(path_);
  ASSERT_EQ(block.size(), shapes.names.size());
  EXPECT_EQ(block.name(block.size() - 1), shapes.names.back());
  for (const std::size_t k : {1U, 10U}) {
    expect_exhaustive(block, shapes.signatures.back(), k, {});
    expect_exhaustive(block, random_signature(GetParam(), random), k, {});
  }
  fs::remove(path_);
}

INSTANTIATE_TEST_SUITE_P(Sets, SearchTest,
                         ::testing::Values(Set::kRandom, Set::kAllEqual, Set::kEqualSums,
                                           Set::kOneApart, Set::kEmptyOnes, Set::kExtremes,
                                           Set::kFamilies));

class DamagedBlockTest : public ::testing::Test {
 protected:
  DamagedBlockTest() : shapes_(Set::kFamilies, 40, random_) {
    write_search_block(path_, shapes_.names, shapes_.signatures);
    std::ifstream file(path_, std::ios::binary);
    good_ = {std::istreambuf_iterator<char>(file), {}};
  }
  ~DamagedBlockTest() override { fs::remove(path_); }
  void write(const std::string& bytes) const { std::ofstream(path_, std::ios::binary) << bytes; }

  Random random_{1};
  Shapes shapes_;
  const TestFolder folder_;
  const fs::path path_ = folder_.path() / "block";
  std::string good_;
};

TEST_F(DamagedBlockTest, WrongLengthsAreRefused) {
  for (const std::size_t length : {std::size_t{0}, std::size_t{15}, good_.size() - 1}) {
    write(good_.substr(0, length));
    EXPECT_THROW((void)SearchBlock::open(path_), Error);
  }
  write(good_ + "x");
  EXPECT_THROW((void)SearchBlock::open(path_), Error);
  EXPECT_THROW((void)SearchBlock::open(path_.string() + "-missing"), Error);
  EXPECT_THROW(write_search_block(path_, std::vector<std::string>{"a"}, {}), Error);
}

// A changed byte is found, or stands where this answer does not depend on it.
TEST_F(DamagedBlockTest, NeverGivesAnotherAnswer) {
  const Signature query = random_signature(Set::kFamilies, random_);
  const auto expected = SearchBlock::open(path_).search(query, 10);
  int found = 0;
  constexpr int kFlips = 400;
  for (int i = 0; i < kFlips; ++i) {
    std::string bad = good_;
    char& byte = bad[random_.below(bad.size())];
    byte = static_cast<char>(byte ^ (1 << random_.below(8)));
    write(bad);
    try {
      const auto hits = SearchBlock::open(path_).search(query, 10);
      ASSERT_EQ(hits.size(), expected.size());
      for (std::size_t k = 0; k < hits.size(); ++k) {
        EXPECT_EQ(hits[k].index, expected[k].index);
        EXPECT_EQ(hits[k].score, expected[k].score);
      }
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::kInput);
      EXPECT_TRUE(std::string(error.what()).starts_with(path_.string())) << error.what();
      ++found;
    }
  }
  EXPECT_GT(found, kFlips / 20);
}

TEST(SearchBlockTest, BoundsSkipAlmostAll) {
  const TestFolder folder;
  const fs::path path = folder.path() / "block";
  Random random(5);
  const Shapes shapes(Set::kRandom, 3000, random);
  write_search_block(path, shapes.names, shapes.signatures);
  std::size_t looked_at = 0;
  (void)SearchBlock::open(path).search(shapes.signatures[1234], 1, {}, &looked_at);
  EXPECT_LT(looked_at, 10U);
}

TEST(SearchBlockTest, WithoutCommitThereIsNoFile) {
  const TestFolder folder;
  const fs::path path = folder.path() / "block";
  Random random(1);
  SearchBlockWriter(path).add("a", random_signature(Set::kRandom, random));
  EXPECT_FALSE(fs::exists(path));
}

TEST(SearchBlockTest, AnEmptyBlock) {
  const TestFolder folder;
  const fs::path path = folder.path() / "block";
  write_search_block(path, {}, {});
  EXPECT_TRUE(SearchBlock::open(path).search({}, 3).empty());
}

}  // namespace
}  // namespace morsel
