#include "common/core/math.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace lukou {
namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();  // 2.2e-16

double relative_error(double value, double expected) { return std::abs(value - expected) / std::abs(expected); }

TEST(MathLog, IsZeroAtOne) { EXPECT_EQ(math::log(1.0), 0.0); }

TEST(MathLog, IsTheExponentTimesLogTwoAtPowersOfTwo) {
  constexpr double kLn2 = 0.69314718055994530942;
  for (int n = -1074; n <= 1023; ++n) {
    if (n == 0) continue;
    EXPECT_LT(relative_error(math::log(std::ldexp(1.0, n)), n * kLn2), 2 * kEpsilon) << n;
  }
}

TEST(MathLog, AgreesWithTheCLibraryWithinTheStatedError) {
  // 200 arguments in every binade, subnormal ones included; 4e-16 is the header's word.
  double worst = 0.0;
  for (int exponent = -1074; exponent <= 1023; ++exponent) {
    for (double mantissa = 1.0; mantissa < 2.0; mantissa += 0.005) {
      const double x = std::ldexp(mantissa, exponent);
      const double expected = std::log(x);
      if (std::abs(expected) > 0.5) worst = std::max(worst, relative_error(math::log(x), expected));
    }
  }
  EXPECT_LT(worst, 4e-16);
  EXPECT_LT(relative_error(math::log(std::numeric_limits<double>::max()), 709.782712893384), 4e-16);
}

TEST(MathLog, KeepsItsPrecisionAroundOne) {
  // There the result itself tends to 0: a series in (x - 1) cancels nothing, so the error stays relative to it.
  for (double x = 0.55; x < 1.9; x += 0.00037) {
    EXPECT_LT(std::abs(math::log(x) - std::log(x)), 4e-16 * std::max(1.0, std::abs(std::log(x)))) << x;
  }
  // log(1 + e) = e - e^2/2 + ...: at e = 2^-30 the third term is below the last bit.
  const double e = std::ldexp(1.0, -30);
  EXPECT_LT(relative_error(math::log(1.0 + e), e - e * e / 2), 2 * kEpsilon);
}

TEST(MathLogDeathTest, RefusesWhatHasNoLogarithm) {
  EXPECT_DEATH(math::log(0.0), "does not hold");
  EXPECT_DEATH(math::log(-1.0), "does not hold");
  EXPECT_DEATH(math::log(std::numeric_limits<double>::infinity()), "does not hold");
  EXPECT_DEATH(math::log(std::numeric_limits<double>::quiet_NaN()), "does not hold");
}

TEST(MathExp, IsOneAtZero) { EXPECT_EQ(math::exp(0.0), 1.0); }

TEST(MathExp, AgreesWithTheCLibraryWithinTwoUnitsOfTheLastPlace) {
  for (double x = -700.0; x <= 700.0; x += 0.0137) {
    ASSERT_LT(relative_error(math::exp(x), std::exp(x)), 2 * kEpsilon) << x;
  }
}

TEST(MathExp, UndoesTheLogarithm) {
  // d(exp(y)) / exp(y) = dy: an error of 4e-16 |y| in y = log x is one of the same size in x.
  for (double x = 1e-300; x < 1e300; x *= 1.37) {
    const double y = math::log(x);
    EXPECT_LT(relative_error(math::exp(y), x), 4e-16 * std::abs(y) + 2 * kEpsilon) << x;
  }
}

TEST(MathExp, SaturatesOutsideItsRange) {
  EXPECT_EQ(math::exp(-700.0001), 0.0);
  EXPECT_EQ(math::exp(-1e300), 0.0);
  EXPECT_EQ(math::exp(700.0001), std::numeric_limits<double>::max());
  EXPECT_EQ(math::exp(1e300), std::numeric_limits<double>::max());
  EXPECT_GT(math::exp(-700.0), 0.0);
  EXPECT_LT(math::exp(700.0), std::numeric_limits<double>::max());
}

TEST(MathSinCos, IsExactAtZeroAndCloseAtTheQuarters) {
  EXPECT_EQ(math::sin(0.0), 0.0);
  EXPECT_EQ(math::cos(0.0), 1.0);
  EXPECT_EQ(math::sin(math::kPi / 2), 1.0);
  EXPECT_EQ(math::cos(math::kPi), -1.0);
  // sin(pi) of the double next to pi is its distance to pi, 1.2246467991473532e-16.
  EXPECT_LT(relative_error(math::sin(math::kPi), 1.2246467991473532e-16), 1e-9);
  EXPECT_LT(relative_error(math::cos(math::kPi / 2), 6.123233995736766e-17), 1e-9);
  EXPECT_LT(relative_error(math::sin(math::kPi / 6), 0.5), 2 * kEpsilon);
  EXPECT_LT(relative_error(math::cos(math::kPi / 3), 0.5), 2 * kEpsilon);
}

