#include "measures.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "base/random.hpp"

namespace morsel::bench {
namespace {

using Labels = std::vector<int>;

double rand_by_pairs(const Labels& a, const Labels& b) {
  std::size_t differing = 0;
  std::size_t pairs = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t j = i + 1; j < a.size(); ++j, ++pairs) {
      if ((a[i] == a[j]) != (b[i] == b[j])) ++differing;
    }
  }
  return static_cast<double>(differing) / static_cast<double>(pairs);
}

Labels random_labels(std::size_t count, std::uint64_t parts, Random& random) {
  Labels labels(count);
  for (int& label : labels) label = static_cast<int>(random.below(parts)) * 7 - 3;
  return labels;
}

// Two columns of `length` unit squares, each of two triangles, along x.
TriangleMesh strip(std::uint32_t length) {
  TriangleMesh mesh;
  for (std::uint32_t i = 0; i <= length; ++i) {
    mesh.vertices.push_back({static_cast<double>(i), 0.0, 0.0});
    mesh.vertices.push_back({static_cast<double>(i), 1.0, 0.0});
  }
  for (std::uint32_t i = 0; i < length; ++i) {
    mesh.triangles.push_back({2 * i, 2 * i + 2, 2 * i + 1});
    mesh.triangles.push_back({2 * i + 2, 2 * i + 3, 2 * i + 1});
  }
  return mesh;
}

TEST(Rand, IsZeroForEqualPartitionsWhateverTheirNames) {
  EXPECT_EQ(rand_error(count_pairs(Labels{0, 0, 1, 2}, Labels{5, 5, -1, 9})), 0.0);
  EXPECT_EQ(rand_error(count_pairs(Labels{4}, Labels{7})), 0.0);
  EXPECT_EQ(rand_error(count_pairs(Labels{}, Labels{})), 0.0);
}

TEST(Rand, CountsByHand) {
  // Pairs 01 and 23 are together in the first only; all others are apart in both or differ not.
  EXPECT_DOUBLE_EQ(rand_error(count_pairs(Labels{0, 0, 1, 1}, Labels{0, 1, 2, 3})), 2.0 / 6.0);
  // 01, 23 only in the first, 02, 13 only in the second.
  EXPECT_DOUBLE_EQ(rand_error(count_pairs(Labels{0, 0, 1, 1}, Labels{0, 1, 0, 1})), 4.0 / 6.0);
  EXPECT_DOUBLE_EQ(rand_error(count_pairs(Labels{0, 0, 0}, Labels{0, 1, 2})), 1.0);
}

TEST(Rand, EqualsTheCountOverAllPairs) {
  Random random(11);
  for (int round = 0; round < 50; ++round) {
    const std::size_t count = 2 + random.below(60);
    const Labels a = random_labels(count, 1 + random.below(6), random);
    const Labels b = random_labels(count, 1 + random.below(6), random);
    EXPECT_DOUBLE_EQ(rand_error(count_pairs(a, b)), rand_by_pairs(a, b));
  }
}

TEST(Hamming, CountsByHand) {
  // Person: {0 1 2}, {3 4 5}. Computed: {0 1}, {2 3 4 5}.
  const auto table = count_pairs(Labels{0, 0, 1, 1, 1, 1}, Labels{0, 0, 0, 1, 1, 1});
  EXPECT_DOUBLE_EQ(missing_rate(table), 1.0 / 6.0);      // face 2
  EXPECT_DOUBLE_EQ(false_alarm_rate(table), 1.0 / 6.0);  // face 2
}

TEST(Hamming, TellsTooFewPartsFromTooMany) {
  const Labels one{0, 0, 0, 0};
  const Labels four{0, 1, 2, 3};
  // One computed part holds each of the person's parts, but is three quarters too large.
  EXPECT_DOUBLE_EQ(missing_rate(count_pairs(one, four)), 0.0);
  EXPECT_DOUBLE_EQ(false_alarm_rate(count_pairs(one, four)), 0.75);
  EXPECT_DOUBLE_EQ(missing_rate(count_pairs(four, one)), 0.75);
  EXPECT_DOUBLE_EQ(false_alarm_rate(count_pairs(four, one)), 0.0);
}

TEST(Consistency, ForgivesRefinement) {
  const auto table = count_pairs(Labels{0, 0, 1, 2}, Labels{0, 0, 1, 1});
  EXPECT_EQ(global_consistency_error(table), 0.0);
  EXPECT_EQ(local_consistency_error(table), 0.0);
}

