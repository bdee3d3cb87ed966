#include "common/measures/surrogate_safety.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lukou {

std::optional<double> time_to_collision_s(const Following& pair) {
  if (pair.approach_mps <= 0.0) return std::nullopt;
  return std::max(pair.gap_m, 0.0) / pair.approach_mps;
}

std::optional<double> deceleration_to_avoid_crash_mps2(const Following& pair) {
  if (pair.approach_mps <= 0.0) return std::nullopt;
  if (pair.gap_m <= 0.0) return std::numeric_limits<double>::infinity();
  return pair.approach_mps * pair.approach_mps / (2.0 * pair.gap_m);
}

std::optional<double> modified_time_to_collision_s(const Following& pair) {
  const double gap_m = std::max(pair.gap_m, 0.0);
  // gap = dv t + da t^2 / 2. This form of the smallest positive root holds for each sign of da, and for da = 0.
  const double square = pair.approach_mps * pair.approach_mps + 2.0 * pair.approach_mps2 * gap_m;
  if (square < 0.0) return std::nullopt;
  const double divisor_mps = pair.approach_mps + std::sqrt(square);
  if (divisor_mps <= 0.0) return std::nullopt;
  return 2.0 * gap_m / divisor_mps;
}

}  // namespace lukou
