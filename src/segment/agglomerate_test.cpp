#include "segment/agglomerate.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

namespace morsel {
namespace {

// Three equal pieces that see each other half.
PieceGraph three_pieces(std::vector<PieceContact> contacts) {
  PieceGraph graph;
  graph.contacts = std::move(contacts);
  graph.point_count.assign(3, 100.0);
  graph.object_count.assign(3, 300.0);
  graph.object_radius.assign(3, 4.0);
  graph.thickness.assign(3, 1.0);
  graph.surface.assign(3, 10.0);
  return graph;
}

// A contact of ten facets that all lie in a crease.
PieceContact touching(std::uint32_t a, std::uint32_t b, double ratio, double area) {
  return {a, b, ratio, area, 10.0, 0.0, 10.0};
}

SightTable half_sight() {
  SightTable sight;
  sight.seen.assign(9, 0.5F);
  sight.weight.assign(9, 1.0F);
  return sight;
}

std::vector<Merge> merges(std::vector<PieceContact> contacts) {
  return agglomerate(three_pieces(std::move(contacts)), half_sight());
}

TEST(AgglomerateTest, TheWiderContactComesFirst) {
  const auto early = merges({touching(0, 1, 1.0, 3.0), touching(1, 2, 1.0, 2.0)});
  ASSERT_EQ(early.size(), 2U);
  EXPECT_EQ(std::minmax(early[0].a, early[0].b), std::minmax(0U, 1U));
  const auto late = merges({touching(0, 1, 1.0, 2.0), touching(1, 2, 1.0, 3.0)});
  ASSERT_EQ(late.size(), 2U);
  EXPECT_EQ(std::minmax(late[0].a, late[0].b), std::minmax(1U, 2U));
}

TEST(AgglomerateTest, ANarrowContactTakesAHigherRatio) {
  const double wide = merges({touching(0, 1, 1.0, 3.0), touching(1, 2, 1.0, 3.0)})[1].ratio;
  const double narrow = merges({touching(0, 1, 1.0, 3.0), touching(1, 2, 1.0, 1.0)})[1].ratio;
  EXPECT_GT(narrow, 1.05 * wide);
}

TEST(AgglomerateTest, ANeckTakesAHigherRatio) {
  const double none = merges({touching(0, 1, 1.0, 3.0), touching(1, 2, 1.0, 3.0)})[1].ratio;
  const double neck = merges({touching(0, 1, 1.0, 3.0), touching(1, 2, 1.3, 3.0)})[1].ratio;
  EXPECT_GT(neck, 1.1 * none);
}

TEST(AgglomerateTest, ACreaseTakesAHigherRatio) {
  const PieceContact first = touching(0, 1, 1.0, 3.0);
  const double shallow = merges({first, {1, 2, 1.0, 3.0, 10.0, 5.0, 10.0}})[1].ratio;
  const double deep = merges({first, {1, 2, 1.0, 3.0, 10.0, 15.0, 10.0}})[1].ratio;
  EXPECT_GT(deep, 1.05 * shallow);
}

TEST(AgglomerateTest, WithoutACreaseNothingKeepsPiecesApart) {
  const auto flat = merges({touching(0, 1, 1.0, 3.0), {1, 2, 4.0, 0.1, 10.0, 0.0, 0.0}});
  ASSERT_EQ(flat.size(), 2U);
  EXPECT_LT(flat[0].ratio, natural_merge_ratio());
  EXPECT_EQ(std::minmax(flat[0].a, flat[0].b), std::minmax(1U, 2U));
  const auto creased = merges({touching(0, 1, 1.0, 3.0), {1, 2, 4.0, 0.1, 10.0, 0.0, 10.0}});
  EXPECT_GT(creased[1].ratio, natural_merge_ratio());
}

// Two contacts alike but for the surface of what hangs by them.
TEST(AgglomerateTest, ASliceJoinsBeforeALimb) {
  PieceGraph graph = three_pieces({touching(0, 1, 1.3, 10.0), touching(1, 2, 1.3, 10.0)});
  graph.surface = {20.0, 50.0, 2.0};
  const auto merged = agglomerate(graph, half_sight());
  ASSERT_EQ(merged.size(), 2U);
  EXPECT_EQ(std::minmax(merged[0].a, merged[0].b), std::minmax(1U, 2U));
}

// Two creased facets and two flat ones are as good as four between.
TEST(AgglomerateTest, CreasesOfJoinedPiecesAreAveraged) {
  const auto two = merges(
      {touching(0, 1, 1.0, 3.0), {0, 2, 1.0, 1.0, 2.0, 3.0, 2.0}, {1, 2, 1.0, 1.0, 2.0, 0.0, 2.0}});
  const auto one = merges({touching(0, 1, 1.0, 3.0), {1, 2, 1.0, 2.0, 4.0, 3.0, 4.0}});
  EXPECT_DOUBLE_EQ(two[1].ratio, one[1].ratio);
}

TEST(AgglomerateTest, ThickPiecesTakeAHigherRatio) {
  PieceGraph graph = three_pieces({touching(0, 1, 1.0, 3.0), touching(1, 2, 1.0, 3.0)});
  const double thin = agglomerate(graph, half_sight())[1].ratio;
  graph.object_radius.assign(3, 2.0);  // so that the same thickness is more of it
  EXPECT_GT(agglomerate(graph, half_sight())[1].ratio, 1.02 * thin);
}

TEST(AgglomerateTest, ContactsOfJoinedPiecesAddUp) {
  const auto two =
      merges({touching(0, 1, 1.0, 3.0), touching(0, 2, 1.0, 1.0), touching(1, 2, 1.0, 1.0)});
  const auto one = merges({touching(0, 1, 1.0, 3.0), touching(1, 2, 1.0, 2.0)});
  ASSERT_EQ(two.size(), 2U);
  EXPECT_DOUBLE_EQ(two[1].ratio, one[1].ratio);
}

TEST(AgglomerateTest, AContactOfNoAreaIsNoWall) {
  const auto joined = merges({touching(0, 1, 1.0, 3.0), touching(1, 2, 1.0, 0.0)});
  ASSERT_EQ(joined.size(), 2U);
  EXPECT_LT(std::log(joined[1].ratio), 18.0);  // of cost
}

TEST(AgglomerateTest, WhatDoesNotTouchStaysApart) {
  EXPECT_EQ(merges({touching(0, 1, 1.0, 3.0)}).size(), 1U);
}

}  // namespace
}  // namespace morsel
