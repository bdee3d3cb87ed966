#include "services/rsu/algorithms/eco.hpp"

#include <gtest/gtest.h>

#include "tests/unit/services/rsu/algorithms/one_lane.hpp"

namespace lukou {
namespace {

class EcoTest : public testing::Test {
 protected:
  std::vector<RsuAnswer::Item> answer(const EcoParameters& parameters) {
    Eco algorithm(parameters);
    return road_.answer(algorithm, 0);
  }

  test::OneLane road_;
};

TEST_F(EcoTest, BrakesAsTheClosedFormSays) {
  // Green at 23.5 s, crossing at 25 s; 300 m at 15 m/s: 3 (300 - 375) / 625 = -0.36 m/s2.
  road_.red_until(235);
  road_.cars({{300.0, 15.0}});
  const auto said = answer({});
  ASSERT_EQ(said.size(), 1U);
  ASSERT_TRUE(said[0].advice);
  EXPECT_DOUBLE_EQ(said[0].advice->acceleration_mps2, -0.36);
  EXPECT_EQ(said[0].advice->binding, Binding::kFollowing);
}

TEST_F(EcoTest, BrakesHarderToBeFasterAtTheLine) {
  // To 15 m/s at the line: (1800 - 50 * 45) / 625 = -0.72 m/s2.
  road_.red_until(235);
  road_.cars({{300.0, 15.0}});
  const auto said = answer({.approach = {}, .queue = {}, .end_speed_mps = 15.0});
  ASSERT_EQ(said.size(), 1U);
  EXPECT_DOUBLE_EQ(said[0].advice->acceleration_mps2, -0.72);
}

TEST_F(EcoTest, FallsBackToAnEvenSpeedWhereTheClosedFormGetsTooSlow) {
  // 40 s for 300 m: the free end would be at 3.75 m/s, below 5 m/s.
  road_.red_until(385);
  road_.cars({{300.0, 15.0}});
  EXPECT_DOUBLE_EQ(answer({})[0].advice->acceleration_mps2, -1.5);
}

TEST_F(EcoTest, LeavesACarAloneThatMakesTheGreenThatShows) {
  road_.green_until(450);
  road_.cars({{150.0, 15.0}});
  EXPECT_TRUE(answer({}).empty());
}

TEST_F(EcoTest, WaitsForTheQueue) {
  // Green at 8.5 s, the queue's car at 14 m crosses at 10 + 5 s, the next at 17 s: 3 (200 - 255) / 289 = -0.571 m/s2,
  // 15 + 1.5 (200 - 255) / 17 = 10.1 m/s at the line.
  road_.red_until(85);
  road_.cars({{14.0, 0.0}, {200.0, 15.0}});
  const auto said = answer({});
  ASSERT_EQ(said.size(), 1U);
  EXPECT_EQ(said[0].car, TemporaryId{78});
  EXPECT_DOUBLE_EQ(said[0].advice->acceleration_mps2, -0.57);
}

}  // namespace
}  // namespace lukou
