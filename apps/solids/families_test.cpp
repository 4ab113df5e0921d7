#include "solids/families.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <morsel/morsel.hpp>
#include <set>
#include <vector>

namespace morsel::solids {
namespace {

constexpr std::uint64_t kMembers = 12;

// Whether the pieces hang together, as morsel sees it.
bool is_one_object(const Member& member) {
  const LabelledPoints cloud = sample_member(member, {.count = 6000, .noise = 0.001});
  return segment(cloud.points).tree.component_count == 1;
}

TEST(Families, AreSeventeenOfTwelveMembersThatDiffer) {
  ASSERT_EQ(family_names().size(), 17U);
  for (std::size_t family = 0; family < 17; ++family) {
    std::set<double> members;
    for (std::uint64_t number = 0; number < kMembers; ++number) {
      const LabelledPoints cloud = sample_member({family, number, 0}, {.count = 500});
      ASSERT_EQ(cloud.points.size(), 500U);
      for (const Vec3& p : cloud.points) {
        ASSERT_TRUE(is_finite(p));
        ASSERT_LT(norm(p), 6.0) << family_names()[family];
      }
      double spread = 0.0;
      for (const Vec3& p : cloud.points) spread += squared_norm(p);
      members.insert(spread);
    }
    EXPECT_EQ(members.size(), kMembers) << family_names()[family];
  }
}

TEST(Families, HaveThreePartsOrMoreAllOfThemSeen) {
  for (std::size_t family = 0; family < 17; ++family) {
    for (std::uint64_t number = 0; number < kMembers; ++number) {
      const LabelledPoints cloud = sample_member({family, number, 0}, {.count = 3000});
      const int most = *std::ranges::max_element(cloud.parts);
      EXPECT_GE(most, 2) << family_names()[family];
      for (int part = 0; part <= most; ++part) {
        EXPECT_GT(std::ranges::count(cloud.parts, part), 12)
            << family_names()[family] << " " << number << " part " << part;
      }
    }
  }
}

TEST(Families, AreOneObjectEach) {
  for (std::size_t family = 0; family < 17; ++family) {
    EXPECT_TRUE(is_one_object({family, 0, 0})) << family_names()[family];
  }
}

TEST(Families, PoseMovesJointsAndNothingElse) {
  for (std::size_t family = 0; family < 17; ++family) {
    const SurfaceOptions options{.count = 300, .noise = 0.0, .seed = 5};
    const LabelledPoints one = sample_member({family, 3, 0}, options);
    const LabelledPoints other = sample_member({family, 3, 1}, options);
    EXPECT_EQ(one.points != other.points, has_joints(family)) << family_names()[family];
    EXPECT_EQ(make_member({family, 3, 0}).size(), make_member({family, 3, 1}).size());
    EXPECT_EQ(one.points, sample_member({family, 3, 0}, options).points);
  }
}

}  // namespace
}  // namespace morsel::solids
