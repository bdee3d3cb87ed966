#include "services/rsu/algorithms/glosa.hpp"

#include <gtest/gtest.h>

#include "tests/unit/services/rsu/algorithms/one_lane.hpp"

namespace lukou {
namespace {

class GlosaTest : public testing::Test {
 protected:
  std::vector<RsuAnswer::Item> alone(Step now) { return road_.answer(alone_, now); }
  std::vector<RsuAnswer::Item> with_queue(Step now) { return road_.answer(with_queue_, now); }

  Glosa alone_{GlosaParameters{}};
  Glosa with_queue_{GlosaParameters{.approach = {}, .queue = QueueRules{}}};
  test::OneLane road_;
};

TEST_F(GlosaTest, AdvisesTheEvenSpeedToTheBeginOfGreen) {
  // Green at 23.5 s, crossing at 25 s: 300 m / 25 s = 12 m/s. From 13 m/s in 2 s: -0.5 m/s2.
  road_.red_until(235);
  road_.cars({{300.0, 13.0}});
  const auto said = alone(0);
  ASSERT_EQ(said.size(), 1U);
  ASSERT_TRUE(said[0].advice);
  EXPECT_DOUBLE_EQ(said[0].advice->acceleration_mps2, -0.5);
  EXPECT_EQ(said[0].advice->binding, Binding::kFollowing);
  EXPECT_EQ(said[0].advice->lifetime, 5);
}

TEST_F(GlosaTest, SlowsNobodyBelowTheLeastSpeed) {
  // 100 m in 40 s would be 2.5 m/s; the least is 5 m/s: from 6 m/s -0.5 m/s2.
  road_.red_until(385);
  road_.cars({{100.0, 6.0}});
  const auto said = alone(0);
  ASSERT_EQ(said.size(), 1U);
  EXPECT_DOUBLE_EQ(said[0].advice->acceleration_mps2, -0.5);
}

TEST_F(GlosaTest, TakesTheNextGreenWhereThisOneCannotBeReached) {
  // There after 20 s, the green ends after 10 s and the next begins at 55 s: 300 m / 56.5 s = 5.31 m/s.
  road_.green_until(100);
  road_.cars({{300.0, 15.0}});
  const auto said = alone(0);
  ASSERT_EQ(said.size(), 1U);
  EXPECT_DOUBLE_EQ(said[0].advice->acceleration_mps2, -1.5) << "no more than is comfortable";
  road_.cars({{300.0, 5.5}});  // 5.5 to 15 m/s at 2 m/s2: 4.75 s and 48.7 m, 251.3 m in 16.75 s: not before 21.5 s
  EXPECT_DOUBLE_EQ(alone(1)[0].advice->acceleration_mps2, -0.09);  // (300 / 56.4 - 5.5) / 2 = -0.0904
}

TEST_F(GlosaTest, LeavesACarAloneThatMakesTheGreenThatShows) {
  road_.green_until(450);
  road_.cars({{150.0, 15.0}});
  EXPECT_TRUE(alone(0).empty());
  EXPECT_TRUE(with_queue(0).empty());
}

TEST_F(GlosaTest, TellsACarNotToBrakeForARedThatWillBeGone) {
  road_.red_until(90);  // there after 10 s; its crossing is at 10.5 s, within the slack of 1 s
  road_.cars({{150.0, 15.0}});
  const auto said = alone(0);
  ASSERT_EQ(said.size(), 1U);
  EXPECT_EQ(said[0].advice->acceleration_mps2, 3.0);
  road_.cars({{150.1, 15.0}});
  const auto released = alone(1);
  ASSERT_EQ(released.size(), 1U);
  EXPECT_FALSE(released[0].advice) << "beyond 150 m no car brakes for red";
}

TEST_F(GlosaTest, LeavesCarsAloneThatAreFarOrStandOrCannotStopAndReleasesThemOnce) {
  GlosaParameters near;
  near.approach.activation_distance_m = 200.0;
  Glosa algorithm(near);
  road_.red_until(400);
  road_.cars({{190.0, 15.0}});
  EXPECT_EQ(road_.answer(algorithm, 0).size(), 1U);
  road_.cars({{0.5, 0.0}, {37.0, 15.0}, {201.0, 15.0}});
  const auto said = road_.answer(algorithm, 1);  // 77 stands now
  ASSERT_EQ(said.size(), 1U);
  EXPECT_EQ(said[0].car, TemporaryId{77});
  EXPECT_FALSE(said[0].advice);
  EXPECT_TRUE(road_.answer(algorithm, 2).empty());
}

TEST_F(GlosaTest, WaitsForTheQueueWhereItKnowsOfIt) {
  // Green at 10 s, first crossing at 11.5 s. The car at 14 m stands there for 14 / 2.8 = 5 s more, the next may cross
  // at 18.5 s: 148 m / 18.5 s = 8 m/s, from 9 m/s -0.5 m/s2. Alone: there at 3 s + 112 m / 15 m/s = 10.47 s, and that
  // is within 1 s of 11.5 s but for 0.03 s: 148 / 11.5 = 12.87 m/s, +1.93 m/s2.
  road_.red_until(100);
  road_.cars({{14.0, 0.0}, {148.0, 9.0}});
  const auto waits = with_queue(0);
  ASSERT_EQ(waits.size(), 1U);
  EXPECT_EQ(waits[0].car, TemporaryId{78});
  EXPECT_DOUBLE_EQ(waits[0].advice->acceleration_mps2, -0.5);
  const auto does_not = alone(0);
  ASSERT_EQ(does_not.size(), 1U);
  EXPECT_DOUBLE_EQ(does_not[0].advice->acceleration_mps2, 1.93);
}

TEST_F(GlosaTest, KeepsAHeadwayWhereItKnowsOfTheQueue) {
  // Both would be there at once, after 10 s: the second has its turn 2 s later, 152 m / 12 s = 12.67 m/s.
  road_.green_until(450);
  road_.cars({{150.0, 15.0}, {152.0, 15.0}});
  EXPECT_TRUE(alone(0).empty());
  const auto said = with_queue(0);
  ASSERT_EQ(said.size(), 1U);
  EXPECT_EQ(said[0].car, TemporaryId{78});
  EXPECT_DOUBLE_EQ(said[0].advice->acceleration_mps2, -1.16);  // (12.667 - 15) / 2 = -1.167
}

}  // namespace
}  // namespace lukou
