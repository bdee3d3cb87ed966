#pragma once

#include "services/traffic_engine/model/parameters.hpp"

namespace lukou::traffic {

/// A car as its follower sees it, or the follower itself.
struct Motion {
  double position_m = 0.0;  ///< front, along the lane's path
  double speed_mps = 0.0;
  double acceleration_mps2 = 0.0;  ///< of the step that ended
};

/// The following law and the braking for a light, with everything that depends on the parameters alone worked out.
/// Source: the paper, 4.3, equations (6) to (8), a psycho-physical law after Wiedemann, in the reading that
/// docs/model.md gives: the sign of (7) follows the sign of the speed difference.
class FollowLaw {
 public:
  FollowLaw(const VehicleParameters& vehicles, const DrivingParameters& driving);

  /// Safe distance [m] to a car ahead that drives at `speed_mps`: equation (8).
  [[nodiscard]] double safe_distance_m(double speed_mps) const {
    const double moving_m = driving_.safe_time_s * speed_mps;
    return moving_m > driving_.standstill_spacing_m ? moving_m : driving_.standstill_spacing_m;
  }
  /// Smallest speed difference [m/s] that a driver perceives at a head distance: equation (6).
  [[nodiscard]] double perceived_mps(double distance_m) const {
    const double threshold_mps = perception_per_m_s_ * distance_m * distance_m;
    return threshold_mps > driving_.perception_floor_mps ? threshold_mps : driving_.perception_floor_mps;
  }
  /// Acceleration [m/s2] of a driver with nobody ahead, within the limits of acceleration.
  [[nodiscard]] double free_mps2(double speed_mps, double desired_speed_mps) const;
  /// Acceleration [m/s2] behind `ahead`; never more than the free one. May lie below -a_max.
  [[nodiscard]] double following_mps2(const Motion& own, double desired_speed_mps, const Motion& ahead) const;
  /// Acceleration [m/s2] that stops the car at `target_m`; the free one beyond the reaction distance.
  [[nodiscard]] double braking_to_mps2(const Motion& own, double desired_speed_mps, double target_m) const;

 private:
  /// Equation (7) with a speed difference > 0, closing in.
  [[nodiscard]] double closing_mps2(const Motion& own, const Motion& ahead, double excess_m) const;
  [[nodiscard]] double least_excess_m(double excess_m) const;

  DrivingParameters driving_;
  double acceleration_max_mps2_;
  double perception_per_m_s_;  ///< threshold of (6) over the width of a car [1/(m s)]
};

}  // namespace lukou::traffic
