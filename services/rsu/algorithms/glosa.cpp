#include "services/rsu/algorithms/glosa.hpp"

namespace lukou {

Glosa::Glosa(const GlosaParameters& parameters) : parameters_(parameters), advice_(parameters.approach) {}

void Glosa::on_step(const RsuView& heard, RsuAnswer& answer) {
  const ApproachRules& rules = parameters_.approach;
  for (const LaneView& lane : heard.lanes) {
    plan_lane(rules, parameters_.queue, heard, lane, plan_);
    for (std::size_t i = 0; i < plan_.size(); ++i) {
      const HeardCar& car = lane.cars[i];
      if (const auto goal = advice_.goal_of(heard, lane, car, plan_[i], answer)) {
        const double advised_mps = even_speed_mps(rules, *goal, heard.map.speed_limit_mps);
        advice_.advise(car, towards_mps2(rules, car.speed_mps, advised_mps), answer);
      }
    }
  }
  advice_.end_step();
}

}  // namespace lukou
