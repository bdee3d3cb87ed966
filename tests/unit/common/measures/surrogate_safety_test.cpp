#include "common/measures/surrogate_safety.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace lukou {
namespace {

TEST(SurrogateSafety, TimeToCollisionIsTheGapOverTheApproachSpeed) {
  EXPECT_DOUBLE_EQ(*time_to_collision_s({.gap_m = 20.0, .approach_mps = 8.0}), 2.5);
  EXPECT_FALSE(time_to_collision_s({.gap_m = 20.0, .approach_mps = 0.0}));
  EXPECT_FALSE(time_to_collision_s({.gap_m = 20.0, .approach_mps = -1.0}));
  EXPECT_DOUBLE_EQ(*time_to_collision_s({.gap_m = -0.5, .approach_mps = 1.0}), 0.0);
}

TEST(SurrogateSafety, DecelerationToAvoidACrashTakesTheApproachSpeedAwayWithinTheGap) {
  // v^2 / (2 gap) = 64 / 20
  EXPECT_DOUBLE_EQ(*deceleration_to_avoid_crash_mps2({.gap_m = 10.0, .approach_mps = 8.0}), 3.2);
  EXPECT_FALSE(deceleration_to_avoid_crash_mps2({.gap_m = 10.0, .approach_mps = 0.0}));
  EXPECT_TRUE(std::isinf(*deceleration_to_avoid_crash_mps2({.gap_m = 0.0, .approach_mps = 1.0})));
}

TEST(SurrogateSafety, ModifiedTimeToCollisionSolvesForConstantAccelerations) {
  // 12 = 2 t + 2 t^2: t = 2
  EXPECT_DOUBLE_EQ(*modified_time_to_collision_s({.gap_m = 12.0, .approach_mps = 2.0, .approach_mps2 = 4.0}), 2.0);
  // The leader brakes while both are equally fast: 9 = 0.5 * 2 t^2: t = 3
  EXPECT_DOUBLE_EQ(*modified_time_to_collision_s({.gap_m = 9.0, .approach_mps = 0.0, .approach_mps2 = 2.0}), 3.0);
  // Opening now, closing later: 4 = -t + t^2 / 2: t = 4
  EXPECT_DOUBLE_EQ(*modified_time_to_collision_s({.gap_m = 4.0, .approach_mps = -1.0, .approach_mps2 = 1.0}), 4.0);
  // The follower brakes too late: 3 = 4 t - t^2: first meeting at t = 1
  EXPECT_DOUBLE_EQ(*modified_time_to_collision_s({.gap_m = 3.0, .approach_mps = 4.0, .approach_mps2 = -2.0}), 1.0);
  // ... and in time: 5 = 4 t - t^2 has no solution
  EXPECT_FALSE(modified_time_to_collision_s({.gap_m = 5.0, .approach_mps = 4.0, .approach_mps2 = -2.0}));
  // No difference of acceleration: as TTC
  EXPECT_DOUBLE_EQ(*modified_time_to_collision_s({.gap_m = 20.0, .approach_mps = 8.0}), 2.5);
  EXPECT_FALSE(modified_time_to_collision_s({.gap_m = 20.0, .approach_mps = -1.0, .approach_mps2 = -1.0}));
}

TEST(SurrogateSafety, TheQuickChecksAgreeWithTheMeasures) {
  int encounters = 0;
  // Gaps that no time of 3 s hits exactly: there rounding would decide.
  for (double gap_m = 0.2519; gap_m < 40.0; gap_m += 1.3) {
    for (double approach_mps = -8.0; approach_mps <= 16.0; approach_mps += 0.7) {
      for (double approach_mps2 = -6.0; approach_mps2 <= 6.0; approach_mps2 += 0.9) {
        const Following pair{gap_m, approach_mps, approach_mps2};
        const auto ttc_s = time_to_collision_s(pair);
        const auto drac_mps2 = deceleration_to_avoid_crash_mps2(pair);
        const auto mttc_s = modified_time_to_collision_s(pair);
        EXPECT_EQ(is_ttc_encounter(pair), ttc_s && *ttc_s < kTtc_s);
        EXPECT_EQ(is_drac_encounter(pair), drac_mps2 && *drac_mps2 >= kDrac_mps2);
        EXPECT_EQ(is_mttc_encounter(pair), mttc_s && *mttc_s < kMttc_s)
            << gap_m << " " << approach_mps << " " << approach_mps2;
        encounters += is_mttc_encounter(pair) ? 1 : 0;
      }
    }
  }
  EXPECT_GT(encounters, 1000);
}

}  // namespace
}  // namespace lukou
