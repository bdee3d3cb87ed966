#include "services/rsu/algorithms/actuated.hpp"

#include <algorithm>

namespace lukou {

Actuated::Actuated(const ActuatedParameters& parameters) : parameters_(parameters), control_(parameters.staging) {}

void Actuated::on_step(const RsuView& heard, RsuAnswer& answer) {
  control_.see(heard);
  const std::vector<LaneSet>& stages = control_.stages();
  if (has_cars(heard, stages[control_.current()])) served_ = heard.step;
  std::size_t next = control_.current();
  for (std::size_t ahead = 1; ahead < stages.size() && next == control_.current(); ++ahead) {
    const std::size_t stage = (control_.current() + ahead) % stages.size();
    if (has_cars(heard, stages[stage])) next = stage;
  }
  const bool calls = next != control_.current();
  if (calls && !calls_) called_ = heard.step;
  calls_ = calls;
  if (calls && control_.may_change()) {
    const bool gap_out = time_s(heard.step - served_) >= parameters_.gap_s;
    const double held_s = std::min(control_.green_s(), time_s(heard.step - called_));
    if (gap_out || held_s >= parameters_.max_green_s) {
      control_.go_to(next);
      calls_ = false;
    }
  }
  control_.ask(answer);
}

bool Actuated::has_cars(const RsuView& heard, LaneSet lanes) {
  for (const Lane lane : lanes) {
    seen_cars(heard.lanes[index(lane)], cars_);
    if (!cars_.empty() && cars_.front().distance_m <= parameters_.detection_m) return true;
  }
  return false;
}

}  // namespace lukou
