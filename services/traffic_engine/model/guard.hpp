#pragma once

#include <algorithm>
#include <cmath>

#include "common/core/step.hpp"

namespace lukou::traffic {

// The last resort that makes the model provably free of collisions. A car's stopping point E = x + v^2 / (2 a_max)
// never decreases while it brakes with at most a_max, so a car whose E stays behind the E of the car ahead can always
// stop.

/// Where the front stands after braking with `braking_mps2` [m].
inline double stopping_point_m(double position_m, double speed_mps, double braking_mps2) {
  return position_m + speed_mps * speed_mps / (2.0 * braking_mps2);
}

/// Position [m] at the end of a step with constant acceleration.
inline double advanced_m(double position_m, double speed_mps, double next_speed_mps) {
  return position_m + (speed_mps + next_speed_mps) * kStep_s / 2.0;
}

/// How far a car may come in a step.
struct Room {
  double position_m;        ///< its front stays at or before this
  double stopping_point_m;  ///< and its stopping point at or before this
};

/// The largest speed [m/s] at the end of a step that keeps to the room, at most `wanted_mps`, and at least what braking
/// with `braking_mps2` leaves. Requires wanted_mps >= max(0, speed_mps - braking_mps2 * 0.1 s).
inline double guarded_speed_mps(double position_m, double speed_mps, double wanted_mps, const Room& room,
                                double braking_mps2) {
  const double reached_m = advanced_m(position_m, speed_mps, wanted_mps);
  double allowed_mps = wanted_mps;
  if (stopping_point_m(reached_m, wanted_mps, braking_mps2) > room.stopping_point_m) {
    // Largest root of E(v') = room: v'^2 / (2 b) + v' dt / 2 = room - x - v dt / 2.
    const double spare_m = room.stopping_point_m - position_m - speed_mps * kStep_s / 2.0;
    const double square = kStep_s * kStep_s / 4.0 + 2.0 * spare_m / braking_mps2;
    allowed_mps = square > 0.0 ? std::min(wanted_mps, braking_mps2 * (std::sqrt(square) - kStep_s / 2.0)) : 0.0;
  }
  if (reached_m > room.position_m) {
    allowed_mps = std::min(allowed_mps, 2.0 * (room.position_m - position_m) / kStep_s - speed_mps);
  }
  if (allowed_mps >= wanted_mps) return wanted_mps;
  return std::max({allowed_mps, speed_mps - braking_mps2 * kStep_s, 0.0});
}

}  // namespace lukou::traffic
