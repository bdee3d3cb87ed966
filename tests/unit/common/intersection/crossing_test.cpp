#include "common/intersection/crossing.hpp"

#include <gtest/gtest.h>

#include "common/intersection/conflicts.hpp"

namespace lukou {
namespace {

constexpr Lane kWestCenter = lane_of(Approach::kWest, Turn::kCenter);
constexpr Lane kSouthCenter = lane_of(Approach::kSouth, Turn::kCenter);

TEST(Crossing, OfTwoStraightStreamsIsACarsWidthToEachSide) {
  // Lines are 15.5 m from the centre. WC drives along y = -5.25 m, SC along x = 5.25 m: they cross 15.5 + 5.25 = 20.75
  // m past the line of WC and 15.5 - 5.25 = 10.25 m past that of SC. At right angles 1.8 m to each side are nearer.
  const auto west = crossing_area(kWestCenter, kSouthCenter);
  ASSERT_TRUE(west);
  EXPECT_NEAR(west->from_m, 20.75 - 1.8, 0.25);
  EXPECT_NEAR(west->to_m, 20.75 + 1.8, 0.25);
  const auto south = crossing_area(kSouthCenter, kWestCenter);
  ASSERT_TRUE(south);
  EXPECT_NEAR(south->from_m, 10.25 - 1.8, 0.25);
  EXPECT_NEAR(south->to_m, 10.25 + 1.8, 0.25);
}

TEST(Crossing, ExistsForTheConflictsAndNothingElse) {
  for (const Lane a : kAllLanes) {
    for (const Lane b : kAllLanes) {
      EXPECT_EQ(crossing_area(a, b).has_value(), conflict(a, b) != Conflict::kNone) << name(a) << " " << name(b);
    }
  }
}

TEST(Crossing, IsTheSameAfterAQuarterTurn) {
  const auto west = crossing_area(kWestCenter, lane_of(Approach::kEast, Turn::kLeft));
  const auto south = crossing_area(kSouthCenter, lane_of(Approach::kNorth, Turn::kLeft));
  ASSERT_TRUE(west && south);
  EXPECT_EQ(west->from_m, south->from_m);
  EXPECT_EQ(west->to_m, south->to_m);
}

}  // namespace
}  // namespace lukou
