#include "services/traffic_engine/model/follow_law.hpp"

#include <algorithm>
#include <cmath>

namespace lukou::traffic {
namespace {

/// Near the standstill of the band drivers only ease off instead of braking hard: below this share of the safe distance
/// they brake hard all the same, and this is how much they ease off [m/s2]. Source: study of the model.
constexpr double kHardBrakingShare = 0.8;
constexpr double kEasingOff_mps2 = 0.3;

}  // namespace

FollowLaw::FollowLaw(const VehicleParameters& vehicles, const DrivingParameters& driving)
    : driving_(driving),
      acceleration_max_mps2_(vehicles.acceleration_max_mps2),
      perception_per_m_s_(driving.perception_threshold_radps / vehicles.width_m) {}

double FollowLaw::free_mps2(double speed_mps, double desired_speed_mps) const {
  const double wanted_mps2 = (desired_speed_mps - speed_mps) / driving_.speed_relaxation_s;
  return std::clamp(wanted_mps2, -acceleration_max_mps2_, acceleration_max_mps2_);
}

double FollowLaw::least_excess_m(double excess_m) const { return std::max(std::abs(excess_m), driving_.singularity_m); }

double FollowLaw::closing_mps2(const Motion& own, const Motion& ahead, double excess_m) const {
  const double closing_mps = own.speed_mps - ahead.speed_mps;
  const double matching_mps2 = ahead.acceleration_mps2 - closing_mps * closing_mps / (2.0 * least_excess_m(excess_m));
  if (ahead.acceleration_mps2 >= 0.0 || excess_m <= 0.0) return matching_mps2;
  // (7) takes for granted that the car ahead goes on braking until the speeds match. If it will stand before that, it
  // is enough to stop behind the place where it will stand.
  const double braking_mps2 = -ahead.acceleration_mps2;
  if (ahead.speed_mps * closing_mps >= 2.0 * excess_m * braking_mps2) return matching_mps2;
  const double room_m = ahead.position_m - own.position_m + ahead.speed_mps * ahead.speed_mps / (2.0 * braking_mps2) -
                        driving_.standstill_spacing_m;
  return std::max(matching_mps2, -own.speed_mps * own.speed_mps / (2.0 * room_m));
}

double FollowLaw::following_mps2(const Motion& own, double desired_speed_mps, const Motion& ahead) const {
  const double free = free_mps2(own.speed_mps, desired_speed_mps);
  const double distance_m = ahead.position_m - own.position_m;
  if (distance_m >= driving_.reaction_distance_m) return free;

  const double safe_m = safe_distance_m(ahead.speed_mps);
  const double excess_m = distance_m - safe_m;
  const double closing_mps = own.speed_mps - ahead.speed_mps;
  const double perceived = perceived_mps(distance_m);
  const bool far = distance_m > safe_m / driving_.band_far;

  if (distance_m < safe_m / driving_.band_near && closing_mps >= -perceived) {  // too close, and not opening
    const bool ease_off = distance_m > kHardBrakingShare * safe_m && closing_mps <= perceived;
    const double brake = ease_off ? std::min(ahead.acceleration_mps2, 0.0) - kEasingOff_mps2 : -acceleration_max_mps2_;
    return std::min(brake, free);
  }
  if (excess_m < 0.0 && closing_mps < 0.0) {  // too close, but opening: the speed whose own safe distance this is
    return std::min((distance_m / driving_.safe_time_s - own.speed_mps) / driving_.speed_relaxation_s, free);
  }
  if (closing_mps > perceived) return std::min(closing_mps2(own, ahead, excess_m), free);
  const double square_term = closing_mps * closing_mps / (2.0 * least_excess_m(excess_m));
  if (closing_mps < -perceived) {  // opening
    return far ? free : std::min(ahead.acceleration_mps2 + square_term, free);
  }
  if (far) return std::min(free, driving_.gap_closing_mps2);
  const double drift = closing_mps > 0.0 ? -square_term : square_term;  // in the band: follow
  return std::min(ahead.acceleration_mps2 + drift, free);
}

double FollowLaw::braking_to_mps2(const Motion& own, double desired_speed_mps, double target_m) const {
  const double free = free_mps2(own.speed_mps, desired_speed_mps);
  const double distance_m = target_m - own.position_m;
  if (distance_m >= driving_.reaction_distance_m) return free;
  if (distance_m <= 0.0) return -acceleration_max_mps2_;
  const double needed_mps2 = own.speed_mps * own.speed_mps / (2.0 * distance_m);
  if (needed_mps2 >= driving_.comfortable_braking_mps2) return std::min(free, -needed_mps2);
  const double steered_mps = std::sqrt(2.0 * driving_.comfortable_braking_mps2 * distance_m);
  const double steering_mps2 = (steered_mps - own.speed_mps) / driving_.speed_relaxation_s;
  return std::min({free, driving_.gap_closing_mps2, steering_mps2});
}

}  // namespace lukou::traffic
