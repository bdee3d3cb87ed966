#pragma once

namespace lukou::math {

// The C library's log, exp, sin and cos differ in the last bit between processors with and without fused multiply-add,
// so results of the models would depend on the machine. These use + - * / and sqrt alone, which IEEE 754 fixes.

/// Natural logarithm. Requires x > 0 and finite. Relative error below 4e-16 away from x = 1.
double log(double x);
/// e^x for x in [-700, 700]; outside it saturates to 0 or to the largest finite value.
double exp(double x);
/// Sine and cosine of an angle [rad], |angle| <= 1e4.
double sin(double angle_rad);
double cos(double angle_rad);
/// Quantile of the standard normal distribution. Requires 0 < p < 1.
/// Source: Wichura (1988), algorithm AS 241, PPND16: relative error about 1e-16.
double normal_quantile(double p);
/// Distribution function of the standard normal distribution, in [0, 1].
/// Source: Hart et al. (1968), algorithm 5666, with the rational form up to |x| = 7.07; absolute error below 1e-14.
double normal_cdf(double x);

inline constexpr double kPi = 3.14159265358979323846;

}  // namespace lukou::math
