#pragma once

#include <cstdint>

namespace lukou {

/// Number of a simulation step; t_k = k * 0.1 s.
using Step = std::int64_t;

inline constexpr Step kStepsPerSecond = 10;
/// Length of a step [s] (the paper, 2.2).
inline constexpr double kStep_s = 0.1;
/// Length of a step [ms].
inline constexpr std::int64_t kStep_ms = 100;

/// Simulated time of a step [s]: always computed from the step, never summed.
constexpr double time_s(Step step) { return static_cast<double>(step) / static_cast<double>(kStepsPerSecond); }

/// The first step at or after a simulated time [s]; for times of at most 1e9 s that are multiples of 0.1 s it is exact.
constexpr Step step_at_or_after(double at_s) {
  const double steps = at_s * static_cast<double>(kStepsPerSecond);
  const auto floor = static_cast<Step>(steps);
  // A multiple of 0.1 s may lie a rounding error above its step.
  return steps - static_cast<double>(floor) > 1e-6 ? floor + 1 : floor;
}

}  // namespace lukou
