#include "services/rsu/algorithms/glosa.hpp"

namespace lukou {

Glosa::Glosa(const GlosaParameters& parameters) : parameters_(parameters), advice_(parameters.approach) {}

void Glosa::on_step(const RsuView& heard, RsuAnswer& answer) {
  for (const LaneView& lane : heard.lanes) {
    plan_lane(parameters_.approach, parameters_.queue, heard, lane, plan_);
    for (std::size_t i = 0; i < plan_.size(); ++i) guide(heard, lane, lane.cars[i], plan_[i], answer);
  }
  advice_.end_step();
}

void Glosa::guide(const RsuView& heard, const LaneView& lane, const HeardCar& car, const Crossing& crossing,
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
      const ArrivalGoal arrival{car.distance_m, car.speed_mps, crossing.time_s - heard.time_s};
      const double advised_mps = even_speed_mps(rules, arrival, heard.map.speed_limit_mps);
      advice_.advise(car, towards_mps2(rules, car.speed_mps, advised_mps), answer);
      break;
  }
}

}  // namespace lukou
