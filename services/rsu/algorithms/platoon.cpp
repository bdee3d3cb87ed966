#include "services/rsu/algorithms/platoon.hpp"

#include <algorithm>
#include <cstddef>

namespace lukou {

Platoon::Platoon(const PlatoonParameters& parameters) : parameters_(parameters), advice_(parameters.approach) {}

void Platoon::on_step(const RsuView& heard, RsuAnswer& answer) {
  for (const LaneView& lane : heard.lanes) guide_lane(heard, lane, answer);
  advice_.end_step();
}

bool Platoon::follows(const LaneView& lane, std::size_t i) const {
  if (i == 0 || plan_[i - 1].kind != Crossing::Kind::kPlanned) return false;
  if (plan_[i - 1].green.begin_s != plan_[i].green.begin_s) return false;
  const double gap_m = lane.cars[i].distance_m - lane.cars[i - 1].distance_m;
  return gap_m <= parameters_.gap_s * lane.cars[i].speed_mps;
}

void Platoon::guide_lane(const RsuView& heard, const LaneView& lane, RsuAnswer& answer) {
  const ApproachRules& rules = parameters_.approach;
  const double limit_mps = heard.map.speed_limit_mps;
  const double end_mps = std::min(parameters_.end_speed_mps, limit_mps);
  plan_lane(rules, parameters_.queue, heard, lane, plan_);
  bool is_near = false;
  Need of_leader = Need::kNothing;
  for (std::size_t i = 0; i < plan_.size(); ++i) {
    const HeardCar& car = lane.cars[i];
    const Crossing& crossing = plan_[i];
    if (crossing.kind != Crossing::Kind::kPlanned) {
      advice_.release(car, answer);
      continue;
    }
    Need need = need_of(rules, lane, crossing);
    if (!follows(lane, i)) {
      is_near = car.distance_m <= rules.activation_distance_m;
      of_leader = need;
    } else if (of_leader == Need::kDelay) {
      need = Need::kDelay;
    }
    if (!is_near || need == Need::kNothing) {
      advice_.release(car, answer);
    } else if (need == Need::kGo) {
      advice_.go(car, answer);
    } else {
      const ArrivalGoal goal{car.distance_m, car.speed_mps, crossing.time_s - heard.time_s};
      advice_.advise(car, smooth_arrival_mps2(rules, goal, limit_mps, end_mps), answer);
    }
  }
}

}  // namespace lukou
