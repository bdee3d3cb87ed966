// Whether the intervals hold what they say, shown on processes whose truth is known.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "common/core/keyed_random.hpp"
#include "services/lukou/study/statistics/intervals.hpp"
#include "services/lukou/study/statistics/warm_up.hpp"

namespace lukou::statistics {
namespace {

constexpr int kStudies = 4000;
constexpr double kConfidence = 0.95;

double normal(std::uint64_t study, std::uint64_t run, std::uint64_t index) {
  return standard_normal(
      {.run_seed = study, .purpose = Purpose::kTest, .entity = static_cast<std::uint32_t>(run), .index = index});
}

/// The observations of one run: they hang together as those of a queue do, x' = 0.8 x + noise, and begin at 40, far
/// from their long-run mean of 10.
Series autocorrelated(std::uint64_t study, std::uint64_t run, std::size_t length) {
  Series series;
  double x = 30.0;
  for (std::size_t i = 0; i < length; ++i) {
    series.push_back(10.0 + x);
    x = 0.8 * x + normal(study, run, i);
  }
  return series;
}

double mean_from(const Series& series, std::size_t first) {
  double sum = 0.0;
  for (std::size_t i = first; i < series.size(); ++i) sum += series[i];
  return sum / static_cast<double>(series.size() - first);
}

/// Share of studies whose interval holds the truth.
template <class Covers>
double coverage(const Covers& covers) {
  int held = 0;
  for (int study = 0; study < kStudies; ++study) held += covers(static_cast<std::uint64_t>(study)) ? 1 : 0;
  return static_cast<double>(held) / kStudies;
}

bool holds(const Estimate& estimate, double truth) { return estimate.low() <= truth && truth <= estimate.high(); }

void expect_within_93_to_97(const char* what, double share) {
  std::printf("%-72s %.4f\n", what, share);
  EXPECT_GE(share, 0.93) << what;
  EXPECT_LE(share, 0.97) << what;
}

TEST(Coverage, OfAMeanOfReplicationsIsThatOfTheConfidence) {
  for (const std::uint64_t runs : {3U, 5U, 10U}) {
    const double share = coverage([&](std::uint64_t study) {
      std::vector<double> means;
      for (std::uint64_t run = 0; run < runs; ++run) means.push_back(mean_from(autocorrelated(study, run, 120), 40));
      return holds(estimate(means, kConfidence), 10.0);
    });
    expect_within_93_to_97(("autocorrelated runs, warm-up left out, n = " + std::to_string(runs)).c_str(), share);
  }
}

TEST(Coverage, IsLostIfTheWarmUpIsLeftIn) {
  // That the test above can fail: the same runs with their beginning.
  const double share = coverage([](std::uint64_t study) {
    std::vector<double> means;
    for (std::uint64_t run = 0; run < 10; ++run) means.push_back(mean_from(autocorrelated(study, run, 120), 0));
    return holds(estimate(means, kConfidence), 10.0);
  });
  std::printf("%-72s %.4f\n", "the same, warm-up left in, n = 10", share);
  EXPECT_LT(share, 0.5);
}

TEST(Coverage, IsLostIfTheUnitIsTheObservationInPlaceOfTheRun) {
  const double share = coverage([](std::uint64_t study) {
    Series series = autocorrelated(study, 0, 120);
    series.erase(series.begin(), series.begin() + 40);
    return holds(estimate(series, kConfidence), 10.0);
  });
  std::printf("%-72s %.4f\n", "one run, its observations taken for replications", share);
  EXPECT_LT(share, 0.7);
}

/// A pair of runs on the same seed: what the seed does to both, and what is their own. The arm is 2 lower and 20 %.
struct Pair {
  double arm;
  double baseline;
};
Pair pair(std::uint64_t study, std::uint64_t run) {
  const double shared = normal(study, run, 0);
  return {.arm = 8.0 + 0.8 * shared + 0.2 * normal(study, run, 1),
          .baseline = 10.0 + shared + 0.2 * normal(study, run, 2)};
}

TEST(Coverage, OfAPairedDifferenceAndOfAReductionIsThatOfTheConfidence) {
  for (const std::uint64_t runs : {5U, 10U}) {
    int reduction_held = 0;
    const double share = coverage([&](std::uint64_t study) {
      std::vector<double> arm;
      std::vector<double> baseline;
      for (std::uint64_t run = 0; run < runs; ++run) {
        arm.push_back(pair(study, run).arm);
        baseline.push_back(pair(study, run).baseline);
      }
      const PairedComparison found = compare(arm, baseline, kConfidence);
      reduction_held += holds(*found.reduction, 0.2) ? 1 : 0;
      return holds(found.difference, -2.0);
    });
    const std::string n = ", n = " + std::to_string(runs);
    expect_within_93_to_97(("paired difference" + n).c_str(), share);
    expect_within_93_to_97(("reduction, a ratio of means" + n).c_str(), static_cast<double>(reduction_held) / kStudies);
  }
}

TEST(Coverage, OfHolmKeepsTheChanceOfAnyFalseFindingAtFivePercent) {
  constexpr std::uint64_t kArms = 5;
  int single = 0;
  int family = 0;
  for (std::uint64_t study = 0; study < kStudies; ++study) {
    std::vector<double> p;
    for (std::uint64_t arm = 0; arm < kArms; ++arm) {
      std::vector<double> values;
      std::vector<double> baseline;
      for (std::uint64_t run = 0; run < 5; ++run) {
        values.push_back(normal(study, run, 1 + arm));
        baseline.push_back(normal(study, run, 0));
      }
      p.push_back(compare(values, baseline, kConfidence).p);
    }
    const auto corrected = holm(p);
    single += *std::min_element(p.begin(), p.end()) < 0.05 ? 1 : 0;
    family += *std::min_element(corrected.begin(), corrected.end()) < 0.05 ? 1 : 0;
  }
  std::printf("%-72s %.4f\n", "some false finding among five algorithms, uncorrected",
              static_cast<double>(single) / kStudies);
  std::printf("%-72s %.4f\n", "some false finding among five algorithms, Holm", static_cast<double>(family) / kStudies);
  EXPECT_GT(single, family);
  // Of 4000 studies the share varies by 0.0034: three times that above 0.05.
  EXPECT_LE(static_cast<double>(family) / kStudies, 0.0603);
}

}  // namespace
}  // namespace lukou::statistics
