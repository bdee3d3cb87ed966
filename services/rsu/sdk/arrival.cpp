#include "services/rsu/sdk/arrival.hpp"

#include <algorithm>
#include <cmath>

#include "common/core/contract.hpp"

namespace lukou {

RampedAcceleration smoothest_arrival(const ArrivalGoal& goal) {
  LUKOU_EXPECT(goal.time_s > 0.0);
  const double t = goal.time_s;
  const double start_mps2 = 3.0 * (goal.distance_m - goal.speed_mps * t) / (t * t);
  return {start_mps2, -start_mps2 / t};
}

RampedAcceleration smoothest_arrival(const ArrivalGoal& goal, double end_speed_mps) {
  LUKOU_EXPECT(goal.time_s > 0.0);
  const double t = goal.time_s;
  const double d = goal.distance_m;
  const double v = goal.speed_mps;
  return {(6.0 * d - 2.0 * t * (2.0 * v + end_speed_mps)) / (t * t),
          (6.0 * t * (v + end_speed_mps) - 12.0 * d) / (t * t * t)};
}

Extent speeds_on_the_way_mps(const ArrivalGoal& goal, const RampedAcceleration& ramp) {
  const auto speed_mps = [&](double t) { return goal.speed_mps + ramp.start_mps2 * t + 0.5 * ramp.slope_mps3 * t * t; };
  const double end_mps = speed_mps(goal.time_s);
  Extent speeds{std::min(goal.speed_mps, end_mps), std::max(goal.speed_mps, end_mps)};
  if (ramp.slope_mps3 == 0.0) return speeds;
  const double turn_s = -ramp.start_mps2 / ramp.slope_mps3;
  if (turn_s > 0.0 && turn_s < goal.time_s) {
    speeds = {std::min(speeds.least, speed_mps(turn_s)), std::max(speeds.most, speed_mps(turn_s))};
  }
  return speeds;
}

Extent accelerations_on_the_way_mps2(const ArrivalGoal& goal, const RampedAcceleration& ramp) {
  const double end_mps2 = ramp.start_mps2 + ramp.slope_mps3 * goal.time_s;
  return {std::min(ramp.start_mps2, end_mps2), std::max(ramp.start_mps2, end_mps2)};
}

std::optional<double> cruise_after_braking_mps(const ArrivalGoal& goal, double braking_mps2) {
  LUKOU_EXPECT(braking_mps2 > 0.0 && goal.time_s > 0.0);
  const double too_far_m = goal.speed_mps * goal.time_s - goal.distance_m;
  const double change_mps = braking_mps2 * goal.time_s;
  const double square = change_mps * change_mps - 2.0 * braking_mps2 * too_far_m;
  if (too_far_m < 0.0 || square < 0.0) return std::nullopt;
  const double cruise_mps = goal.speed_mps - change_mps + std::sqrt(square);
  if (cruise_mps <= 0.0) return std::nullopt;
  return cruise_mps;
}

std::optional<double> cruise_after_speeding_up_mps(const ArrivalGoal& goal, double acceleration_mps2) {
  LUKOU_EXPECT(acceleration_mps2 > 0.0 && goal.time_s > 0.0);
  const double missing_m = goal.distance_m - goal.speed_mps * goal.time_s;
  const double change_mps = acceleration_mps2 * goal.time_s;
  const double square = change_mps * change_mps - 2.0 * acceleration_mps2 * missing_m;
  if (missing_m < 0.0 || square < 0.0) return std::nullopt;
  return goal.speed_mps + change_mps - std::sqrt(square);
}

}  // namespace lukou
