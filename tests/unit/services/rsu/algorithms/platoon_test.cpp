#include "services/rsu/algorithms/platoon.hpp"

#include <gtest/gtest.h>

#include "tests/unit/services/rsu/algorithms/one_lane.hpp"

namespace lukou {
namespace {

/// The first acceleration to 10 m/s at the line, as the message carries it.
double advised_mps2(const ArrivalGoal& goal) { return carriable_mps2(smoothest_arrival(goal, 10.0).start_mps2, 3.0); }

class PlatoonTest : public testing::Test {
 protected:
  std::vector<RsuAnswer::Item> answer(const PlatoonParameters& parameters = {}) {
    Platoon algorithm(parameters);
    return road_.answer(algorithm, 0);
  }

  test::OneLane road_;
};

TEST_F(PlatoonTest, LetsCarsCrossAHeadwayApart) {
  // Green at 23.5 s: crossings at 25, 27 and 29 s. The leader: (1800 - 50 (30 + 10)) / 625 = -0.32 m/s2.
  road_.red_until(235);
  road_.cars({{300.0, 15.0}, {325.0, 15.0}, {350.0, 15.0}});
  const auto said = answer();
  ASSERT_EQ(said.size(), 3U);
  EXPECT_DOUBLE_EQ(said[0].advice->acceleration_mps2, -0.32);
  EXPECT_DOUBLE_EQ(said[1].advice->acceleration_mps2,
                   advised_mps2({.distance_m = 325.0, .speed_mps = 15.0, .time_s = 27.0}));
  EXPECT_DOUBLE_EQ(said[2].advice->acceleration_mps2,
                   advised_mps2({.distance_m = 350.0, .speed_mps = 15.0, .time_s = 29.0}));
  for (const auto& item : said) EXPECT_EQ(item.advice->binding, Binding::kFollowing);
}

TEST_F(PlatoonTest, FollowsItsLeaderWhenThatIsNearEnough) {
  PlatoonParameters near;
  near.approach.activation_distance_m = 300.0;
  road_.red_until(235);
  road_.cars({{300.0, 15.0}, {325.0, 15.0}});
  EXPECT_EQ(answer(near).size(), 2U) << "the second is beyond the distance, but its leader is not";
  road_.cars({{300.0, 15.0}, {346.0, 15.0}});
  EXPECT_EQ(answer(near).size(), 1U) << "more than 3 s behind it leads a platoon of its own";
  road_.cars({{301.0, 15.0}, {325.0, 15.0}});
  EXPECT_TRUE(answer(near).empty());
}

TEST_F(PlatoonTest, GuidesAFollowerThatIsHardlyEarlyWithItsLeader) {
  // The leader crosses at 21.5 s, 1.5 s later than it could; the follower, there after 22.5 s, at 23.5 s: 1 s, which
  // would be within the slack.
  road_.red_until(200);
  road_.cars({{300.0, 15.0}, {337.5, 15.0}});
  const auto said = answer();
  ASSERT_EQ(said.size(), 2U);
  EXPECT_DOUBLE_EQ(said[1].advice->acceleration_mps2,
                   advised_mps2({.distance_m = 337.5, .speed_mps = 15.0, .time_s = 23.5}));
}

TEST_F(PlatoonTest, SplitsAtTheEndOfGreen) {
  // Green until 10 s, with its tail until 12.5 s: cars that would be there after 10 and 12 s cross; the third, after 14
  // s, leads those that wait for the next green, at 55 s.
  road_.green_until(100);
  road_.cars({{150.0, 15.0}, {180.0, 15.0}, {210.0, 15.0}, {240.0, 15.0}});
  const auto said = answer();
  ASSERT_EQ(said.size(), 2U);
  EXPECT_EQ(said[0].car, TemporaryId{79});
  EXPECT_EQ(said[1].car, TemporaryId{80});
  for (const auto& item : said) EXPECT_LT(item.advice->acceleration_mps2, 0.0);
}

}  // namespace
}  // namespace lukou
