#pragma once

#include "common/messages/plane.hpp"
#include "common/radio/link_model.hpp"

namespace lukou {

/// What stands between two antennas.
enum class Sight : std::uint8_t {
  kClear,    ///< line of sight
  kBlocked,  ///< the same street, but a car stands in the way
  kCorner,   ///< around the corner of two streets
};

/// A street of the junction, by where an antenna stands.
enum class Street : std::uint8_t { kEastWest = 0, kNorthSouth = 1, kJunction = 2 };

/// The street of a place: the square between the stop lines is both.
Street street_of(const PlanePoint& at);
/// The arm of the junction on which a place lies, whichever way its cars drive: the diagonals part them.
Arm arm_of(const PlanePoint& at);
/// Whether two places lie on different streets, so that houses stand between them.
bool around_corner(const PlanePoint& a, const PlanePoint& b);
/// A place's coordinate along its street [m].
double along_street_m(const PlanePoint& at);

/// Spread and reach of the shadowing around the mean loss.
struct ShadowingLaw {
  double deviation_db = 0.0;
  double decorrelation_m = 0.0;
};
ShadowingLaw shadowing_law(const PathLossModel& model, Sight sight);

/// Mean loss between two antennas [dB], shadowing and the blocking car not included. Requires a law. Distances below 3
/// m count as 3 m.
double path_loss_db(const PathLossModel& model, Sight sight, const PlanePoint& a, const PlanePoint& b);
/// Probability that two cars on one street see each other over that distance [m].
double clear_probability(const PathLossModel& model, double distance_m);
/// What a car in the way takes on top of the loss in clear sight: normal with this mean and deviation, at least 0 [dB].
double blocker_mean_db(double distance_m);
inline constexpr double kBlockerDeviation_db = 4.5;

}  // namespace lukou
