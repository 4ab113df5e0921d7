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
  const auto early = merges({{0, 1, 1.0, 3.0}, {1, 2, 1.0, 2.0}});
  ASSERT_EQ(early.size(), 2U);
  EXPECT_EQ(std::minmax(early[0].a, early[0].b), std::minmax(0U, 1U));
  const auto late = merges({{0, 1, 1.0, 2.0}, {1, 2, 1.0, 3.0}});
  ASSERT_EQ(late.size(), 2U);
  EXPECT_EQ(std::minmax(late[0].a, late[0].b), std::minmax(1U, 2U));
}

TEST(AgglomerateTest, ANarrowContactTakesAHigherRatio) {
  const double wide = merges({{0, 1, 1.0, 3.0}, {1, 2, 1.0, 3.0}})[1].ratio;
  const double narrow = merges({{0, 1, 1.0, 3.0}, {1, 2, 1.0, 1.0}})[1].ratio;
  EXPECT_GT(narrow, 1.05 * wide);
}

TEST(AgglomerateTest, ANeckTakesAHigherRatio) {
  const double none = merges({{0, 1, 1.0, 3.0}, {1, 2, 1.0, 3.0}})[1].ratio;
  const double neck = merges({{0, 1, 1.0, 3.0}, {1, 2, 1.3, 3.0}})[1].ratio;
  EXPECT_GT(neck, 1.1 * none);
}

TEST(AgglomerateTest, ACreaseTakesAHigherRatio) {
  const double flat = merges({{0, 1, 1.0, 3.0}, {1, 2, 1.0, 3.0, 10.0, 0.0}})[1].ratio;
  const double crease = merges({{0, 1, 1.0, 3.0}, {1, 2, 1.0, 3.0, 10.0, 15.0}})[1].ratio;
  EXPECT_GT(crease, 1.05 * flat);
}

// Two creased facets and two flat ones are as good as four between.
TEST(AgglomerateTest, CreasesOfJoinedPiecesAreAveraged) {
  const auto two =
      merges({{0, 1, 1.0, 3.0}, {0, 2, 1.0, 1.0, 2.0, 3.0}, {1, 2, 1.0, 1.0, 2.0, 0.0}});
  const auto one = merges({{0, 1, 1.0, 3.0}, {1, 2, 1.0, 2.0, 4.0, 3.0}});
  EXPECT_DOUBLE_EQ(two[1].ratio, one[1].ratio);
}

TEST(AgglomerateTest, ThickPiecesTakeAHigherRatio) {
  PieceGraph graph = three_pieces({{0, 1, 1.0, 3.0}, {1, 2, 1.0, 3.0}});
  const double thin = agglomerate(graph, half_sight())[1].ratio;
  graph.object_radius.assign(3, 2.0);  // so that the same thickness is more of it
  EXPECT_GT(agglomerate(graph, half_sight())[1].ratio, 1.05 * thin);
}

TEST(AgglomerateTest, ContactsOfJoinedPiecesAddUp) {
  const auto two = merges({{0, 1, 1.0, 3.0}, {0, 2, 1.0, 1.0}, {1, 2, 1.0, 1.0}});
  const auto one = merges({{0, 1, 1.0, 3.0}, {1, 2, 1.0, 2.0}});
  ASSERT_EQ(two.size(), 2U);
  EXPECT_DOUBLE_EQ(two[1].ratio, one[1].ratio);
}

TEST(AgglomerateTest, AContactOfNoAreaIsNoWall) {
  const auto touching = merges({{0, 1, 1.0, 3.0}, {1, 2, 1.0, 0.0}});
  ASSERT_EQ(touching.size(), 2U);
  EXPECT_LT(std::log(touching[1].ratio), 18.0);  // of cost
}

TEST(AgglomerateTest, WhatDoesNotTouchStaysApart) {
  EXPECT_EQ(merges({{0, 1, 1.0, 3.0}}).size(), 1U);
}

}  // namespace
}  // namespace morsel
