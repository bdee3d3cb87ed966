#include "services/lukou/study/statistics/warm_up.hpp"

#include <algorithm>
#include <limits>

#include "common/core/contract.hpp"

namespace lukou::statistics {
namespace {

constexpr std::size_t kBatch = 5;
constexpr std::size_t kRestMin = 5;  ///< means
constexpr std::size_t kMeansMin = 10;

}  // namespace

Series mean_over_replications(std::span<const Series> replications) {
  LUKOU_EXPECT(!replications.empty());
  std::size_t length = replications.front().size();
  for (const Series& series : replications) length = std::min(length, series.size());
  Series mean(length, 0.0);
  for (const Series& series : replications)
    for (std::size_t i = 0; i < length; ++i) mean[i] += series[i] / static_cast<double>(replications.size());
  return mean;
}

Truncation mser5(std::span<const double> series) {
  const std::size_t n = series.size() / kBatch;
  if (n < kMeansMin) return {};
  std::vector<double> means(n, 0.0);
  for (std::size_t i = 0; i < n * kBatch; ++i) means[i / kBatch] += series[i];
  for (double& mean : means) mean /= static_cast<double>(kBatch);
  std::size_t best = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t d = 0; d + kRestMin <= n; ++d) {
    const auto rest = static_cast<double>(n - d);
    double mean = 0.0;
    for (std::size_t i = d; i < n; ++i) mean += means[i];
    mean /= rest;
    double squares = 0.0;
    for (std::size_t i = d; i < n; ++i) squares += (means[i] - mean) * (means[i] - mean);
    const double statistic = squares / (rest * rest);
    if (statistic >= least) continue;
    least = statistic;
    best = d;
  }
  return {best * kBatch, 2 * best <= n};
}

Series welch_average(std::span<const double> series, std::size_t window) {
  Series average;
  for (std::size_t i = 0; i + window < series.size(); ++i) {
    const std::size_t reach = std::min(i, window);
    double sum = 0.0;
    for (std::size_t j = i - reach; j <= i + reach; ++j) sum += series[j];
    average.push_back(sum / static_cast<double>(2 * reach + 1));
  }
  return average;
}

}  // namespace lukou::statistics
