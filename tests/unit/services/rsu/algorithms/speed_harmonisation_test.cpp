#include "services/rsu/algorithms/speed_harmonisation.hpp"

#include <gtest/gtest.h>

#include "tests/unit/services/rsu/algorithms/one_lane.hpp"

namespace lukou {
namespace {

constexpr Lane kLane = static_cast<Lane>(1);
constexpr double kLimit_mps = 60.0 / 3.6;
constexpr double kChange_mps = 0.1 * 5.0 / 3.6;  // 5 km/h per s, in a step

class SpeedHarmonisationTest : public testing::Test {
 protected:
  SpeedHarmonisation algorithm_{SpeedHarmonisationParameters{.approach = {.activation_distance_m = 500.0}}};
  test::OneLane road_;
};

TEST_F(SpeedHarmonisationTest, LowersTheSpeedOfALaneByFiveKilometresPerHourInASecond) {
  road_.red_until(385);
  road_.cars({{300.0, 15.0}});
  road_.answer(algorithm_, 0);
  EXPECT_NEAR(algorithm_.lane_speed_mps(kLane), kLimit_mps - kChange_mps, 1e-12);
  for (Step now = 1; now < 10; ++now) road_.answer(algorithm_, now);
  EXPECT_NEAR(algorithm_.lane_speed_mps(kLane), kLimit_mps - 5.0 / 3.6, 1e-12);
  EXPECT_DOUBLE_EQ(algorithm_.lane_speed_mps(static_cast<Lane>(2)), kLimit_mps) << "a lane without cars";
}

TEST_F(SpeedHarmonisationTest, GivesAllCarsOfTheLaneTheLeastOfTheirSpeeds) {
  // Green at 38.5 s, crossings at 40 and 42 s: 300 / 40 = 7.5 m/s and 420 / 42 = 10 m/s. Kept where they are, as long
  // as it takes: (16.67 - 7.5) / 0.139 = 66 steps, while the time left falls; here the light waits with them.
  for (Step now = 0; now < 70; ++now) {
    road_.red_until(now + 385);
    road_.cars({{300.0, 9.0}, {420.0, 9.0}});
    road_.answer(algorithm_, now);
  }
  EXPECT_NEAR(algorithm_.lane_speed_mps(kLane), 7.5, 1e-9);
  road_.red_until(70 + 385);
  const auto said = road_.answer(algorithm_, 70);
  ASSERT_EQ(said.size(), 2U);
  for (const auto& item : said) EXPECT_DOUBLE_EQ(item.advice->acceleration_mps2, -0.75);  // (7.5 - 9) / 2
}

TEST_F(SpeedHarmonisationTest, LeavesCarsOfTheGreenThatShowsAlone) {
  road_.green_until(120);
  road_.cars({{150.0, 15.0}, {300.0, 15.0}});  // there after 10 and 20 s
  const auto said = road_.answer(algorithm_, 0);
  ASSERT_EQ(said.size(), 1U);
  EXPECT_EQ(said[0].car, TemporaryId{78});
}

TEST_F(SpeedHarmonisationTest, GoesBackToTheLimitAndReleases) {
  road_.red_until(385);
  road_.cars({{300.0, 15.0}});
  for (Step now = 0; now < 5; ++now) road_.answer(algorithm_, now);
  road_.green_until(2000);
  const auto said = road_.answer(algorithm_, 5);
  ASSERT_EQ(said.size(), 1U);
  EXPECT_FALSE(said[0].advice);
  EXPECT_NEAR(algorithm_.lane_speed_mps(kLane), kLimit_mps - 4.0 * kChange_mps, 1e-12);
  for (Step now = 6; now < 10; ++now) EXPECT_TRUE(road_.answer(algorithm_, now).empty());
  EXPECT_NEAR(algorithm_.lane_speed_mps(kLane), kLimit_mps, 1e-12);
}

}  // namespace
}  // namespace lukou
