#pragma once

#include <vector>

#include "services/rsu/sdk/rsu_view.hpp"

namespace lukou {

/// A car on a lane, whoever told of it.
struct SeenCar {
  double distance_m = 0.0;  ///< of its front to the stop line, > 0
  double speed_mps = 0.0;
};

/// The cars of a lane that were heard or sensed, front to back, each once: reports less than 3 m apart are of one car,
/// since no two fronts of one lane come nearer than 5.5 m. With position errors of metres a car may count twice.
void seen_cars(const LaneView& lane, std::vector<SeenCar>& cars);

}  // namespace lukou
