#include "services/rsu/algorithms/crossing_plan.hpp"

#include <gtest/gtest.h>

#include "tests/unit/services/rsu/algorithms/one_lane.hpp"

namespace lukou {
namespace {

constexpr QueueRules kQueue{.headway_s = 2.0, .spacing_m = 5.6, .equipped_share = 1.0};  // 2.8 m/s

class CrossingPlanTest : public testing::Test {
 protected:
  CrossingPlanTest() { rules_.first_crossing_s = 1.0; }
  std::vector<Crossing> plan(Step now, const std::optional<QueueRules>& queue) {
    std::vector<Crossing> plan;
    plan_lane(rules_, queue, road_.view(now), road_.lane(), plan);
    return plan;
  }

  ApproachRules rules_;  // speeding up at 2 m/s2, tail 2.5 s
  test::OneLane road_;
};

TEST_F(CrossingPlanTest, PutsACarIntoTheGreenThatShows) {
  road_.green_until(450);
  road_.cars({{150.0, 15.0}});
  const auto planned = plan(0, std::nullopt);
  ASSERT_EQ(planned.size(), 1U);
  EXPECT_EQ(planned[0].kind, Crossing::Kind::kPlanned);
  EXPECT_DOUBLE_EQ(planned[0].earliest_s, 10.0);
  EXPECT_DOUBLE_EQ(planned[0].time_s, 10.0);
}

TEST_F(CrossingPlanTest, PutsACarThatIsEarlyBehindTheBeginOfGreen) {
  road_.red_until(200);
  road_.cars({{150.0, 15.0}});
  const auto planned = plan(0, std::nullopt);
  EXPECT_DOUBLE_EQ(planned[0].earliest_s, 10.0);
  EXPECT_DOUBLE_EQ(planned[0].time_s, 21.0);
  EXPECT_DOUBLE_EQ(planned[0].green.begin_s, 20.0);
}

TEST_F(CrossingPlanTest, LetsACarUseTheTailOfAGreen) {
  road_.green_until(80);
  road_.cars({{150.0, 15.0}});
  EXPECT_DOUBLE_EQ(plan(0, std::nullopt)[0].time_s, 10.0);  // 2 s after the end
  road_.green_until(74);
  EXPECT_DOUBLE_EQ(plan(0, std::nullopt)[0].time_s, 53.4);  // 2.6 s: the next green begins at 52.4 s
}

TEST_F(CrossingPlanTest, KnowsWhoCannotStopWhoWaitsAndWhatIsUnknown) {
  road_.red_until(200);
  road_.cars({{37.0, 15.0}, {60.0, 3.0}, {100.0, 15.0}});  // 15^2 / 6 = 37.5 m to stop
  const auto planned = plan(0, std::nullopt);
  EXPECT_EQ(planned[0].kind, Crossing::Kind::kCommitted);
  EXPECT_EQ(planned[1].kind, Crossing::Kind::kQueued);
  EXPECT_EQ(planned[2].kind, Crossing::Kind::kPlanned);
  road_.no_change_is_known();
  EXPECT_EQ(plan(0, std::nullopt)[2].kind, Crossing::Kind::kUnknown);
}

TEST_F(CrossingPlanTest, LetsAQueueDischargeBeforeTheNextCar) {
  // The second car stands at 28 m: 28 / 2.8 = 10 s after the first crossing at 21 s. It tells of the cars ahead of it,
  // heard or not. The third, which would be there after 10 s, a headway later; the fourth 2 s after that.
  road_.red_until(200);
  road_.cars({{0.7, 0.0}, {28.0, 0.0}, {150.0, 15.0}, {170.0, 15.0}});
  const auto planned = plan(0, kQueue);
  EXPECT_NEAR(planned[0].time_s, 21.25, 1e-9);
  EXPECT_NEAR(planned[1].time_s, 31.0, 1e-9);
  EXPECT_NEAR(planned[2].time_s, 33.0, 1e-9);
  EXPECT_NEAR(planned[3].time_s, 35.0, 1e-9);
}

TEST_F(CrossingPlanTest, ExpectsHiddenCarsBehindTheQueueOnly) {
  // At a share of 0.4: (1 - 0.4) / 0.4 = 1.5 cars, 3 s more for the third car, and no more for the fourth.
  road_.red_until(200);
  road_.cars({{0.7, 0.0}, {28.0, 0.0}, {150.0, 15.0}, {170.0, 15.0}});
  const auto planned = plan(0, QueueRules{.headway_s = 2.0, .spacing_m = 5.6, .equipped_share = 0.4});
  EXPECT_NEAR(planned[2].time_s, 36.0, 1e-9);
  EXPECT_NEAR(planned[3].time_s, 38.0, 1e-9);
}

TEST_F(CrossingPlanTest, StartsBehindTheLastCrossing) {
  road_.green_until(2000);
  road_.last_crossing(99.9);
  road_.cars({{15.0, 15.0}});  // there after 1 s, 101 s
  EXPECT_DOUBLE_EQ(plan(1000, kQueue)[0].time_s, 101.9);
  EXPECT_DOUBLE_EQ(plan(1000, std::nullopt)[0].time_s, 101.0);
}

TEST_F(CrossingPlanTest, LetsALongQueueWaitForTheSecondGreen) {
  // Green from 20 to 65 s: 44 s from the first crossing on, 123.2 m. A car at 140 m has 16.8 m left, 6 s, when the
  // second green has begun at 110 s.
  road_.red_until(200);
  const LaneView lane = road_.lane();
  EXPECT_NEAR(*queue_crossing_s(rules_, kQueue, lane, 0.0, 123.0), 21.0 + 123.0 / 2.8, 1e-9);
  EXPECT_NEAR(*queue_crossing_s(rules_, kQueue, lane, 0.0, 140.0), 111.0 + 6.0, 1e-9);
  road_.no_change_is_known();
  EXPECT_FALSE(queue_crossing_s(rules_, kQueue, road_.lane(), 0.0, 1.0));
}

}  // namespace
}  // namespace lukou
