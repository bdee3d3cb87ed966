#pragma once

#include <optional>

namespace lukou {

// Closed forms for a car that is to be at its stop line at a given time. None of them knows of other cars or of limits;
// who uses one checks the speeds and accelerations that it asks for.

/// A car now, and when it is to be at the line.
struct ArrivalGoal {
  double distance_m = 0.0;  ///< to the line, > 0
  double speed_mps = 0.0;   ///< now, >= 0
  double time_s = 0.0;      ///< from now, > 0
};

/// An acceleration that changes evenly: start + slope t.
struct RampedAcceleration {
  double start_mps2 = 0.0;
  double slope_mps3 = 0.0;
};

/// The arrival with the least integral of a^2, its end speed free: a falls evenly to 0 at the line.
/// Source: calculus of variations; start 3 (d - v T) / T^2.
RampedAcceleration smoothest_arrival(const ArrivalGoal& goal);
/// The same with a given speed at the line: start (6 d - 2 T (2 v + v_end)) / T^2, slope (6 T (v + v_end) - 12 d) /
/// T^3.
RampedAcceleration smoothest_arrival(const ArrivalGoal& goal, double end_speed_mps);

/// The least and the largest of something on the way.
struct Extent {
  double least = 0.0;
  double most = 0.0;
};
/// Speeds [m/s] of a car that drives a ramped acceleration until it arrives.
Extent speeds_on_the_way_mps(const ArrivalGoal& goal, const RampedAcceleration& ramp);
/// Accelerations [m/s2] on that way.
Extent accelerations_on_the_way_mps2(const ArrivalGoal& goal, const RampedAcceleration& ramp);

/// The speed to which a car brakes evenly at `braking_mps2` > 0, then holds, to arrive in time:
/// v - b T + sqrt(b^2 T^2 - 2 b (v T - d)). Empty if it would be late without braking, or would have to stand.
std::optional<double> cruise_after_braking_mps(const ArrivalGoal& goal, double braking_mps2);
/// The speed to which a car speeds up evenly at `acceleration_mps2` > 0, then holds, to arrive in time:
/// v + a T - sqrt(a^2 T^2 - 2 a (d - v T)). Empty if it would be early without, or late even so.
std::optional<double> cruise_after_speeding_up_mps(const ArrivalGoal& goal, double acceleration_mps2);

}  // namespace lukou
