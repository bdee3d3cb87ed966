#pragma once

#include <optional>

#include "common/intersection/geometry.hpp"

namespace lukou {

/// A car on an approach lane.
struct ApproachPlace {
  Lane lane{};
  double distance_m = 0.0;  ///< of its front to the stop line; negative = beyond it
};

/// What a car says of where it is.
struct ReportedPlace {
  double centre_x_m = 0.0;
  double centre_y_m = 0.0;
  double heading_rad = 0.0;  ///< clockwise from north
  double length_m = 0.0;     ///< 0 = not told: the centre stands for the front
};

/// The approach lane that a car drives on: its heading picks the approach (within 30 degrees), its distance to the
/// axis the lane. Empty on an exit lane, beside the road, before the entrance (5 m of tolerance), or turned away.
/// Beyond the stop line a car matches for as long as it stays in the corridor of its lane inside the junction.
std::optional<ApproachPlace> match_to_map(const RoadLengths& road, const ReportedPlace& car);

}  // namespace lukou
