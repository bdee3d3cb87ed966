#include "services/lukou/study/statistics/intervals.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace lukou::statistics {
namespace {

using Values = std::vector<double>;

TEST(StudentQuantile, IsThatOfTheTables) {
  EXPECT_NEAR(student_quantile(1, 0.95), 12.706, 0.0005);
  EXPECT_NEAR(student_quantile(4, 0.95), 2.776, 0.0005);
  EXPECT_NEAR(student_quantile(9, 0.99), 3.250, 0.0005);
  EXPECT_NEAR(student_quantile(100000, 0.95), 1.960, 0.0005);
}

TEST(Estimate, HasMeanDeviationAndStudentsHalfWidth) {
  const Estimate found = estimate(Values{1.0, 2.0, 3.0, 4.0, 5.0}, 0.95);
  EXPECT_EQ(found.n, 5U);
  EXPECT_DOUBLE_EQ(found.mean, 3.0);
  EXPECT_DOUBLE_EQ(found.deviation, std::sqrt(2.5));
  EXPECT_NEAR(*found.half_width, 2.776 * std::sqrt(2.5 / 5.0), 0.0005);
}

TEST(Estimate, HasNoIntervalOfOneReplication) {
  const Estimate found = estimate(Values{7.0}, 0.95);
  EXPECT_DOUBLE_EQ(found.mean, 7.0);
  EXPECT_FALSE(found.half_width);
}

TEST(Compare, SeesThroughWhatBothSidesShare) {
  // The seeds differ by up to 8, the arms by 1.0, 1.1, 0.9 and 1.0.
  const Values baseline = {10.0, 12.0, 15.0, 18.0};
  const Values arm = {9.0, 10.9, 14.1, 17.0};
  const PairedComparison found = compare(arm, baseline, 0.95);
  EXPECT_NEAR(found.difference.mean, -1.0, 1e-12);
  const double deviation = std::sqrt((0.01 + 0.01) / 3.0);
  EXPECT_NEAR(found.difference.deviation, deviation, 1e-12);
  EXPECT_NEAR(*found.difference.half_width, 3.182 * deviation / 2.0, 0.0001);
  EXPECT_LT(found.p, 0.001);
  EXPECT_GT(*found.correlation, 0.99);
  // Var(arm) + Var(baseline) over Var(difference), by hand: means 12.75 and 13.75.
  const double arm_variance = (14.0625 + 3.4225 + 1.8225 + 18.0625) / 3.0;
  const double base_variance = (14.0625 + 3.0625 + 1.5625 + 18.0625) / 3.0;
  EXPECT_NEAR(*found.variance_gain, (arm_variance + base_variance) / (deviation * deviation), 1e-9);
  EXPECT_NEAR(found.reduction->mean, 1.0 - 12.75 / 13.75, 1e-12);
}

TEST(Compare, TakesRunsThatAreEqualToTheLastDigitForNoDifference) {
  const Values same = {6.8, 6.9, 7.1};
  const PairedComparison found = compare(same, same, 0.95);
  EXPECT_EQ(found.difference.mean, 0.0);
  EXPECT_EQ(found.p, 1.0);
  EXPECT_FALSE(found.variance_gain);
  EXPECT_DOUBLE_EQ(found.reduction->mean, 0.0);
  EXPECT_DOUBLE_EQ(*found.reduction->half_width, 0.0);
}

TEST(Compare, TakesTheSameSumInAnotherOrderForEqual) {
  const Values baseline = {6.8, 6.9, 7.1};
  const Values arm = {6.8 + 1e-14, 6.9 + 1e-14, 7.1 + 2e-14};
  EXPECT_EQ(compare(arm, baseline, 0.95).p, 1.0);
  EXPECT_EQ(compare(arm, baseline, 0.95).difference.mean, 0.0);
}

TEST(Compare, HasTheTwoSidedTailOfStudentAsItsP) {
  // t = mean / (s / sqrt(n)) = 2.776, the quantile of 4 degrees: p = 0.05. Differences -d..d around m have s = d
  // sqrt(2.5).
  const double deviation = std::sqrt(2.5);
  const double mean = 2.7764451 * deviation / std::sqrt(5.0);
  const Values baseline(5, 0.0);
  const Values arm = {mean - 2.0, mean - 1.0, mean, mean + 1.0, mean + 2.0};
  EXPECT_NEAR(compare(arm, baseline, 0.95).p, 0.05, 1e-6);
}

TEST(Compare, HasNoReductionOfNothing) { EXPECT_FALSE(compare(Values{1.0, 2.0}, Values{0.0, 0.0}, 0.95).reduction); }

TEST(CompareUnpaired, HasWelchsDegreesOfFreedom) {
  // Variances 2.5 and 10 over 5: standard error sqrt(2.5), degrees (0.5 + 2)^2 / (0.5^2/4 + 2^2/4) = 5.882.
  const UnpairedComparison found =
      compare_unpaired(Values{1.0, 2.0, 3.0, 4.0, 5.0}, Values{2.0, 4.0, 6.0, 8.0, 10.0}, 0.95);
  EXPECT_DOUBLE_EQ(found.difference.mean, -3.0);
  EXPECT_NEAR(*found.difference.half_width / std::sqrt(2.5), 2.459, 0.002);  // between t5 = 2.571 and t6 = 2.447
  EXPECT_NEAR(found.p, 0.1073, 0.0005);
}

TEST(Holm, CorrectsStepByStep) {
  // Sorted: 0.01 * 4, 0.02 * 3, 0.03 * 2, 0.2 * 1; never below the one before.
  EXPECT_EQ(holm(Values{0.03, 0.01, 0.2, 0.02}), (Values{0.06, 0.04, 0.2, 0.06}));
  EXPECT_EQ(holm(Values{0.6, 0.7}), (Values{1.0, 1.0}));
  EXPECT_EQ(holm(Values{0.04}), (Values{0.04}));
  EXPECT_TRUE(holm({}).empty());
}

TEST(ReplicationsNeeded, GoBySquareOfWhatIsMissing) {
  // 5 runs, mean 100, s = 10: t = 2.776, for 5 %: (2.776 * 10 / 5)^2 = 30.8.
  const Estimate at_hand{.n = 5, .mean = 100.0, .deviation = 10.0, .half_width = 12.4};
  EXPECT_EQ(replications_needed(at_hand, 0.05, 0.95), 31U);
  EXPECT_FALSE(replications_needed({.n = 5, .mean = 0.0, .deviation = 1.0, .half_width = 1.0}, 0.05, 0.95));
  EXPECT_FALSE(replications_needed({.n = 1, .mean = 1.0, .deviation = 0.0, .half_width = {}}, 0.05, 0.95));
}

}  // namespace
}  // namespace lukou::statistics
