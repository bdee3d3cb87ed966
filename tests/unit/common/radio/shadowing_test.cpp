#include "common/radio/shadowing.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace lukou {
namespace {

constexpr int kPairs = 20'000;

struct Moments {
  double mean = 0.0;
  double variance = 0.0;
  double correlation = 0.0;
};

/// Of two values, over many pairs of stations. Their means are 0.
Moments moments(const std::function<double(std::uint64_t)>& first, const std::function<double(std::uint64_t)>& second) {
  Moments of;
  double product = 0.0;
  for (std::uint64_t pair = 1; pair <= kPairs; ++pair) {
    const double a = first(pair * 0x1234567);
    of.mean += a / kPairs;
    of.variance += a * a / kPairs;
    product += a * second(pair * 0x1234567) / kPairs;
  }
  of.correlation = product;  // of two standard normals
  return of;
}

TEST(Shadowing, IsStandardNormalAndLosesItsMemoryOverItsDistance) {
  Shadowing shadowing(3);
  const auto at = [&](double x_m, double decorrelation_m = 10.0) {
    return [&shadowing, x_m, decorrelation_m](std::uint64_t pair) {
      return shadowing.at(pair, {x_m, -2.0}, decorrelation_m);
    };
  };
  // Deviations: of the mean 1 / sqrt(n) = 0.0071, of the variance sqrt(2 / n) = 0.01, of a product of two sqrt((1 +
  // c^2) / n) <= 0.01.
  const Moments same = moments(at(100.0), at(104.9));  // one cell of 5 m
  EXPECT_NEAR(same.mean, 0.0, 4 * 0.0071);
  EXPECT_NEAR(same.variance, 1.0, 4 * 0.01);
  EXPECT_EQ(same.correlation, same.variance);
  EXPECT_NEAR(moments(at(100.0), at(110.0)).correlation, std::exp(-1.0), 4 * 0.01);
  EXPECT_NEAR(moments(at(-300.0), at(-320.0)).correlation, std::exp(-2.0), 4 * 0.01);
  EXPECT_NEAR(moments(at(100.0), at(200.0)).correlation, 0.0, 4 * 0.0071);
  EXPECT_NEAR(moments(at(100.1, 13.0), at(113.1, 13.0)).correlation, std::exp(-1.0), 4 * 0.01);
  // The other street is another world.
  const auto other_street = [&](std::uint64_t pair) { return shadowing.at(pair, {-2.0, 100.0}, 10.0); };
  EXPECT_NEAR(moments(at(100.0), other_street).correlation, 0.0, 4 * 0.0071);
}

TEST(Shadowing, BetweenCarsChangesWithTheWayOfEither) {
  Shadowing shadowing(3);
  const auto at = [&](double a_m, double b_m) {
    return [&shadowing, a_m, b_m](std::uint64_t pair) { return shadowing.between(pair, {a_m, 2.0}, {b_m, 2.0}, 10.0); };
  };
  EXPECT_NEAR(moments(at(50.0, 100.0), at(60.0, 110.0)).variance, 1.0, 4 * 0.01);
  EXPECT_NEAR(moments(at(50.0, 100.0), at(60.0, 110.0)).correlation, std::exp(-1.0), 4 * 0.01);
  // One end stands: half of the sum stays.
  EXPECT_NEAR(moments(at(50.0, 100.0), at(60.0, 100.0)).correlation, (1.0 + std::exp(-1.0)) / 2.0, 4 * 0.01);
}

TEST(Shadowing, DoesNotDependOnWhatWasAskedBefore) {
  Shadowing forwards(9);
  Shadowing backwards(9);
  std::vector<double> values;
  for (int x = -200; x < 200; ++x)
    for (std::uint64_t pair = 1; pair < 40; ++pair) values.push_back(forwards.at(pair * 4096, {x * 1.0, 2.0}, 10.0));
  for (int x = 199; x >= -200; --x) {
    for (std::uint64_t pair = 39; pair >= 1; --pair) {
      ASSERT_EQ(backwards.at(pair * 4096, {x * 1.0, 2.0}, 10.0), values.back());
      values.pop_back();
    }
  }
}

}  // namespace
}  // namespace lukou
