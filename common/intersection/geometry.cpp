#include "common/intersection/geometry.hpp"

#include "common/core/math.hpp"

namespace lukou {
namespace {

constexpr double kHalfPi = math::kPi / 2;

/// The path of a lane that comes from the west: heading east, along the side right of the axis.
Pose pose_from_west(Turn turn, double past_line_m, double curve_m) {
  const double lateral_m = kLaneWidth_m * (static_cast<double>(turn) + 0.5);  // distance to the axis
  const Pose line{.x_m = -kStopLineOffset_m, .y_m = -lateral_m, .heading_rad = kHalfPi};
  if (past_line_m <= 0.0 || turn == Turn::kCenter) return {line.x_m + past_line_m, line.y_m, line.heading_rad};
  // A quarter circle to the exit lane that lies as far from its axis as this lane from its own.
  const double side = turn == Turn::kLeft ? 1.0 : -1.0;
  const double radius_m = kStopLineOffset_m + side * lateral_m;
  if (past_line_m < curve_m) {
    const double turned_rad = past_line_m / radius_m;
    return {line.x_m + radius_m * math::sin(turned_rad), line.y_m + side * radius_m * (1.0 - math::cos(turned_rad)),
            kHalfPi - side * turned_rad};
  }
  const double beyond_m = past_line_m - curve_m;
  return {line.x_m + radius_m, line.y_m + side * (radius_m + beyond_m), turn == Turn::kLeft ? 0.0 : math::kPi};
}

/// Turns a pose of the western approach onto another: a quarter turn counter-clockwise each (west, south, east, north).
Pose turned(const Pose& pose, int quarter_turns) {
  Pose result = pose;
  for (int i = 0; i < quarter_turns; ++i) {
    result = {-result.y_m, result.x_m, result.heading_rad - kHalfPi};
    if (result.heading_rad < 0.0) result.heading_rad += 2 * math::kPi;
  }
  return result;
}

}  // namespace

double curve_length_m(Lane lane) {
  const Turn turn = turn_of(lane);
  const double lateral_m = kLaneWidth_m * (static_cast<double>(turn) + 0.5);
  switch (turn) {
    case Turn::kLeft:
      return kHalfPi * (kStopLineOffset_m + lateral_m);
    case Turn::kRight:
      return kHalfPi * (kStopLineOffset_m - lateral_m);
    case Turn::kCenter:
      break;
  }
  return 2 * kStopLineOffset_m;
}

Pose pose_on_path(const RoadLengths& road, Lane lane, double position_m) {
  const Pose pose = pose_from_west(turn_of(lane), position_m - road.approach_m, curve_length_m(lane));
  return turned(pose, static_cast<int>(approach_of(lane)));
}

}  // namespace lukou
