#include "services/rsu/algorithms/speed_harmonisation.hpp"

#include <algorithm>
#include <limits>

#include "common/core/step.hpp"

namespace lukou {

SpeedHarmonisation::SpeedHarmonisation(const SpeedHarmonisationParameters& parameters)
    : parameters_(parameters), advice_(parameters.approach) {
  lane_speed_mps_.fill(std::numeric_limits<double>::infinity());
}

void SpeedHarmonisation::on_step(const RsuView& heard, RsuAnswer& answer) {
  for (std::size_t i = 0; i < heard.lanes.size(); ++i) {
    lane_speed_mps_[i] = std::min(lane_speed_mps_[i], heard.map.speed_limit_mps);
    guide_lane(heard, heard.lanes[i], lane_speed_mps_[i], answer);
  }
  advice_.end_step();
}

void SpeedHarmonisation::guide_lane(const RsuView& heard, const LaneView& lane, double& lane_speed_mps,
                                    RsuAnswer& answer) {
  const ApproachRules& rules = parameters_.approach;
  plan_lane(rules, parameters_.queue, heard, lane, plan_);
  const auto need = [&](std::size_t i) {
    const bool is_ours =
        plan_[i].kind == Crossing::Kind::kPlanned && lane.cars[i].distance_m <= rules.activation_distance_m;
    return is_ours ? need_of(rules, lane, plan_[i]) : Need::kNothing;
  };
  double wanted_mps = heard.map.speed_limit_mps;
  for (std::size_t i = 0; i < plan_.size(); ++i) {
    if (need(i) != Need::kDelay) continue;
    const ArrivalGoal goal{lane.cars[i].distance_m, lane.cars[i].speed_mps, plan_[i].time_s - heard.time_s};
    wanted_mps = std::min(wanted_mps, even_speed_mps(rules, goal, heard.map.speed_limit_mps));
  }
  const double change_mps = parameters_.speed_change_mps2 * kStep_s;
  lane_speed_mps = std::clamp(wanted_mps, lane_speed_mps - change_mps, lane_speed_mps + change_mps);
  for (std::size_t i = 0; i < plan_.size(); ++i) {
    const HeardCar& car = lane.cars[i];
    if (need(i) != Need::kNothing) {
      advice_.advise(car, towards_mps2(rules, car.speed_mps, lane_speed_mps), answer);
    } else {
      advice_.release(car, answer);
    }
  }
}

}  // namespace lukou
