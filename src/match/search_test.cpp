#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <morsel/morsel.hpp>

#include "base/random.hpp"
#include "signature/tables.hpp"

namespace morsel {
namespace {

namespace fs = std::filesystem;

// Kinds of sets that a search by bounds could get wrong.
enum class Set { kRandom, kAllEqual, kEqualSums, kOneApart, kEmptyOnes };

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
  const fs::path path_ = fs::path(::testing::TempDir()) /
                         ("morsel_search_" + std::to_string(static_cast<int>(GetParam())));
};

TEST_P(SearchTest, EqualsTheExhaustiveAnswer) {
  Random random(3);
  std::vector<std::string> names;
  std::vector<Signature> signatures;
  for (int i = 0; i < 600; ++i) {
    names.push_back("shape " + std::to_string(random.below(100000)));
    signatures.push_back(random_signature(GetParam(), random));
  }
  write_search_block(path_, names, signatures);
  const SearchBlock block = SearchBlock::open(path_);
  ASSERT_EQ(block.size(), 600U);
  EXPECT_EQ(block.name(17), names[17]);
  EXPECT_EQ(block.signature(17), signatures[17]);
  for (const std::size_t k : {0U, 1U, 10U, 599U, 1000U}) {
    for (const bool mirror : {true, false}) {
      const MatchOptions options{.mirror = mirror};
      const Signature query = k == 1 ? signatures[5] : random_signature(GetParam(), random);
      const auto hits = block.search(query, k, options);
      const auto expected = exhaustive(block, query, k, options);
      ASSERT_EQ(hits.size(), expected.size());
      for (std::size_t i = 0; i < hits.size(); ++i) {
        EXPECT_EQ(block.name(hits[i].index), block.name(expected[i].index));
        EXPECT_EQ(hits[i].score, expected[i].score);
      }
    }
  }
  fs::remove(path_);
}

INSTANTIATE_TEST_SUITE_P(Sets, SearchTest,
                         ::testing::Values(Set::kRandom, Set::kAllEqual, Set::kEqualSums,
                                           Set::kOneApart, Set::kEmptyOnes));

TEST(SearchBlockTest, DamagedFilesAreRefused) {
  const fs::path path = fs::path(::testing::TempDir()) / "morsel_damaged_block";
  Random random(1);
  write_search_block(path, std::vector<std::string>{"a", "b"},
                     std::vector<Signature>(2, random_signature(Set::kRandom, random)));
  std::ifstream file(path, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(file), {}};
  for (const std::size_t length : {std::size_t{0}, std::size_t{15}, bytes.size() - 1}) {
    std::ofstream(path, std::ios::binary) << bytes.substr(0, length);
    EXPECT_THROW((void)SearchBlock::open(path), Error);
  }
  std::ofstream(path, std::ios::binary) << "X" << bytes.substr(1);
  EXPECT_THROW((void)SearchBlock::open(path), Error);
  EXPECT_THROW((void)SearchBlock::open(path.string() + "-missing"), Error);
  EXPECT_THROW(write_search_block(path, std::vector<std::string>{"a"}, {}), Error);
  fs::remove(path);
}

TEST(SearchBlockTest, AnEmptyBlock) {
  const fs::path path = fs::path(::testing::TempDir()) / "morsel_empty_block";
  write_search_block(path, {}, {});
  EXPECT_TRUE(SearchBlock::open(path).search({}, 3).empty());
  fs::remove(path);
}

}  // namespace
}  // namespace morsel
