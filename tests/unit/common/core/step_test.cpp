#include "common/core/step.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace lukou {
namespace {

TEST(StepTime, IsATenthOfASecondPerStep) {
  EXPECT_EQ(time_s(0), 0.0);
  EXPECT_EQ(time_s(1), 0.1);
  EXPECT_EQ(time_s(72000), 7200.0);
  // 3 * 0.1 is 0.30000000000000004: a product would miss the time that people write.
  EXPECT_EQ(time_s(3), 0.3);
  EXPECT_EQ(kStepsPerSecond * kStep_ms, 1000);
  EXPECT_EQ(static_cast<double>(kStepsPerSecond) * kStep_s, 1.0);
}

TEST(StepAtOrAfter, IsExactForEveryMultipleOfAStepInTenHours) {
  for (Step k = 0; k <= 360000; ++k) {
    ASSERT_EQ(step_at_or_after(time_s(k)), k);
    ASSERT_EQ(step_at_or_after(static_cast<double>(k) * 0.1), k) << "the product has its own rounding error";
  }
}

TEST(StepAtOrAfter, IsExactUpToABillionSeconds) {
  for (Step k = 10'000'000'000 - 1000; k <= 10'000'000'000; ++k) ASSERT_EQ(step_at_or_after(time_s(k)), k);
}

TEST(StepAtOrAfter, RoundsUpBetweenTwoSteps) {
  for (Step k = 0; k < 360000; k += 7) {
    const double at_s = time_s(k);
    ASSERT_EQ(step_at_or_after(at_s + 0.001), k + 1);
    ASSERT_EQ(step_at_or_after(at_s + 0.05), k + 1);
    ASSERT_EQ(step_at_or_after(at_s + 0.099), k + 1);
  }
}

}  // namespace
}  // namespace lukou
