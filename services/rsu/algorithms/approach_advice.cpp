#include "services/rsu/algorithms/approach_advice.hpp"

#include <algorithm>

#include "common/core/contract.hpp"
#include "services/rsu/sdk/planning.hpp"

namespace lukou {
namespace {

/// Nearer to its arrival a closed form answers every deviation with a jolt: the car is brought to an even speed.
constexpr double kLastPart_s = 1.0;  // assumed
/// Farther away no car brakes for red. Source: the traffic model, reaction distance.
constexpr double kGoDistance_m = 150.0;

}  // namespace

Need need_of(const ApproachRules& rules, const LaneView& lane, const Crossing& crossing) {
  if (crossing.time_s > crossing.earliest_s + rules.slack_s) return Need::kDelay;
  return lane.aspect == Aspect::kGreen ? Need::kNothing : Need::kGo;
}

ApproachAdvice::ApproachAdvice(const ApproachRules& rules) : rules_(rules), cars_(rules.lifetime_s) {
  LUKOU_EXPECT(rules.acceleration_max_mps2 > 0.0 && rules.gain_time_s > 0.0);
}

void ApproachAdvice::advise(const HeardCar& car, double acceleration_mps2, RsuAnswer& answer) {
  cars_.advise(car, carriable_mps2(acceleration_mps2, rules_.acceleration_max_mps2), answer);
}

void ApproachAdvice::go(const HeardCar& car, RsuAnswer& answer) {
  if (car.distance_m > kGoDistance_m) {
    release(car, answer);
  } else {
    advise(car, rules_.acceleration_max_mps2, answer);
  }
}

std::optional<ArrivalGoal> ApproachAdvice::goal_of(const RsuView& heard, const LaneView& lane, const HeardCar& car,
                                                   const Crossing& crossing, RsuAnswer& answer) {
  const bool is_ours = crossing.kind == Crossing::Kind::kPlanned && car.distance_m <= rules_.activation_distance_m;
  switch (is_ours ? need_of(rules_, lane, crossing) : Need::kNothing) {
    case Need::kNothing:
      release(car, answer);
      break;
    case Need::kGo:
      go(car, answer);
      break;
    case Need::kDelay:
      return ArrivalGoal{car.distance_m, car.speed_mps, crossing.time_s - heard.time_s};
  }
  return std::nullopt;
}

double even_speed_mps(const ApproachRules& rules, const ArrivalGoal& goal, double speed_limit_mps) {
  LUKOU_EXPECT(goal.time_s > 0.0);
  const double least_mps = std::min(rules.speed_min_mps, speed_limit_mps);
  return std::clamp(goal.distance_m / goal.time_s, least_mps, speed_limit_mps);
}

double towards_mps2(const ApproachRules& rules, double speed_mps, double wanted_mps) {
  return std::clamp((wanted_mps - speed_mps) / rules.gain_time_s, -rules.slowing_down_mps2, rules.speeding_up_mps2);
}

double smooth_arrival_mps2(const ApproachRules& rules, const ArrivalGoal& goal, double speed_limit_mps,
                           std::optional<double> end_speed_mps) {
  const double least_mps = std::min(rules.speed_min_mps, speed_limit_mps);
  if (goal.time_s > kLastPart_s) {
    const RampedAcceleration ramp = end_speed_mps ? smoothest_arrival(goal, *end_speed_mps) : smoothest_arrival(goal);
    const Extent speeds = speeds_on_the_way_mps(goal, ramp);
    const Extent accelerations = accelerations_on_the_way_mps2(goal, ramp);
    const bool is_comfortable =
        accelerations.least >= -rules.slowing_down_mps2 && accelerations.most <= rules.speeding_up_mps2;
    if (is_comfortable && speeds.least >= least_mps && speeds.most <= speed_limit_mps) return ramp.start_mps2;
  }
  const bool is_early = goal.speed_mps * goal.time_s > goal.distance_m;
  const std::optional<double> cruise_mps = is_early ? cruise_after_braking_mps(goal, rules.slowing_down_mps2)
                                                    : cruise_after_speeding_up_mps(goal, rules.speeding_up_mps2);
  const double otherwise_mps = is_early ? least_mps : speed_limit_mps;
  return towards_mps2(rules, goal.speed_mps,
                      std::clamp(cruise_mps.value_or(otherwise_mps), least_mps, speed_limit_mps));
}

}  // namespace lukou
