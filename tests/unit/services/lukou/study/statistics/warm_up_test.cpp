#include "services/lukou/study/statistics/warm_up.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "common/core/keyed_random.hpp"

namespace lukou::statistics {
namespace {

double normal(std::uint64_t run, std::uint64_t index) {
  return standard_normal(
      {.run_seed = 11, .purpose = Purpose::kTest, .entity = static_cast<std::uint32_t>(run), .index = index});
}

/// High for `warm_up` observations, then level; unit noise on top.
Series step_down(std::uint64_t run, std::size_t warm_up, std::size_t length, double height) {
  Series series;
  for (std::size_t i = 0; i < length; ++i) series.push_back((i < warm_up ? height : 0.0) + normal(run, i));
  return series;
}

TEST(Mser5, CutsWhereTheSeriesHasAStep) {
  for (const std::size_t warm_up : {25U, 50U, 90U}) {
    const Truncation found = mser5(step_down(1, warm_up, 300, 50.0));
    EXPECT_TRUE(found.settled);
    EXPECT_GE(found.observations, warm_up);
    EXPECT_LE(found.observations, warm_up + 10);  // the noise may have one or two means more left out
  }
}

TEST(Mser5, CutsAnExponentialBeginningWhereItSinksIntoTheNoise) {
  // 20 exp(-i / 15), noise 1, over 60 runs as a study pools them: of the mean, noise 0.13, it is 13 at 10 and below the
  // noise from 15 ln(20 / 0.13) = 76 on.
  std::vector<Series> runs;
  for (std::uint64_t run = 0; run < 60; ++run) {
    Series series;
    for (std::size_t i = 0; i < 400; ++i)
      series.push_back(20.0 * std::exp(-static_cast<double>(i) / 15.0) + normal(run, i));
    runs.push_back(series);
  }
  const Truncation found = mser5(mean_over_replications(runs));
  EXPECT_TRUE(found.settled);
  EXPECT_GE(found.observations, 40U);
  EXPECT_LE(found.observations, 90U);
}

TEST(Mser5, LeavesNothingOutOfALevelSeries) {
  int cut = 0;
  for (std::uint64_t run = 0; run < 100; ++run) cut += mser5(step_down(run, 0, 300, 0.0)).observations > 60 ? 1 : 0;
  EXPECT_LE(cut, 20);  // noise alone may look like a beginning, seldom
}

TEST(Mser5, SaysThatASeriesWhichGrowsToItsEndHasNotSettled) {
  Series growing;
  for (std::size_t i = 0; i < 200; ++i) growing.push_back(static_cast<double>(i));
  EXPECT_FALSE(mser5(growing).settled);
}

TEST(Mser5, SaysThatAShortSeriesHasNotSettled) { EXPECT_FALSE(mser5(Series(49, 1.0)).settled); }

TEST(Mser5, TakesAConstantAsSettledFromTheBeginning) {
  const Truncation found = mser5(Series(100, 3.0));
  EXPECT_TRUE(found.settled);
  EXPECT_EQ(found.observations, 0U);
}

TEST(MeanOverReplications, IsAsLongAsTheShortest) {
  EXPECT_EQ(mean_over_replications(std::vector<Series>{{1.0, 2.0, 9.0}, {3.0, 4.0}}), (Series{2.0, 3.0}));
}

TEST(WelchAverage, KeepsALineAndSmoothsNoise) {
  Series line;
  for (int i = 0; i < 50; ++i) line.push_back(2.0 * i);
  const Series average = welch_average(line, 5);
  ASSERT_EQ(average.size(), 45U);
  for (std::size_t i = 0; i < average.size(); ++i) EXPECT_NEAR(average[i], line[i], 1e-9) << i;
  EXPECT_EQ(welch_average(Series{0.0, 3.0, 0.0, 3.0, 0.0}, 1), (Series{0.0, 1.0, 2.0, 1.0}));
}

TEST(WelchAverage, IsLevelOnceAKnownWarmUpIsOver) {
  std::vector<Series> runs;
  for (std::uint64_t run = 0; run < 40; ++run) runs.push_back(step_down(run, 60, 300, 10.0));
  const Series average = welch_average(mean_over_replications(runs), 10);
  // From one window behind the step on only the noise is left: 1 / sqrt(40 * 21) = 0.035.
  for (std::size_t i = 70; i < average.size(); ++i) EXPECT_LT(std::abs(average[i]), 0.2) << i;
  for (std::size_t i = 10; i < 50; ++i) EXPECT_GT(average[i], 9.8) << i;
}

}  // namespace
}  // namespace lukou::statistics
