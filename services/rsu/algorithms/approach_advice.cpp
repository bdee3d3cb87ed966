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

ApproachAdvice::ApproachAdvice(const ApproachRules& rules) : rules_(rules) {
  LUKOU_EXPECT(rules.acceleration_max_mps2 > 0.0 && rules.gain_time_s > 0.0);
}

void ApproachAdvice::advise(const HeardCar& car, double acceleration_mps2, RsuAnswer& answer) {
  answer.advise(car.id, {.acceleration_mps2 = carriable_mps2(acceleration_mps2, rules_.acceleration_max_mps2),
                         .lifetime = std::max<Step>(1, step_at_or_after(rules_.lifetime_s)),
                         .binding = Binding::kFollowing});
  advised_now_.push_back(car.id);
}

void ApproachAdvice::go(const HeardCar& car, RsuAnswer& answer) {
  if (car.distance_m > kGoDistance_m) {
    release(car, answer);
  } else {
    advise(car, rules_.acceleration_max_mps2, answer);
  }
}

void ApproachAdvice::release(const HeardCar& car, RsuAnswer& answer) const {
  if (std::ranges::binary_search(advised_, car.id)) answer.release(car.id);
}

void ApproachAdvice::end_step() {
  std::ranges::sort(advised_now_);
  std::swap(advised_, advised_now_);
  advised_now_.clear();
}

Need need_of(const ApproachRules& rules, const LaneView& lane, const Crossing& crossing) {
  if (crossing.time_s > crossing.earliest_s + rules.slack_s) return Need::kDelay;
  return lane.aspect == Aspect::kGreen ? Need::kNothing : Need::kGo;
}

double even_speed_mps(const ApproachRules& rules, const ArrivalGoal& arrival, double speed_limit_mps) {
  LUKOU_EXPECT(arrival.time_s > 0.0);
  const double least_mps = std::min(rules.speed_min_mps, speed_limit_mps);
  return std::clamp(arrival.distance_m / arrival.time_s, least_mps, speed_limit_mps);
}

double towards_mps2(const ApproachRules& rules, double speed_mps, double wanted_mps) {
  return std::clamp((wanted_mps - speed_mps) / rules.gain_time_s, -rules.slowing_down_mps2, rules.speeding_up_mps2);
}

double smooth_arrival_mps2(const ApproachRules& rules, const ArrivalGoal& arrival, double speed_limit_mps,
                           std::optional<double> end_speed_mps) {
  const double least_mps = std::min(rules.speed_min_mps, speed_limit_mps);
  if (arrival.time_s > kLastPart_s) {
    const RampedAcceleration ramp =
        end_speed_mps ? smoothest_arrival(arrival, *end_speed_mps) : smoothest_arrival(arrival);
    const Extent speeds = speeds_on_the_way_mps(arrival, ramp);
    const Extent accelerations = accelerations_on_the_way_mps2(arrival, ramp);
    const bool is_comfortable =
        accelerations.least >= -rules.slowing_down_mps2 && accelerations.most <= rules.speeding_up_mps2;
    if (is_comfortable && speeds.least >= least_mps && speeds.most <= speed_limit_mps) return ramp.start_mps2;
  }
  const bool is_early = arrival.speed_mps * arrival.time_s > arrival.distance_m;
  const std::optional<double> cruise_mps = is_early ? cruise_after_braking_mps(arrival, rules.slowing_down_mps2)
                                                    : cruise_after_speeding_up_mps(arrival, rules.speeding_up_mps2);
  const double otherwise_mps = is_early ? least_mps : speed_limit_mps;
  return towards_mps2(rules, arrival.speed_mps,
                      std::clamp(cruise_mps.value_or(otherwise_mps), least_mps, speed_limit_mps));
}

}  // namespace lukou
