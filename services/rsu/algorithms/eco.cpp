#include "services/rsu/algorithms/eco.hpp"

#include <algorithm>

namespace lukou {

Eco::Eco(const EcoParameters& parameters) : parameters_(parameters), advice_(parameters.approach) {}

void Eco::on_step(const RsuView& heard, RsuAnswer& answer) {
  for (const LaneView& lane : heard.lanes) {
    plan_lane(parameters_.approach, parameters_.queue, heard, lane, plan_);
    for (std::size_t i = 0; i < plan_.size(); ++i) guide(heard, lane, lane.cars[i], plan_[i], answer);
  }
  advice_.end_step();
}

void Eco::guide(const RsuView& heard, const LaneView& lane, const HeardCar& car, const Crossing& crossing,
                RsuAnswer& answer) {
  const ApproachRules& rules = parameters_.approach;
  const bool is_ours = crossing.kind == Crossing::Kind::kPlanned && car.distance_m <= rules.activation_distance_m;
  switch (is_ours ? need_of(rules, lane, crossing) : Need::kNothing) {
    case Need::kNothing:
      advice_.release(car, answer);
      break;
    case Need::kGo:
      advice_.go(car, answer);
      break;
    case Need::kDelay:
      const double limit_mps = heard.map.speed_limit_mps;
      std::optional<double> end_mps = parameters_.end_speed_mps;
      if (end_mps) end_mps = std::min(*end_mps, limit_mps);
      const ArrivalGoal arrival{car.distance_m, car.speed_mps, crossing.time_s - heard.time_s};
      advice_.advise(car, smooth_arrival_mps2(rules, arrival, limit_mps, end_mps), answer);
      break;
  }
}

}  // namespace lukou
