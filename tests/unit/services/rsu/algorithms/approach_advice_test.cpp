#include "services/rsu/algorithms/approach_advice.hpp"

#include <gtest/gtest.h>

namespace lukou {
namespace {

constexpr double kLimit_mps = 60.0 / 3.6;
constexpr HeardCar kCar{.id = TemporaryId{77}, .distance_m = 100.0, .speed_mps = 15.0};

TEST(ApproachAdvice, SaysWhatEveryCarTakesAndAMessageCarries) {
  ApproachRules rules;
  rules.acceleration_max_mps2 = 1.239;
  rules.lifetime_s = 0.75;
  ApproachAdvice advice(rules);
  RsuAnswer said;
  advice.advise(kCar, -0.6789, said);
  advice.go(kCar, said);
  ASSERT_EQ(said.items().size(), 2U);
  EXPECT_DOUBLE_EQ(said.items()[0].advice->acceleration_mps2, -0.67);
  EXPECT_DOUBLE_EQ(said.items()[1].advice->acceleration_mps2, 1.23);
  EXPECT_EQ(said.items()[0].advice->binding, Binding::kFollowing);
  EXPECT_EQ(said.items()[0].advice->lifetime, 8) << "whole steps, never less than asked";
}

TEST(ApproachAdvice, ReleasesACarOnce) {
  ApproachAdvice advice(ApproachRules{});
  RsuAnswer said;
  advice.release(kCar, said);
  EXPECT_TRUE(said.items().empty()) << "it was never advised";
  advice.advise(kCar, -1.0, said);
  advice.end_step();
  said.clear();
  advice.release(kCar, said);
  advice.end_step();
  ASSERT_EQ(said.items().size(), 1U);
  EXPECT_FALSE(said.items()[0].advice);
  said.clear();
  advice.release(kCar, said);
  EXPECT_TRUE(said.items().empty());
}

TEST(NeedOf, IsNothingInAGreenThatShowsAndGoBeforeOneToCome) {
  const ApproachRules rules;  // slack 1 s
  LaneView lane;
  lane.aspect = Aspect::kGreen;
  Crossing crossing{Crossing::Kind::kPlanned, 10.0, 11.0, {}};
  EXPECT_EQ(need_of(rules, lane, crossing), Need::kNothing);
  crossing.time_s = 11.1;
  EXPECT_EQ(need_of(rules, lane, crossing), Need::kDelay);
  lane.aspect = Aspect::kRed;
  EXPECT_EQ(need_of(rules, lane, crossing), Need::kDelay);
  crossing.time_s = 11.0;
  EXPECT_EQ(need_of(rules, lane, crossing), Need::kGo);
}

TEST(EvenSpeed, IsSnappedToTheBounds) {
  const ApproachRules rules;  // at least 5 m/s
  EXPECT_DOUBLE_EQ(even_speed_mps(rules, {.distance_m = 300.0, .speed_mps = 15.0, .time_s = 25.0}, kLimit_mps), 12.0);
  EXPECT_DOUBLE_EQ(even_speed_mps(rules, {.distance_m = 100.0, .speed_mps = 15.0, .time_s = 25.0}, kLimit_mps), 5.0);
  EXPECT_DOUBLE_EQ(even_speed_mps(rules, {.distance_m = 500.0, .speed_mps = 15.0, .time_s = 25.0}, kLimit_mps),
                   kLimit_mps);
  EXPECT_DOUBLE_EQ(even_speed_mps(rules, {.distance_m = 10.0, .speed_mps = 3.0, .time_s = 25.0}, 4.0), 4.0)
      << "a limit below the least speed holds";
}

TEST(TowardsASpeed, IsReachedInTheGainTimeWithinComfort) {
  const ApproachRules rules;  // 2 s, -1.5 to 2 m/s2
  EXPECT_DOUBLE_EQ(towards_mps2(rules, 13.0, 12.0), -0.5);
  EXPECT_DOUBLE_EQ(towards_mps2(rules, 15.0, 5.0), -1.5);
  EXPECT_DOUBLE_EQ(towards_mps2(rules, 5.0, 15.0), 2.0);
}

TEST(SmoothArrival, IsTheClosedFormWhereThatIsComfortable) {
  const ApproachRules rules;
  const ArrivalGoal goal{.distance_m = 300.0, .speed_mps = 15.0, .time_s = 25.0};
  EXPECT_DOUBLE_EQ(smooth_arrival_mps2(rules, goal, kLimit_mps, std::nullopt), -0.36);
  EXPECT_DOUBLE_EQ(smooth_arrival_mps2(rules, goal, kLimit_mps, 15.0), -0.72);
}

TEST(SmoothArrival, BrakesAndHoldsWhereTheClosedFormWouldGetTooSlow) {
  // A free end of 15 + 1.5 (300 - 600) / 40 = 3.75 m/s lies below 5 m/s. At 1.5 m/s2 down to
  // 15 - 60 + sqrt(3600 - 900) = 6.9615 m/s: more than 1.5 m/s2 in 2 s, so as much as is comfortable.
  const ApproachRules rules;
  EXPECT_DOUBLE_EQ(
      smooth_arrival_mps2(rules, {.distance_m = 300.0, .speed_mps = 15.0, .time_s = 40.0}, kLimit_mps, std::nullopt),
      -1.5);
  // Once it drives at 7 m/s, 210 m and 30 s before its arrival, it holds that.
  EXPECT_NEAR(smooth_arrival_mps2(rules, {.distance_m = 210.0, .speed_mps = 7.0, .time_s = 30.0}, kLimit_mps, 16.0),
              0.0, 1e-12);
}

TEST(SmoothArrival, DoesNotAskForLessThanTheLeastSpeed) {
  // 5.5 - 60 + sqrt(3600 - 3 * 160) = 1.36 m/s would be right; 5 m/s is the least: -0.5 m/s in 2 s.
  const ApproachRules rules;
  EXPECT_DOUBLE_EQ(
      smooth_arrival_mps2(rules, {.distance_m = 60.0, .speed_mps = 5.5, .time_s = 40.0}, kLimit_mps, std::nullopt),
      -0.25);
}

TEST(SmoothArrival, IsAnEvenSpeedOnTheLastPart) {
  // 9.5 m in 1 s at 10 m/s: braking to c with 10 - 1.5 + sqrt(2.25 - 1.5) = 9.366, -0.317 m/s2 in 2 s.
  const ApproachRules rules;
  EXPECT_NEAR(
      smooth_arrival_mps2(rules, {.distance_m = 9.5, .speed_mps = 10.0, .time_s = 1.0}, kLimit_mps, std::nullopt),
      -0.317, 1e-3);
}

}  // namespace
}  // namespace lukou
