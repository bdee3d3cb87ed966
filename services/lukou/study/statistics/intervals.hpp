#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

// What replications say. The unit of analysis is the replication: one number a run, never one a vehicle, since the cars
// of a run depend on each other and runs with different seeds do not.

namespace lukou::statistics {

/// The two-sided quantile of Student's t: |T| stays below it with probability `confidence`. Requires
/// degrees >= 1 and confidence within (0, 1).
double student_quantile(std::size_t degrees, double confidence);

/// Mean of replications with its interval.
struct Estimate {
  std::size_t n = 0;
  double mean = 0.0;
  double deviation = 0.0;            ///< standard deviation of the replications; 0 if there is one
  std::optional<double> half_width;  ///< of the interval; one replication has none

  [[nodiscard]] double low() const { return mean - half_width.value_or(0.0); }
  [[nodiscard]] double high() const { return mean + half_width.value_or(0.0); }
};
/// Requires at least one value.
Estimate estimate(std::span<const double> values, double confidence);

/// How an arm does against a baseline on the same seeds. Differences are arm less baseline.
struct PairedComparison {
  Estimate difference;
  double p = 1.0;                     ///< of Student's paired test for no difference
  std::optional<double> correlation;  ///< of the pairs; none if one side does not vary
  /// How many times larger the variance of the mean difference were without common random numbers, with as many runs;
  /// none if the differences do not vary.
  std::optional<double> variance_gain;
  /// 1 - mean of the arm / mean of the baseline, by the ratio estimator with its linearised (delta method) interval;
  /// none if the baseline's mean is 0.
  std::optional<Estimate> reduction;
};
/// Pairs are of the same index. Requires equally many on both sides, at least one. Values that differ by less than 1e-9
/// of their size are the same sum taken in another order: they count as equal.
PairedComparison compare(std::span<const double> arm, std::span<const double> baseline, double confidence);

/// How an arm does against a baseline on other seeds: Welch's test. Requires at least two values on both sides.
struct UnpairedComparison {
  Estimate difference;
  double p = 1.0;
};
UnpairedComparison compare_unpaired(std::span<const double> arm, std::span<const double> baseline, double confidence);

/// p-values corrected for that several hypotheses are tested at once, by Holm's step-down method: each may be compared
/// with 1 - confidence as it stands. Holm (1979), Scandinavian Journal of Statistics 6, 65.
std::vector<double> holm(std::span<const double> p);

/// Replications that a relative half width would take, going by those at hand: n >= (t s / (share |mean|))^2. None if
/// there are fewer than two or their mean is 0.
std::optional<std::size_t> replications_needed(const Estimate& estimate, double share, double confidence);

}  // namespace lukou::statistics
