#include "services/rsu/algorithms/eco.hpp"

#include <algorithm>

namespace lukou {

Eco::Eco(const EcoParameters& parameters) : parameters_(parameters), advice_(parameters.approach) {}

void Eco::on_step(const RsuView& heard, RsuAnswer& answer) {
  const ApproachRules& rules = parameters_.approach;
  const double limit_mps = heard.map.speed_limit_mps;
  std::optional<double> end_mps = parameters_.end_speed_mps;
  if (end_mps) end_mps = std::min(*end_mps, limit_mps);
  for (const LaneView& lane : heard.lanes) {
    plan_lane(rules, parameters_.queue, heard, lane, plan_);
    for (std::size_t i = 0; i < plan_.size(); ++i) {
      if (const auto goal = advice_.goal_of(heard, lane, lane.cars[i], plan_[i], answer)) {
        advice_.advise(lane.cars[i], smooth_arrival_mps2(rules, *goal, limit_mps, end_mps), answer);
      }
    }
  }
  advice_.end_step();
}

}  // namespace lukou
