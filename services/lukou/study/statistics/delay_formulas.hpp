#pragma once

#include <optional>

// Mean control delay at a fixed signal, by the two formulas that engineers use. For one lane.

namespace lukou::statistics {

struct SignalisedLane {
  double flow_veh_per_h = 0.0;        ///< > 0
  double saturation_veh_per_h = 0.0;  ///< of the lane in green, > 0
  double cycle_s = 0.0;               ///< > 0
  double green_s = 0.0;               ///< effective, within (0, cycle]

  /// Degree of saturation: the flow over what the lane can let go.
  [[nodiscard]] double saturation() const { return flow_veh_per_h * cycle_s / (saturation_veh_per_h * green_s); }
};

/// Webster (1958), Road Research Technical Paper 39: uniform delay, delay of random arrivals, and his correction [s].
/// Nothing at or above saturation, where it has no value.
std::optional<double> webster_delay_s(const SignalisedLane& lane);

/// Highway Capacity Manual (2000), equations 16-9 to 16-12: uniform and incremental delay [s] of a pretimed, isolated
/// signal (k = 0.5, I = 1, PF = 1) without an initial queue, over an analysis of `period_s` > 0.
double hcm_delay_s(const SignalisedLane& lane, double period_s);

}  // namespace lukou::statistics
