#include "services/rsu/sdk/arrival.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace lukou {
namespace {

/// 375 m at the present speed in the time given: 75 m too many.
constexpr ArrivalGoal kEarly{.distance_m = 300.0, .speed_mps = 15.0, .time_s = 25.0};

double end_speed_mps(const ArrivalGoal& goal, const RampedAcceleration& ramp) {
  return goal.speed_mps + ramp.start_mps2 * goal.time_s + 0.5 * ramp.slope_mps3 * goal.time_s * goal.time_s;
}
double way_m(const ArrivalGoal& goal, const RampedAcceleration& ramp) {
  const double t = goal.time_s;
  return goal.speed_mps * t + ramp.start_mps2 * t * t / 2.0 + ramp.slope_mps3 * t * t * t / 6.0;
}
/// The integral of a^2 over the way.
double effort(const ArrivalGoal& goal, const RampedAcceleration& ramp) {
  const double t = goal.time_s;
  return ramp.start_mps2 * ramp.start_mps2 * t + ramp.start_mps2 * ramp.slope_mps3 * t * t +
         ramp.slope_mps3 * ramp.slope_mps3 * t * t * t / 3.0;
}

TEST(SmoothestArrival, WithAFreeEndBrakesLessAndLess) {
  const RampedAcceleration ramp = smoothest_arrival(kEarly);
  EXPECT_DOUBLE_EQ(ramp.start_mps2, -0.36);               // 3 (300 - 375) / 625
  EXPECT_DOUBLE_EQ(ramp.slope_mps3, 0.0144);              // up to 0 after 25 s
  EXPECT_NEAR(end_speed_mps(kEarly, ramp), 10.5, 1e-12);  // 15 + 1.5 (300 - 375) / 25
  EXPECT_NEAR(way_m(kEarly, ramp), 300.0, 1e-9);
  const Extent speeds = speeds_on_the_way_mps(kEarly, ramp);
  EXPECT_NEAR(speeds.least, 10.5, 1e-12);
  EXPECT_DOUBLE_EQ(speeds.most, 15.0);
  const Extent accelerations = accelerations_on_the_way_mps2(kEarly, ramp);
  EXPECT_DOUBLE_EQ(accelerations.least, -0.36);
  EXPECT_NEAR(accelerations.most, 0.0, 1e-12);
}

TEST(SmoothestArrival, WithAGivenEndBrakesAndSpeedsUp) {
  const RampedAcceleration ramp = smoothest_arrival(kEarly, 15.0);
  EXPECT_DOUBLE_EQ(ramp.start_mps2, -0.72);   // (1800 - 50 * 45) / 625
  EXPECT_DOUBLE_EQ(ramp.slope_mps3, 0.0576);  // (150 * 30 - 3600) / 15625
  EXPECT_NEAR(end_speed_mps(kEarly, ramp), 15.0, 1e-12);
  EXPECT_NEAR(way_m(kEarly, ramp), 300.0, 1e-9);
  EXPECT_NEAR(accelerations_on_the_way_mps2(kEarly, ramp).most, 0.72, 1e-12);
  // Slowest half way: 15 - 0.72 * 12.5 + 0.0288 * 156.25.
  EXPECT_NEAR(speeds_on_the_way_mps(kEarly, ramp).least, 10.5, 1e-12);
}

TEST(SmoothestArrival, CostsWhatTheLawSays) {
  // (4 / T^3) (3 d^2 - 3 d T (v + w) + T^2 (v^2 + v w + w^2)): 4.32 for w = v = 15.
  EXPECT_NEAR(effort(kEarly, smoothest_arrival(kEarly, 15.0)), 4.32, 1e-9);
  // A free end costs 3 (d - v T)^2 / T^3 = 1.08, less than any given one.
  EXPECT_NEAR(effort(kEarly, smoothest_arrival(kEarly)), 1.08, 1e-9);
  EXPECT_GT(effort(kEarly, smoothest_arrival(kEarly, 10.0)), 1.08);
  EXPECT_GT(effort(kEarly, smoothest_arrival(kEarly, 11.0)), 1.08);
}

TEST(SmoothestArrival, GoesOnAsPlannedWhenItIsPlannedAnew) {
  // After 5 s of the free end: v = 15 - 1.8 + 0.18 = 13.38, way 75 - 4.5 + 0.3 = 70.8 m, a = -0.36 + 0.072.
  const RampedAcceleration ramp = smoothest_arrival({.distance_m = 229.2, .speed_mps = 13.38, .time_s = 20.0});
  EXPECT_NEAR(ramp.start_mps2, -0.288, 1e-9);
  EXPECT_NEAR(ramp.slope_mps3, 0.0144, 1e-9);
}

TEST(CruiseAfterBraking, IsThatOfTheFormula) {
  // 15 - 25 + sqrt(625 - 150).
  const auto cruise_mps = cruise_after_braking_mps(kEarly, 1.0);
  ASSERT_TRUE(cruise_mps);
  EXPECT_NEAR(*cruise_mps, 11.7945, 1e-4);
  const double braking_s = 15.0 - *cruise_mps;
  EXPECT_NEAR(15.0 * braking_s - 0.5 * braking_s * braking_s + *cruise_mps * (25.0 - braking_s), 300.0, 1e-9);
}

TEST(CruiseAfterBraking, IsEmptyForACarThatIsLateOrWouldHaveToStand) {
  EXPECT_FALSE(cruise_after_braking_mps({.distance_m = 400.0, .speed_mps = 15.0, .time_s = 25.0}, 1.0));
  // Braking at 1 m/s2 all the time takes 15 * 10 - 50 = 100 m.
  EXPECT_FALSE(cruise_after_braking_mps({.distance_m = 99.0, .speed_mps = 15.0, .time_s = 10.0}, 1.0));
  EXPECT_TRUE(cruise_after_braking_mps({.distance_m = 101.0, .speed_mps = 15.0, .time_s = 10.0}, 1.0));
  // It comes to stand after 15 s and 112.5 m.
  EXPECT_FALSE(cruise_after_braking_mps({.distance_m = 112.0, .speed_mps = 15.0, .time_s = 60.0}, 1.0));
}

TEST(CruiseAfterSpeedingUp, IsThatOfTheFormula) {
  // 10 + 25 - sqrt(625 - 100) = 12.0871: 23.05 m in 2.087 s, then 276.95 m in 22.913 s.
  const auto cruise_mps = cruise_after_speeding_up_mps({.distance_m = 300.0, .speed_mps = 10.0, .time_s = 25.0}, 1.0);
  ASSERT_TRUE(cruise_mps);
  EXPECT_NEAR(*cruise_mps, 12.0871, 1e-4);
  EXPECT_FALSE(cruise_after_speeding_up_mps(kEarly, 1.0)) << "it is early";
  // Speeding up all the time takes 10 * 10 + 50 = 150 m.
  EXPECT_FALSE(cruise_after_speeding_up_mps({.distance_m = 151.0, .speed_mps = 10.0, .time_s = 10.0}, 1.0));
}

}  // namespace
}  // namespace lukou
