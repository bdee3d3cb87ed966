#include "services/rsu/algorithms/max_pressure.hpp"

#include <algorithm>

namespace lukou {

MaxPressure::MaxPressure(const MaxPressureParameters& parameters)
    : parameters_(parameters), control_(parameters.staging) {}

void MaxPressure::on_step(const RsuView& heard, RsuAnswer& answer) {
  control_.see(heard);
  if (control_.may_change() && heard.step % step_at_or_after(parameters_.decision_s) == 0) {
    const double own = pressure(heard, control_.stages()[control_.current()]);
    std::size_t best = control_.current();
    double most = 0.0;
    for (std::size_t stage = 0; stage < control_.stages().size(); ++stage) {
      if (stage == control_.current()) continue;
      const double cars = pressure(heard, control_.stages()[stage]);
      if (cars > most) {
        best = stage;
        most = cars;
      }
    }
    if (most > own + parameters_.hysteresis_veh || own == 0.0) control_.go_to(best);
  }
  control_.ask(answer);
}

double MaxPressure::pressure(const RsuView& heard, LaneSet lanes) {
  double cars = 0.0;
  for (const Lane lane : lanes) {
    seen_cars(heard.lanes[index(lane)], cars_);
    cars += static_cast<double>(
        std::ranges::count_if(cars_, [&](const SeenCar& car) { return car.distance_m <= parameters_.distance_m; }));
  }
  return cars;
}

}  // namespace lukou
