#pragma once

#include "common/intersection/lane.hpp"

namespace lukou {

/// Width of a lane [m] (the paper, 2.1).
inline constexpr double kLaneWidth_m = 3.5;
/// Distance of a stop line from the centre of the junction [m]: half of the crossing road (10.5 m) and 5 m for the
/// pedestrians' crossing; assumed.
inline constexpr double kStopLineOffset_m = 15.5;

/// A point of the plane: origin at the centre of the junction, x to the east, y to the north.
struct Pose {
  double x_m = 0.0;
  double y_m = 0.0;
  double heading_rad = 0.0;  ///< clockwise from north, [0, 2 pi)
};

/// Lengths along a lane's path: approach, then a curve of its own through the junction, then its exit lane.
struct RoadLengths {
  double approach_m = 500.0;  ///< entrance to stop line
  double exit_m = 100.0;      ///< stop line to the end of the exit lane, curve included
};

/// Length of the curve from a lane's stop line to the beginning of its exit lane [m].
double curve_length_m(Lane lane);

/// Where the front of a car is whose path coordinate is `position_m` (0 at the entrance).
/// Every lane keeps its own exit lane, so no two movements share one.
Pose pose_on_path(const RoadLengths& road, Lane lane, double position_m);

}  // namespace lukou
