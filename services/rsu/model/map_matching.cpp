#include "services/rsu/model/map_matching.hpp"

#include <cmath>

#include "common/core/math.hpp"

namespace lukou {
namespace {

constexpr double kHalfPi = math::kPi / 2;
constexpr double kHeadingTolerance_rad = math::kPi / 6;  // assumed
constexpr double kEntranceTolerance_m = 5.0;             // assumed: a position error before the entrance

/// Difference of two headings in [0, 2 pi], as an angle in [0, pi].
double angle_between_rad(double a_rad, double b_rad) {
  const double difference = std::abs(a_rad - b_rad);
  return difference > math::kPi ? 2 * math::kPi - difference : difference;
}

/// Heading of cars that come from an approach: from the west they head east, and so on counter-clockwise.
double heading_from_rad(Approach approach) {
  const double heading = kHalfPi * (1.0 - static_cast<double>(approach));
  return heading < 0.0 ? heading + 2 * math::kPi : heading;
}

}  // namespace

std::optional<ApproachPlace> match_to_map(const RoadLengths& road, const ReportedPlace& car) {
  for (const Approach approach : kAllApproaches) {
    if (angle_between_rad(car.heading_rad, heading_from_rad(approach)) > kHeadingTolerance_rad) continue;
    // Turn the plane until the car comes from the west: a quarter turn clockwise for each approach after it.
    double x_m = car.centre_x_m;
    double y_m = car.centre_y_m;
    for (std::size_t turn = 0; turn < index(approach); ++turn) {
      const double turned_x_m = y_m;
      y_m = -x_m;
      x_m = turned_x_m;
    }
    const double lanes_from_axis = -y_m / kLaneWidth_m;
    if (!(lanes_from_axis >= 0.0 && lanes_from_axis < kLanesPerApproach)) return std::nullopt;
    const double distance_m = -kStopLineOffset_m - x_m - 0.5 * car.length_m;
    const bool on_path = distance_m <= road.approach_m + kEntranceTolerance_m && distance_m >= -2 * kStopLineOffset_m;
    if (!on_path) return std::nullopt;  // nor is what is not a number
    return ApproachPlace{lane_of(approach, static_cast<Turn>(lanes_from_axis)), distance_m};
  }
  return std::nullopt;
}

}  // namespace lukou
