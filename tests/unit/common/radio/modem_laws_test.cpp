#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "common/radio/modem.hpp"

// The modem's draws against the laws that docs/radio.md states. The draws are keyed, so each test has one outcome; the
// limits are those that a true law misses once in a thousand seeds or less.

namespace lukou {
namespace {

constexpr std::uint32_t kFrames = 40'000;

Hop hop(std::uint32_t number, std::uint64_t sender = 1, std::uint64_t receiver = 2) {
  return {.sender = sender, .receiver = receiver, .sequence = number, .sent = Step{number}, .distance_m = 10.0};
}

std::vector<double> latencies_ms(const LatencyModel& law) {
  const Modem modem(3, {.latency = law});
  std::vector<double> drawn;
  for (std::uint32_t n = 0; n < kFrames; ++n) drawn.push_back(modem.receive(hop(n)).first.latency_ms);
  return drawn;
}

double mean(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

double variance(const std::vector<double>& values) {
  const double centre = mean(values);
  double sum = 0.0;
  for (const double value : values) sum += (value - centre) * (value - centre);
  return sum / static_cast<double>(values.size());
}

/// Kolmogorov-Smirnov: the largest distance between the empirical and the law's distribution function.
double distance_to_law(std::vector<double> values, const std::function<double(double)>& distribution) {
  std::ranges::sort(values);
  const auto n = static_cast<double>(values.size());
  double largest = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double expected = distribution(values[i]);
    largest = std::max({largest, expected - static_cast<double>(i) / n, static_cast<double>(i + 1) / n - expected});
  }
  return largest;
}

// P(D > 1.95 / sqrt(n)) = 0.001 for large n (Kolmogorov's law: 2 exp(-2 * 1.95^2) = 0.00099).
const double kDistanceMax = 1.95 / std::sqrt(static_cast<double>(kFrames));

std::vector<bool> losses(const LinkModel& model, std::uint64_t sender = 1, std::uint64_t receiver = 2) {
  const Modem modem(3, model);
  std::vector<bool> lost;
  for (std::uint32_t n = 0; n < kFrames; ++n) lost.push_back(modem.receive(hop(n, sender, receiver)).lost.has_value());
  return lost;
}

double share(const std::vector<bool>& lost) {
  return static_cast<double>(std::count(lost.begin(), lost.end(), true)) / static_cast<double>(lost.size());
}

/// Correlation of a[i] and b[i + shift].
double correlation(const std::vector<bool>& a, const std::vector<bool>& b, std::size_t shift) {
  const double mean_a = share(a);
  const double mean_b = share(b);
  double sum = 0.0;
  const std::size_t n = a.size() - shift;
  for (std::size_t i = 0; i < n; ++i) sum += ((a[i] ? 1.0 : 0.0) - mean_a) * ((b[i + shift] ? 1.0 : 0.0) - mean_b);
  return sum / static_cast<double>(n) / std::sqrt(mean_a * (1.0 - mean_a) * mean_b * (1.0 - mean_b));
}

LinkModel bursty(double rate, double mean_length) {
  LinkModel model;
  model.burst_rate = rate;
  model.burst_mean_length = mean_length;
  return model;
}

TEST(LatencyLaw, ConstantIsTheConstant) {
  for (const double drawn : latencies_ms({.law = LatencyModel::Law::kConstant, .min_ms = 42.0})) ASSERT_EQ(drawn, 42.0);
}

TEST(LatencyLaw, UniformIsUniform) {
  const auto drawn = latencies_ms({.law = LatencyModel::Law::kUniform, .min_ms = 4.0, .max_ms = 100.0});
  // Mean 52; deviation of the mean 96 / sqrt(12 n) = 0.139.
  EXPECT_NEAR(mean(drawn), 52.0, 4 * 0.139);
  EXPECT_LT(distance_to_law(drawn, [](double x) { return (x - 4.0) / 96.0; }), kDistanceMax);
}

TEST(LatencyLaw, GammaIsTheShiftedGammaOfShapeTwo) {
  const auto drawn = latencies_ms({.law = LatencyModel::Law::kGamma, .min_ms = 50.0, .mean_ms = 150.0});
  // Scale (150 - 50) / 2 = 50: mean 50 + 2 * 50, variance 2 * 50^2 = 5000; deviation of the mean sqrt(5000 / n) =
  // 0.354.
  EXPECT_NEAR(mean(drawn), 150.0, 4 * 0.354);
  // The fourth central moment is 3 k (k + 2) scale^4 = 24 scale^4, so the deviation of the variance is
  // scale^2 sqrt((24 - 4) / n) = 55.9.
  EXPECT_NEAR(variance(drawn), 5000.0, 4 * 55.9);
  const auto distribution = [](double x) {
    const double z = (x - 50.0) / 50.0;
    return 1.0 - (1.0 + z) * std::exp(-z);
  };
  EXPECT_LT(distance_to_law(drawn, distribution), kDistanceMax);
}

TEST(LatencyLaw, CutsADrawThatWouldOutliveTheMinute) {
  const Modem modem(3, {.latency = {.law = LatencyModel::Law::kConstant, .min_ms = 90'000.0}});
  EXPECT_EQ(modem.receive(hop(0)).first.latency_ms, kLatencyMax_ms);
}

TEST(LossLaw, LosesItsShareFrameByFrame) {
  LinkModel model;
  model.loss_rate = 0.3;
  const std::vector<bool> lost = losses(model);
  // Deviation of the share sqrt(0.3 * 0.7 / n) = 0.0023; of a correlation of independent values 1 / sqrt(n) = 0.005.
  EXPECT_NEAR(share(lost), 0.3, 4 * 0.0023);
  EXPECT_NEAR(correlation(lost, lost, 1), 0.0, 4 * 0.005);
}

TEST(BurstLaw, LosesItsShareInBurstsOfItsMeanLength) {
  const std::vector<bool> lost = losses(bursty(0.2, 8.0));
  // r = 1/8, p = r * 0.2 / 0.8 = 1/32. The lag-1 correlation is 1 - p - r = 0.84375 =: c, so the share's variance is
  // that of (1 - c) / (1 + c) n independent frames: sqrt(0.16 / 40,000 * 1.84375 / 0.15625) = 0.0069.
  EXPECT_NEAR(share(lost), 0.2, 4 * 0.0069);
  EXPECT_NEAR(correlation(lost, lost, 1), 0.84375, 0.02);
  // About n * 0.8 * p = 1000 bursts, geometric with mean 8 and deviation sqrt(1 - r) / r = 7.48: 7.48 / sqrt(1000) =
  // 0.24.
  double bursts = 0.0;
  for (std::size_t i = 1; i < lost.size(); ++i) bursts += !lost[i - 1] && lost[i] ? 1.0 : 0.0;
  EXPECT_NEAR(static_cast<double>(std::count(lost.begin(), lost.end(), true)) / bursts, 8.0, 4 * 0.24);
}

TEST(BurstLaw, OfTheLengthOfIndependentLossesIsIndependent) {
  // A mean length of 1 / (1 - rate) makes p + r = 1: the next state does not know the last.
  const std::vector<bool> lost = losses(bursty(0.5, 2.0));
  EXPECT_NEAR(share(lost), 0.5, 4 * 0.0025);
  EXPECT_NEAR(correlation(lost, lost, 1), 0.0, 4 * 0.005);
}

TEST(BurstLaw, IsStationaryFromTheFirstStepOn) {
  const Modem modem(3, bursty(0.2, 8.0));
  for (const std::uint32_t step : {0U, 1U, 5U}) {
    int lost = 0;
    for (std::uint64_t receiver = 0; receiver < 10'000; ++receiver) {
      lost += modem.receive(hop(step, 1, receiver)).lost ? 1 : 0;
    }
    EXPECT_NEAR(lost / 10'000.0, 0.2, 4 * 0.004) << step;  // sqrt(0.16 / 10,000)
  }
}

TEST(BurstLaw, GoesOnInStepsThatNobodyAskedAbout) {
  // Every 8th step alone: c^8 = 0.84375^8 = 0.2569 is left of the correlation.
  const Modem modem(3, bursty(0.2, 8.0));
  std::vector<bool> lost;
  for (std::uint32_t n = 0; n < kFrames; ++n) lost.push_back(modem.receive(hop(8 * n)).lost.has_value());
  EXPECT_NEAR(share(lost), 0.2, 4 * 0.0026);  // sqrt(0.16 / 40,000 * 1.2569 / 0.7431)
  EXPECT_NEAR(correlation(lost, lost, 1), 0.2569, 4 * 0.008);
}

TEST(Links, AreIndependentOfEachOther) {
  for (const LinkModel& model : {bursty(0.2, 8.0), LinkModel{.loss_rate = 0.3}}) {
    const std::vector<bool> lost = losses(model, 1, 2);
    // One sender and two receivers, two senders and one receiver, and the way back. The deviation of the correlation of
    // two independent chains with lag-1 correlation c is sqrt((1 + c^2) / (1 - c^2) / n): 0.0122 for c = 0.84375.
    EXPECT_NEAR(correlation(lost, losses(model, 1, 3), 0), 0.0, 4 * 0.0122);
    EXPECT_NEAR(correlation(lost, losses(model, 3, 2), 0), 0.0, 4 * 0.0122);
    EXPECT_NEAR(correlation(lost, losses(model, 2, 1), 0), 0.0, 4 * 0.0122);
  }
}

}  // namespace
}  // namespace lukou
