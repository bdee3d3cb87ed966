#include "services/rsu/sdk/arrival.hpp"

#include <algorithm>
#include <cmath>

#include "common/core/contract.hpp"

namespace lukou {

RampedAcceleration smoothest_arrival(const ArrivalGoal& arrival) {
  LUKOU_EXPECT(arrival.time_s > 0.0);
  const double t = arrival.time_s;
  const double start_mps2 = 3.0 * (arrival.distance_m - arrival.speed_mps * t) / (t * t);
  return {start_mps2, -start_mps2 / t};
}

RampedAcceleration smoothest_arrival(const ArrivalGoal& arrival, double end_speed_mps) {
  LUKOU_EXPECT(arrival.time_s > 0.0);
  const double t = arrival.time_s;
  const double d = arrival.distance_m;
  const double v = arrival.speed_mps;
  return {(6.0 * d - 2.0 * t * (2.0 * v + end_speed_mps)) / (t * t),
          (6.0 * t * (v + end_speed_mps) - 12.0 * d) / (t * t * t)};
}

Extent speeds_on_the_way_mps(const ArrivalGoal& arrival, const RampedAcceleration& ramp) {
  const auto speed_mps = [&](double t) {
    return arrival.speed_mps + ramp.start_mps2 * t + 0.5 * ramp.slope_mps3 * t * t;
  };
  const double end_mps = speed_mps(arrival.time_s);
  Extent speeds{std::min(arrival.speed_mps, end_mps), std::max(arrival.speed_mps, end_mps)};
  if (ramp.slope_mps3 == 0.0) return speeds;
  const double turn_s = -ramp.start_mps2 / ramp.slope_mps3;
  if (turn_s > 0.0 && turn_s < arrival.time_s) {
    speeds = {std::min(speeds.least, speed_mps(turn_s)), std::max(speeds.most, speed_mps(turn_s))};
  }
  return speeds;
}

Extent accelerations_on_the_way_mps2(const ArrivalGoal& arrival, const RampedAcceleration& ramp) {
  const double end_mps2 = ramp.start_mps2 + ramp.slope_mps3 * arrival.time_s;
  return {std::min(ramp.start_mps2, end_mps2), std::max(ramp.start_mps2, end_mps2)};
}

std::optional<double> cruise_after_braking_mps(const ArrivalGoal& arrival, double braking_mps2) {
  LUKOU_EXPECT(braking_mps2 > 0.0 && arrival.time_s > 0.0);
  const double too_far_m = arrival.speed_mps * arrival.time_s - arrival.distance_m;
  const double change_mps = braking_mps2 * arrival.time_s;
  const double square = change_mps * change_mps - 2.0 * braking_mps2 * too_far_m;
  if (too_far_m < 0.0 || square < 0.0) return std::nullopt;
  const double cruise_mps = arrival.speed_mps - change_mps + std::sqrt(square);
  if (cruise_mps <= 0.0) return std::nullopt;
  return cruise_mps;
}

std::optional<double> cruise_after_speeding_up_mps(const ArrivalGoal& arrival, double acceleration_mps2) {
  LUKOU_EXPECT(acceleration_mps2 > 0.0 && arrival.time_s > 0.0);
  const double missing_m = arrival.distance_m - arrival.speed_mps * arrival.time_s;
  const double change_mps = acceleration_mps2 * arrival.time_s;
  const double square = change_mps * change_mps - 2.0 * acceleration_mps2 * missing_m;
  if (missing_m < 0.0 || square < 0.0) return std::nullopt;
  return arrival.speed_mps + change_mps - std::sqrt(square);
}

}  // namespace lukou
