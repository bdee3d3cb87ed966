#include "common/core/math.hpp"

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include "common/core/contract.hpp"

namespace lukou::math {
namespace {

constexpr double kLn2High = 6.93147180369123816490e-01;
constexpr double kLn2Low = 1.90821492927058770002e-10;

double polynomial(const double* coefficients, int degree, double x) {
  double sum = coefficients[degree];
  for (int i = degree - 1; i >= 0; --i) sum = sum * x + coefficients[i];
  return sum;
}

/// Taylor series of the sine for |x| <= pi/4; the first omitted term is below 1e-19.
double sin_reduced(double x) {
  static constexpr double kInverseFactorials[] = {
      1.0, -1.0 / 6, 1.0 / 120, -1.0 / 5040, 1.0 / 362880, -1.0 / 39916800, 1.0 / 6227020800.0, -1.0 / 1307674368000.0};
  return x * polynomial(kInverseFactorials, 7, x * x);
}

double cos_reduced(double x) {
  static constexpr double kInverseFactorials[] = {1.0,
                                                  -1.0 / 2,
                                                  1.0 / 24,
                                                  -1.0 / 720,
                                                  1.0 / 40320,
                                                  -1.0 / 3628800,
                                                  1.0 / 479001600.0,
                                                  -1.0 / 87178291200.0,
                                                  1.0 / 20922789888000.0};
  return polynomial(kInverseFactorials, 8, x * x);
}

struct Reduced {
  double remainder;  ///< within [-pi/4, pi/4]
  int quadrant;      ///< 0..3
};

Reduced reduce(double angle_rad) {
  LUKOU_EXPECT(angle_rad >= -1e4 && angle_rad <= 1e4);
  // pi/2 in three parts whose products with a small integer are exact (Cody and Waite).
  constexpr double kHalfPiHigh = 1.57079632673412561417e+00;
  constexpr double kHalfPiMiddle = 6.07710050630396597660e-11;
  constexpr double kHalfPiLow = 2.02226624879595063154e-21;
  const double turns = std::floor(angle_rad / (kPi / 2) + 0.5);
  const double remainder = ((angle_rad - turns * kHalfPiHigh) - turns * kHalfPiMiddle) - turns * kHalfPiLow;
  return {remainder, static_cast<int>(static_cast<std::int64_t>(turns) & 3)};
}

}  // namespace

double log(double x) {
  LUKOU_EXPECT(x > 0.0 && x <= std::numeric_limits<double>::max());
  int exponent = 0;
  if (x < std::numeric_limits<double>::min()) {  // subnormal: scale by 2^54
    x *= 18014398509481984.0;
    exponent = -54;
  }
  const auto bits = std::bit_cast<std::uint64_t>(x);
  exponent += static_cast<int>(bits >> 52U) - 1023;
  double mantissa = std::bit_cast<double>((bits & 0xFFFFFFFFFFFFFULL) | 0x3FF0000000000000ULL);
  if (mantissa > 1.4142135623730951) {
    mantissa *= 0.5;
    ++exponent;
  }
  // log m = 2 artanh(s), s = (m-1)/(m+1), |s| <= 0.1716: the terms beyond s^23 are below 1e-19.
  const double s = (mantissa - 1.0) / (mantissa + 1.0);
  const double s2 = s * s;
  double series = 0.0;
  for (int n = 21; n >= 3; n -= 2) series = (series + 1.0 / n) * s2;
  const double e = exponent;
  return e * kLn2High + (2.0 * s + (2.0 * s * series + e * kLn2Low));
}

double exp(double x) {
  if (x < -700.0) return 0.0;
  if (x > 700.0) return std::numeric_limits<double>::max();
  const double n = std::floor(x / (kLn2High + kLn2Low) + 0.5);
  const double r = (x - n * kLn2High) - n * kLn2Low;  // |r| <= 0.3466
  double sum = 1.0;
  for (int i = 17; i >= 1; --i) sum = 1.0 + sum * r / i;
  const auto power = static_cast<std::uint64_t>(static_cast<std::int64_t>(n) + 1023);
  return sum * std::bit_cast<double>(power << 52U);
}

double sin(double angle_rad) {
  const Reduced a = reduce(angle_rad);
  const double value = (a.quadrant & 1) != 0 ? cos_reduced(a.remainder) : sin_reduced(a.remainder);
  return (a.quadrant & 2) != 0 ? -value : value;
}

double cos(double angle_rad) {
  const Reduced a = reduce(angle_rad);
  const double value = (a.quadrant & 1) != 0 ? sin_reduced(a.remainder) : cos_reduced(a.remainder);
  return a.quadrant == 1 || a.quadrant == 2 ? -value : value;
}

double normal_quantile(double p) {
  LUKOU_EXPECT(p > 0.0 && p < 1.0);
  static constexpr double kA[] = {3.3871328727963666080e0,  1.3314166789178437745e+2, 1.9715909503065514427e+3,
                                  1.3731693765509461125e+4, 4.5921953931549871457e+4, 6.7265770927008700853e+4,
                                  3.3430575583588128105e+4, 2.5090809287301226727e+3};
  static constexpr double kB[] = {1.0,
                                  4.2313330701600911252e+1,
                                  6.8718700749205790830e+2,
                                  5.3941960214247511077e+3,
                                  2.1213794301586595867e+4,
                                  3.9307895800092710610e+4,
                                  2.8729085735721942674e+4,
                                  5.2264952788528545610e+3};
  static constexpr double kC[] = {1.42343711074968357734e0,  4.63033784615654529590e0, 5.76949722146069140550e0,
                                  3.64784832476320460504e0,  1.27045825245236838258e0, 2.41780725177450611770e-1,
                                  2.27238449892691845833e-2, 7.74545014278341407640e-4};
  static constexpr double kD[] = {1.0,
                                  2.05319162663775882187e0,
                                  1.67638483018380384940e0,
                                  6.89767334985100004550e-1,
                                  1.48103976427480074590e-1,
                                  1.51986665636164571966e-2,
                                  5.47593808499534494600e-4,
                                  1.05075007164441684324e-9};
  static constexpr double kE[] = {6.65790464350110377720e0,  5.46378491116411436990e0,  1.78482653991729133580e0,
                                  2.96560571828504891230e-1, 2.65321895265761230930e-2, 1.24266094738807843860e-3,
                                  2.71155556874348757815e-5, 2.01033439929228813265e-7};
  static constexpr double kF[] = {1.0,
                                  5.99832206555887937690e-1,
                                  1.36929880922735805310e-1,
                                  1.48753612908506148525e-2,
                                  7.86869131145613259100e-4,
                                  1.84631831751005468180e-5,
                                  1.42151175831644588870e-7,
                                  2.04426310338993978564e-15};
  const double q = p - 0.5;
  if (q >= -0.425 && q <= 0.425) {
    const double r = 0.180625 - q * q;
    return q * polynomial(kA, 7, r) / polynomial(kB, 7, r);
  }
  const double tail = q < 0.0 ? p : 1.0 - p;
  double r = std::sqrt(-log(tail));
  double value = 0.0;
  if (r <= 5.0) {
    r -= 1.6;
    value = polynomial(kC, 7, r) / polynomial(kD, 7, r);
  } else {
    r -= 5.0;
    value = polynomial(kE, 7, r) / polynomial(kF, 7, r);
  }
  return q < 0.0 ? -value : value;
}

double normal_cdf(double x) {
  static constexpr double kN[] = {220.206867912376, 221.213596169931,  112.079291497871,   33.912866078383,
                                  6.37396220353165, 0.700383064443688, 3.52624965998911e-2};
  static constexpr double kD[] = {440.413735824752, 793.826512519948, 637.333633378831, 296.564248779674,
                                  86.7807322029461, 16.064177579207,  1.75566716318264, 8.83883476483184e-2};
  const double size = x < 0.0 ? -x : x;
  double beyond = 0.0;  // probability of more than `size`
  if (size < 7.07) {
    beyond = exp(-0.5 * size * size) * polynomial(kN, 6, size) / polynomial(kD, 7, size);
  } else if (size < 37.0) {
    const double fraction = size + 1.0 / (size + 2.0 / (size + 3.0 / (size + 4.0 / (size + 0.65))));
    beyond = exp(-0.5 * size * size) / (fraction * 2.506628274631000502);
  }
  return x < 0.0 ? beyond : 1.0 - beyond;
}

}  // namespace lukou::math
