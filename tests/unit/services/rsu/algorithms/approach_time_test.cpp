#include "services/rsu/algorithms/approach_time.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace lukou {
namespace {

constexpr SpeedRates kRates = {.speeding_up_mps2 = 2.0, .slowing_down_mps2 = 1.0, .final_braking_mps2 = 1.5};

double time_s(double distance_m, double speed_mps, double cruise_mps, double final_mps) {
  return approach_time_s(
      kRates, {.distance_m = distance_m, .speed_mps = speed_mps, .cruise_mps = cruise_mps, .final_mps = final_mps});
}

TEST(ApproachTime, IsDistanceOverSpeedWithoutAChange) { EXPECT_DOUBLE_EQ(time_s(100.0, 10.0, 10.0, 10.0), 10.0); }

TEST(ApproachTime, AddsTheTimesOfItsParts) {
  // 10 to 15 m/s: 2.5 s over 31.25 m, then 68.75 m at 15 m/s.
  EXPECT_NEAR(time_s(100.0, 10.0, 15.0, 15.0), 2.5 + 68.75 / 15.0, 1e-12);
  // 15 to 10 m/s: 5 s over 62.5 m, then 137.5 m at 10 m/s.
  EXPECT_NEAR(time_s(200.0, 15.0, 10.0, 10.0), 5.0 + 13.75, 1e-12);
  // At the end 15 to 9 m/s: 4 s over 48 m, before it 52 m at 15 m/s.
  EXPECT_NEAR(time_s(100.0, 15.0, 15.0, 9.0), 4.0 + 52.0 / 15.0, 1e-12);
}

TEST(ApproachTime, IsCutOffAtTheLine) {
  // From rest over 9 m at 2 m/s2: sqrt(2 * 9 / 2) = 3 s.
  EXPECT_NEAR(time_s(9.0, 0.0, 15.0, 15.0), 3.0, 1e-12);
  // Braking from 15 m/s at 1 m/s2 for 2 s covers 28 m.
  EXPECT_NEAR(time_s(28.0, 15.0, 3.0, 3.0), 2.0, 1e-12);
  // Held at 10 m/s, then up to 15 m/s, which takes 31.25 m: with 24 m it is at 14 m/s after 2 s.
  EXPECT_NEAR(time_s(24.0, 10.0, 10.0, 15.0), 2.0, 1e-12);
  // 15 m/s, then down to 3 m/s at 1.5 m/s2, which takes 72 m: with 48 m it is at 9 m/s after 4 s.
  EXPECT_NEAR(time_s(48.0, 15.0, 15.0, 3.0), 4.0, 1e-12);
}

TEST(ApproachTime, NeverRisesWithTheCruisingSpeedWhereTheLineCutsNoBrakingOff) {
  for (const double distance_m : {5.0, 20.0, 60.0, 150.0, 480.0}) {
    for (double speed_mps = 0.0; speed_mps <= 16.5; speed_mps += 1.5) {
      for (const double final_mps : {6.4, 10.0, 15.0}) {
        // Braking to the final speed takes most room at the lower of the two rates.
        if (speed_mps * speed_mps - final_mps * final_mps > 2.0 * distance_m) continue;
        double before_s = time_s(distance_m, speed_mps, 3.0, final_mps);
        for (double cruise_mps = 3.01; cruise_mps <= std::fmax(speed_mps, final_mps); cruise_mps += 0.01) {
          const double now_s = time_s(distance_m, speed_mps, cruise_mps, final_mps);
          ASSERT_LE(now_s, before_s + 1e-9) << distance_m << " " << speed_mps << " " << final_mps << " " << cruise_mps;
          before_s = now_s;
        }
      }
    }
  }
}

}  // namespace
}  // namespace lukou
