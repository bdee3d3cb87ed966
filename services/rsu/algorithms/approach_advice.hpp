#pragma once

#include <optional>

#include "services/rsu/algorithms/approach_rules.hpp"
#include "services/rsu/algorithms/crossing_plan.hpp"
#include "services/rsu/algorithms/guided_cars.hpp"
#include "services/rsu/sdk/arrival.hpp"
#include "services/rsu/sdk/rsu_answer.hpp"

namespace lukou {

/// What a planned car needs.
enum class Need {
  kNothing,  ///< it crosses in the green that shows: it is left alone
  kGo,       ///< it makes a green to come just as it drives: it must not brake for the red of now
  kDelay,    ///< it is early
};
Need need_of(const ApproachRules& rules, const LaneView& lane, const Crossing& crossing);

/// Speaks to cars within the rules: every advice is bound by FOLLOWING, is one that every car takes and a message
/// carries, and a car is released once when it gets none any more.
class ApproachAdvice {
 public:
  explicit ApproachAdvice(const ApproachRules& rules);

  void advise(const HeardCar& car, double acceleration_mps2, RsuAnswer& answer);
  /// The largest acceleration: under FOLLOWING the car drives as it likes, but does not brake for red by comfort. A car
  /// so far away that none brakes for red is released instead.
  void go(const HeardCar& car, RsuAnswer& answer);
  /// Only a car that was advised in the step before is told.
  void release(const HeardCar& car, RsuAnswer& answer) const { cars_.release(car, answer); }
  /// Says what a planned car needs that is near enough, but for one that is to be delayed: its goal comes back. All
  /// others are released.
  std::optional<ArrivalGoal> goal_of(const RsuView& heard, const LaneView& lane, const HeardCar& car,
                                     const Crossing& crossing, RsuAnswer& answer);
  /// After the last word of a step.
  void end_step() { cars_.end_step(); }

 private:
  ApproachRules rules_;
  GuidedCars cars_;
};

/// The even speed that brings the car to the line in time, d / t, within [speed_min, `speed_limit_mps`].
double even_speed_mps(const ApproachRules& rules, const ArrivalGoal& goal, double speed_limit_mps);
/// The acceleration that closes the gap to a speed in gain_time_s, within [-slowing_down, speeding_up].
double towards_mps2(const ApproachRules& rules, double speed_mps, double wanted_mps);

/// The first acceleration of the smoothest arrival, its end speed free if `end_speed_mps` is empty. If that leaves
/// [speed_min, `speed_limit_mps`] or the comfortable accelerations on its way: towards the speed at which the car
/// arrives in time after braking (or speeding up) evenly, within the same bounds.
double smooth_arrival_mps2(const ApproachRules& rules, const ArrivalGoal& goal, double speed_limit_mps,
                           std::optional<double> end_speed_mps);

}  // namespace lukou