TEST(MathSinCos, AgreesWithTheCLibraryOverTheWholeRange) {
  for (double angle_rad = -1e4; angle_rad <= 1e4; angle_rad += 0.0713) {
    ASSERT_NEAR(math::sin(angle_rad), std::sin(angle_rad), 3e-16) << angle_rad;
    ASSERT_NEAR(math::cos(angle_rad), std::cos(angle_rad), 3e-16) << angle_rad;
  }
}

TEST(MathSinCos, KeepsItsSymmetriesAndThePythagoreanIdentity) {
  for (double angle_rad = 0.0; angle_rad <= 50.0; angle_rad += 0.0191) {
    const double s = math::sin(angle_rad);
    const double c = math::cos(angle_rad);
    ASSERT_NEAR(s * s + c * c, 1.0, 3 * kEpsilon) << angle_rad;
    ASSERT_EQ(math::sin(-angle_rad), -s) << angle_rad;
    ASSERT_EQ(math::cos(-angle_rad), c) << angle_rad;
  }
}

TEST(MathSinCosDeathTest, RefusesAnglesThatItCannotReduce) {
  EXPECT_DEATH(math::sin(1.1e4), "does not hold");
  EXPECT_DEATH(math::cos(std::numeric_limits<double>::quiet_NaN()), "does not hold");
}

/// The distribution function, from the C library's error function: independent of the code under test.
double normal_probability(double x) { return 0.5 * std::erfc(-x / std::sqrt(2.0)); }

TEST(NormalQuantile, IsTheInverseOfTheDistributionFunction) {
  // The slope of the distribution function at x turns an error of x into one of p.
  const auto slope = [](double x) { return std::exp(-x * x / 2) / std::sqrt(2 * math::kPi); };
  for (double x = -8.2; x <= 0.0; x += 0.0117) {
    const double p = normal_probability(x);
    // p itself is known to about 4e-16 p (erfc); quantile to 1e-15 relative.
    EXPECT_NEAR(math::normal_quantile(p), x, 1e-15 * std::max(1.0, std::abs(x)) + 1e-15 * p / slope(x)) << x;
  }
}

TEST(NormalQuantile, IsOddAboutTheMedian) {
  EXPECT_EQ(math::normal_quantile(0.5), 0.0);
  for (double p = 0x1.0p-12; p < 0.5; p += 0x1.0p-12) {  // 1 - p is exact
    ASSERT_EQ(math::normal_quantile(1.0 - p), -math::normal_quantile(p)) << p;
  }
}

TEST(NormalQuantile, KnowsThePercentilesOfTheTables) {
  EXPECT_NEAR(math::normal_quantile(0.975), 1.959963984540054, 1e-14);
  EXPECT_NEAR(math::normal_quantile(0.001), -3.090232306167814, 1e-14);
  EXPECT_NEAR(math::normal_quantile(1e-12), -7.034483825301132, 1e-12);
}

TEST(NormalQuantile, RisesAcrossTheSeamsOfItsThreeFormulas) {
  for (const double seam : {0.075, 0.925, 1.3887943864964021e-11}) {  // |p - 0.5| = 0.425; sqrt(-log p) = 5
    const double below = math::normal_quantile(seam * (1 - 1e-9));
    const double above = math::normal_quantile(seam * (1 + 1e-9));
    EXPECT_LT(below, above);
    EXPECT_NEAR(below, above, 1e-7);
  }
}

TEST(NormalQuantileDeathTest, RefusesTheEndsOfTheInterval) {
  EXPECT_DEATH(math::normal_quantile(0.0), "does not hold");
  EXPECT_DEATH(math::normal_quantile(1.0), "does not hold");
}

TEST(Math, NormalDistributionIsThatOfTheComplementaryErrorFunction) {
  for (double x = -38.0; x <= 38.0; x += 0.01) {
    EXPECT_NEAR(math::normal_cdf(x), 0.5 * std::erfc(-x / std::sqrt(2.0)), 1e-14) << x;
  }
  EXPECT_NEAR(math::normal_quantile(math::normal_cdf(1.25)), 1.25, 1e-12);
  EXPECT_EQ(math::normal_cdf(-50.0), 0.0);
  EXPECT_EQ(math::normal_cdf(50.0), 1.0);
}

}  // namespace
}  // namespace lukou
