#pragma once

#include <optional>

#include "common/intersection/lane.hpp"

namespace lukou {

/// A stretch of a lane's path inside the junction, [m] past its stop line.
struct CrossingArea {
  double from_m = 0.0;
  double to_m = 0.0;
};

/// Where the path of `lane` is closer to that of `other` than a car's width (1.8 m), centre line to centre line, to
/// 0.25 m; empty if the two keep apart or come from the same approach. Exists for the pairs that conflict() names.
std::optional<CrossingArea> crossing_area(Lane lane, Lane other);

}  // namespace lukou
