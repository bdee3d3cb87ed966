#include "services/lukou/study/statistics/intervals.hpp"

#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <limits>
#include <numeric>

#include "common/core/contract.hpp"

namespace lukou::statistics {
namespace {

using boost::math::students_t;

constexpr double kRounding = 1e-9;

double mean_of(std::span<const double> values) {
  double sum = 0.0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

/// Unbiased variance; 0 for a single value.
double variance_of(std::span<const double> values, double mean) {
  if (values.size() < 2) return 0.0;
  double squares = 0.0;
  for (const double value : values) squares += (value - mean) * (value - mean);
  return squares / static_cast<double>(values.size() - 1);
}

/// Probability that |T| is at least as large, under no effect.
double two_sided_p(double mean, double standard_error, double degrees) {
  if (standard_error <= 0.0) return mean == 0.0 ? 1.0 : 0.0;
  return 2.0 * cdf(complement(students_t(degrees), std::abs(mean) / standard_error));
}

/// 1 - ratio of the means. The ratio r = mean(arm) / mean(base) varies as the mean of e_i = (arm_i - r base_i) /
/// mean(base) does, to first order.
std::optional<Estimate> reduction_of(std::span<const double> arm, std::span<const double> base, double confidence) {
  const double base_mean = mean_of(base);
  if (base_mean == 0.0) return std::nullopt;
  const double ratio = mean_of(arm) / base_mean;
  std::vector<double> linear;
  for (std::size_t i = 0; i < arm.size(); ++i) linear.push_back(1.0 - ratio - (arm[i] - ratio * base[i]) / base_mean);
  Estimate reduction = estimate(linear, confidence);
  reduction.mean = 1.0 - ratio;
  return reduction;
}

}  // namespace

double student_quantile(std::size_t degrees, double confidence) {
  LUKOU_EXPECT(degrees >= 1 && confidence > 0.0 && confidence < 1.0);
  return quantile(complement(students_t(static_cast<double>(degrees)), (1.0 - confidence) / 2.0));
}

Estimate estimate(std::span<const double> values, double confidence) {
  LUKOU_EXPECT(!values.empty());
  Estimate result{.n = values.size(), .mean = mean_of(values), .deviation = 0.0, .half_width = std::nullopt};
  if (values.size() < 2) return result;
  result.deviation = std::sqrt(variance_of(values, result.mean));
  result.half_width = student_quantile(values.size() - 1, confidence) * result.deviation /
                      std::sqrt(static_cast<double>(values.size()));
  return result;
}

PairedComparison compare(std::span<const double> as_measured, std::span<const double> baseline, double confidence) {
  LUKOU_EXPECT(!as_measured.empty() && as_measured.size() == baseline.size());
  std::vector<double> arm(as_measured.begin(), as_measured.end());
  for (std::size_t i = 0; i < arm.size(); ++i)
    if (std::abs(arm[i] - baseline[i]) <= kRounding * std::abs(baseline[i])) arm[i] = baseline[i];
  std::vector<double> differences;
  for (std::size_t i = 0; i < arm.size(); ++i) differences.push_back(arm[i] - baseline[i]);
  PairedComparison result;
  result.difference = estimate(differences, confidence);
  result.reduction = reduction_of(arm, baseline, confidence);
  const auto n = static_cast<double>(arm.size());
  if (arm.size() < 2) return result;
  result.p = two_sided_p(result.difference.mean, result.difference.deviation / std::sqrt(n), n - 1.0);
  const double arm_variance = variance_of(arm, mean_of(arm));
  const double base_variance = variance_of(baseline, mean_of(baseline));
  const double paired_variance = result.difference.deviation * result.difference.deviation;
  if (arm_variance > 0.0 && base_variance > 0.0) {
    // Var(a - b) = Var(a) + Var(b) - 2 Cov(a, b)
    const double covariance = (arm_variance + base_variance - paired_variance) / 2.0;
    result.correlation = std::clamp(covariance / std::sqrt(arm_variance * base_variance), -1.0, 1.0);
  }
  if (paired_variance > 0.0) result.variance_gain = (arm_variance + base_variance) / paired_variance;
  return result;
}

UnpairedComparison compare_unpaired(std::span<const double> arm, std::span<const double> baseline, double confidence) {
  LUKOU_EXPECT(arm.size() >= 2 && baseline.size() >= 2);
  const auto error_of = [](std::span<const double> values) {
    return variance_of(values, mean_of(values)) / static_cast<double>(values.size());
  };
  const double a = error_of(arm);
  const double b = error_of(baseline);
  UnpairedComparison result;
  result.difference.n = std::min(arm.size(), baseline.size());
  result.difference.mean = mean_of(arm) - mean_of(baseline);
  result.difference.deviation = std::sqrt(a + b) * std::sqrt(static_cast<double>(result.difference.n));
  if (a + b <= 0.0) {
    result.difference.half_width = 0.0;
    result.p = two_sided_p(result.difference.mean, 0.0, 1.0);
    return result;
  }
  // Welch and Satterthwaite's degrees of freedom.
  const double degrees =
      (a + b) * (a + b) /
      (a * a / static_cast<double>(arm.size() - 1) + b * b / static_cast<double>(baseline.size() - 1));
  result.difference.half_width = quantile(complement(students_t(degrees), (1.0 - confidence) / 2.0)) * std::sqrt(a + b);
  result.p = two_sided_p(result.difference.mean, std::sqrt(a + b), degrees);
  return result;
}

std::vector<double> holm(std::span<const double> p) {
  std::vector<std::size_t> order(p.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return p[i]; });
  std::vector<double> corrected(p.size());
  double largest = 0.0;
  for (std::size_t rank = 0; rank < order.size(); ++rank) {
    const double times = static_cast<double>(p.size() - rank);
    largest = std::max(largest, std::min(1.0, times * p[order[rank]]));
    corrected[order[rank]] = largest;
  }
  return corrected;
}

std::optional<std::size_t> replications_needed(const Estimate& estimate, double share, double confidence) {
  LUKOU_EXPECT(share > 0.0);
  if (estimate.n < 2 || estimate.mean == 0.0) return std::nullopt;
  const double t = student_quantile(estimate.n - 1, confidence);
  const double root = t * estimate.deviation / (share * std::abs(estimate.mean));
  return static_cast<std::size_t>(std::min(1e9, std::max(2.0, std::ceil(root * root))));
}

}  // namespace lukou::statistics