TEST(Consistency, TellsGlobalFromLocalRefinement) {
  // The first refines the second on the right, the second refines the first on the left.
  const auto table = count_pairs(Labels{0, 0, 1, 2}, Labels{0, 1, 2, 2});
  // By rows: faces 0 and 1 have half of their part elsewhere: (½ + ½) / 4; by columns the same.
  EXPECT_DOUBLE_EQ(global_consistency_error(table), 0.25);
  EXPECT_DOUBLE_EQ(local_consistency_error(table), 0.0);
}

TEST(Consistency, CountsByHand) {
  // {0 1 2 3 | 4 5} against {0 1 2 | 3 4 5}. By rows: three faces with 1/4, face 3 with 3/4; by
  // columns: face 3 with 2/3, faces 4 and 5 with 1/3.
  const auto table = count_pairs(Labels{0, 0, 0, 0, 1, 1}, Labels{0, 0, 0, 1, 1, 1});
  EXPECT_DOUBLE_EQ(global_consistency_error(table), (2.0 / 3.0 + 2.0 / 3.0) / 6.0);
  EXPECT_DOUBLE_EQ(local_consistency_error(table), (2.0 / 3.0) / 6.0);
}

TEST(Cuts, AreTheEdgesBetweenParts) {
  const MeshEdges edges = find_edges(strip(4));
  EXPECT_EQ(edges.edges.size(), 7U);  // 4 diagonals, 3 sides between squares
  const Cuts cuts = find_cuts(edges, Labels{0, 0, 0, 0, 1, 1, 1, 1});
  ASSERT_EQ(cuts.midpoints.size(), 1U);
  EXPECT_EQ(cuts.midpoints[0], (Vec3{2.0, 0.5, 0.0}));
  EXPECT_EQ(cuts.lengths[0], 1.0);
}

TEST(Cuts, AreComparedBothWays) {
  const MeshEdges edges = find_edges(strip(4));
  const Cuts at_1 = find_cuts(edges, Labels{0, 0, 1, 1, 1, 1, 1, 1});
  const Cuts at_1_and_3 = find_cuts(edges, Labels{0, 0, 1, 1, 1, 1, 2, 2});
  const Cuts none = find_cuts(edges, Labels(8, 0));
  EXPECT_DOUBLE_EQ(cut_discrepancy(at_1, at_1, 1.0).value(), 0.0);
  // From the one cut 0; from the two cuts 0 and 2, in the mean 1.
  EXPECT_DOUBLE_EQ(cut_discrepancy(at_1, at_1_and_3, 2.0).value(), 0.5);
  EXPECT_DOUBLE_EQ(cut_discrepancy(at_1_and_3, at_1, 2.0).value(), 0.5);
  EXPECT_EQ(cut_discrepancy(none, none, 1.0), 0.0);
  EXPECT_EQ(cut_discrepancy(none, at_1, 1.0), std::nullopt);
}

TEST(Cuts, AreMeasuredByTheMeanRadius) {
  // Two triangles whose centroids are (1/3, 1/3) and (2/3, 2/3), both sqrt(1/18) from the middle.
  EXPECT_NEAR(find_edges(strip(1)).mean_radius, std::sqrt(1.0 / 18.0), 1e-15);
}

TEST(Scores, AreMeansOverPeople) {
  const Labels labels{0, 0, 0, 0};
  const std::vector<Labels> people{{0, 0, 0, 0}, {0, 0, 1, 1}};
  const Scores scores = compare_with_people(strip(2), labels, people);
  EXPECT_DOUBLE_EQ(scores[kRand].value(), 0.5 * (4.0 / 6.0));
  EXPECT_DOUBLE_EQ(scores[kHamming].value(), 0.5 * 0.25);
  EXPECT_DOUBLE_EQ(scores[kFalseAlarmRate].value(), 0.25);
  EXPECT_DOUBLE_EQ(scores[kCutDiscrepancy].value(), 0.0);  // defined for the first person only
}

TEST(Scores, CountLabels) {
  EXPECT_EQ(count_labels(Labels{3, -1, 3, 7}), 3U);
  EXPECT_EQ(count_labels(Labels{}), 0U);
}

}  // namespace
}  // namespace morsel::bench
