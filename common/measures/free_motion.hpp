#pragma once

namespace lukou {

/// Time [s] to drive `distance_m` from `initial_mps`: full acceleration up to the limit, then constant. A car that
/// starts at or above the limit drives at the limit. The column theoretical_time of the paper, 5.2. Requires distance_m
/// >= 0, 0 <= initial_mps, limit_mps > 0, acceleration_mps2 > 0.
double theoretical_time_s(double distance_m, double initial_mps, double limit_mps, double acceleration_mps2);

/// How a driver whom nobody hinders goes to the own desired speed: dv/dt = (desired - v) / relaxation, at most the
/// limit of acceleration in both directions.
struct FreeDriver {
  double initial_mps = 0.0;
  double desired_mps = 0.0;          ///< > 0
  double relaxation_s = 1.0;         ///< > 0
  double acceleration_max_mps2 = 3;  ///< > 0
};

/// Time [s] in which such a driver covers `distance_m` > 0.
double free_time_s(const FreeDriver& driver, double distance_m);

}  // namespace lukou
