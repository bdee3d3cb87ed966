#include "services/lukou/study/statistics/delay_formulas.hpp"

#include <gtest/gtest.h>

namespace lukou::statistics {
namespace {

/// A cycle of 90 s with 43 s of effective green.
SignalisedLane lane(double saturation_veh_per_h, double flow_veh_per_h) {
  return {
      .flow_veh_per_h = flow_veh_per_h, .saturation_veh_per_h = saturation_veh_per_h, .cycle_s = 90.0, .green_s = 43.0};
}

TEST(WebsterDelay, HasItsThreeTerms) {
  // g/C = .4778, capacity 860, x = .6977: 90 (.5222)^2 / (2 (1 - .3333)) = 18.41; .4868 / (2 (1/6) .3023) = 4.83;
  // .65 (90 / (1/6)^2)^(1/3) .6977^4.389 = 1.98.
  EXPECT_NEAR(*webster_delay_s(lane(1800.0, 600.0)), 18.41 + 4.83 - 1.98, 0.02);
}

TEST(WebsterDelay, IsThatOfWorkedExamples) {
  EXPECT_NEAR(*webster_delay_s(lane(1600.0, 300.0)), 16.4, 0.05);
  EXPECT_NEAR(*webster_delay_s(lane(1600.0, 600.0)), 24.9, 0.05);
  EXPECT_NEAR(*webster_delay_s(lane(1800.0, 800.0)), 44.2, 0.05);
  EXPECT_NEAR(*webster_delay_s(lane(1900.0, 600.0)), 20.2, 0.05);
}

TEST(WebsterDelay, HasNoValueAtSaturation) { EXPECT_FALSE(webster_delay_s(lane(1600.0, 800.0))); }

TEST(HcmDelay, IsThatOfWorkedExamples) {
  EXPECT_NEAR(hcm_delay_s(lane(1600.0, 300.0), 900.0), 16.6, 0.05);
  EXPECT_NEAR(hcm_delay_s(lane(1600.0, 600.0), 900.0), 27.6, 0.05);
  EXPECT_NEAR(hcm_delay_s(lane(1800.0, 800.0), 900.0), 39.9, 0.05);
  EXPECT_NEAR(hcm_delay_s(lane(1800.0, 800.0), 3600.0), 45.6, 0.05);
}

TEST(HcmDelay, GrowsWithTheTimeAnalysedAboveSaturation) {
  EXPECT_NEAR(hcm_delay_s(lane(1600.0, 800.0), 900.0), 68.9, 0.05);
  EXPECT_NEAR(hcm_delay_s(lane(1600.0, 800.0), 3600.0), 144.0, 0.5);
}

}  // namespace
}  // namespace lukou::statistics
