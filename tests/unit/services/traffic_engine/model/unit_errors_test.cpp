#include "services/traffic_engine/model/unit_errors.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <vector>

// The draws are keyed, so each test has one outcome; the limits are those that a true law misses once in a thousand
// seeds or less (3.3 standard deviations).

namespace lukou::traffic {
namespace {

constexpr std::uint32_t kCars = 4000;
constexpr UnitErrorParameters kWandering = {
    .bias_m = 0.0, .noise_m = 2.0, .correlation_s = 5.0, .clock_offset_ms = 0.0};

/// The errors of many cars in one step.
std::vector<UnitError> of_all(UnitErrors& errors, Step step) {
  std::vector<UnitError> all;
  for (std::uint32_t vehicle = 0; vehicle < kCars; ++vehicle) all.push_back(errors.of(vehicle, step));
  return all;
}

using Part = std::function<double(const UnitError&)>;
double east(const UnitError& error) { return error.east_m; }
double north(const UnitError& error) { return error.north_m; }
double clock(const UnitError& error) { return error.clock_ms; }

/// Mean product of two parts; every part has mean zero.
double covariance(const std::vector<UnitError>& a, const Part& of_a, const std::vector<UnitError>& b,
                  const Part& of_b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += of_a(a[i]) * of_b(b[i]);
  return sum / static_cast<double>(a.size());
}

double variance(const std::vector<UnitError>& all, const Part& part) { return covariance(all, part, all, part); }

TEST(UnitErrors, AreNoneByDefault) {
  UnitErrors errors(1, {});
  EXPECT_FALSE(errors.any());
  EXPECT_FALSE(errors.accuracy_m());
  const UnitError error = errors.of(7, 100);
  EXPECT_EQ(error.east_m, 0.0);
  EXPECT_EQ(error.north_m, 0.0);
  EXPECT_EQ(error.clock_ms, 0.0);
}

TEST(UnitErrors, WanderWithTheSameVarianceFromTheFirstStepOn) {
  UnitErrors errors(1, kWandering);
  for (Step step = 0; step <= 100; ++step) {
    const std::vector<UnitError> all = of_all(errors, step);
    if (step != 0 && step != 1 && step != 100) continue;
    // The sample variance of n normal values has a standard deviation of sqrt(2 / n) of the variance: 0.0224.
    EXPECT_NEAR(variance(all, east) / 4.0, 1.0, 3.3 * 0.0224) << step;
    EXPECT_NEAR(variance(all, north) / 4.0, 1.0, 3.3 * 0.0224) << step;
    EXPECT_NEAR(covariance(all, east, all, north) / 4.0, 0.0, 3.3 / std::sqrt(kCars)) << step;
  }
}

TEST(UnitErrors, AreCorrelatedByOneOverEAfterTheCorrelationTime) {
  UnitErrors errors(2, kWandering);
  std::vector<UnitError> first;
  for (Step step = 10; step <= 160; ++step) {
    const std::vector<UnitError> all = of_all(errors, step);
    if (step == 10) first = all;
    const double elapsed_s = 0.1 * static_cast<double>(step - 10);
    if (step != 11 && step != 60 && step != 160) continue;
    // exp(-t / 5 s): 0.980 after a step, 0.368 after 5 s, 0.050 after 15 s; the limit is that of no correlation.
    EXPECT_NEAR(covariance(first, east, all, east) / 4.0, std::exp(-elapsed_s / 5.0),
                3.3 * std::sqrt((1.0 + std::exp(-2.0 * elapsed_s / 5.0)) / kCars))
        << elapsed_s;
  }
}

TEST(UnitErrors, HaveABiasThatIsConstantPerCar) {
  UnitErrors errors(3, {.bias_m = 1.5, .clock_offset_ms = 40.0});
  const std::vector<UnitError> first = of_all(errors, 0);
  const std::vector<UnitError> later = of_all(errors, 5000);
  for (std::uint32_t vehicle = 0; vehicle < kCars; ++vehicle) {
    EXPECT_EQ(first[vehicle].east_m, later[vehicle].east_m);
    EXPECT_EQ(first[vehicle].north_m, later[vehicle].north_m);
    EXPECT_EQ(first[vehicle].clock_ms, later[vehicle].clock_ms);
  }
  EXPECT_NEAR(variance(first, east) / (1.5 * 1.5), 1.0, 3.3 * 0.0224);
  EXPECT_NEAR(variance(first, north) / (1.5 * 1.5), 1.0, 3.3 * 0.0224);
  EXPECT_NEAR(variance(first, clock) / (40.0 * 40.0), 1.0, 3.3 * 0.0224);
  EXPECT_NEAR(covariance(first, east, first, clock) / (1.5 * 40.0), 0.0, 3.3 / std::sqrt(kCars));
}

TEST(UnitErrors, OfTwoCarsShareNoDraw) {
  const UnitErrorParameters all = {.bias_m = 1.0, .noise_m = 1.0, .correlation_s = 3.0, .clock_offset_ms = 5.0};
  UnitErrors alone(4, all);
  UnitErrors together(4, all);
  for (Step step = 20; step < 60; ++step) {
    together.of(6, step);
    const UnitError other = together.of(5, step);
    const UnitError own = alone.of(5, step);
    EXPECT_EQ(own.east_m, other.east_m);
    EXPECT_EQ(own.north_m, other.north_m);
    EXPECT_EQ(own.clock_ms, other.clock_ms);
    EXPECT_NE(own.east_m, together.of(6, step).east_m);
  }
}

TEST(UnitErrors, GoOnFromWhereTheyAreWhenTheNoiseChanges) {
  UnitErrors steady(5, kWandering);
  UnitErrors changed(5, kWandering);
  for (Step step = 0; step < 10; ++step) steady.of(1, step), changed.of(1, step);
  UnitErrorParameters twice = kWandering;
  twice.noise_m = 4.0;
  changed.use(twice);
  EXPECT_DOUBLE_EQ(changed.of(1, 10).east_m, 2.0 * steady.of(1, 10).east_m);
  changed.use({});
  EXPECT_EQ(changed.of(1, 11).east_m, 0.0);
}

TEST(UnitErrors, ForgetCarsThatHaveLeft) {
  // A car that comes back after it was forgotten begins anew, with the draw of its step alone.
  UnitErrors errors(6, kWandering);
  for (Step step = 0; step < 10; ++step) errors.of(1, step), errors.forget_unseen(step);
  errors.forget_unseen(10);
  EXPECT_EQ(errors.of(1, 11).east_m, UnitErrors(6, kWandering).of(1, 11).east_m);
}

TEST(UnitErrors, TellTheUnitHowAccurateItIs) {
  // Independent errors add up in squares: sqrt(3^2 + 4^2) = 5.
  EXPECT_DOUBLE_EQ(UnitErrors(1, {.bias_m = 3.0, .noise_m = 4.0}).accuracy_m().value(), 5.0);
  EXPECT_FALSE(UnitErrors(1, {.clock_offset_ms = 10.0}).accuracy_m());
}

}  // namespace
}  // namespace lukou::traffic
