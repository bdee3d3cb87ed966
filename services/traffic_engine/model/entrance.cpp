#include "services/traffic_engine/model/entrance.hpp"

#include <algorithm>
#include <cmath>

#include "common/core/keyed_random.hpp"
#include "services/traffic_engine/model/guard.hpp"

namespace lukou::traffic {

Driver drawn_driver(const EngineParameters& parameters, std::uint32_t vehicle) {
  const DrivingParameters& driving = parameters.driving;
  const double limit_mps = parameters.vehicles.speed_limit_mps;
  DrawKey key{.run_seed = parameters.seed, .purpose = Purpose::kDesiredSpeed, .entity = vehicle, .index = 0};
  Driver driver;
  driver.desired_speed_mps =
      limit_mps * truncated_normal(key, driving.desired_speed_mean, driving.desired_speed_deviation,
                                   driving.desired_speed_min, driving.desired_speed_max);
  key.purpose = Purpose::kInitialSpeed;
  driver.initial_speed_mps =
      limit_mps * truncated_normal(key, driving.desired_speed_mean, driving.desired_speed_deviation,
                                   driving.initial_speed_min, 1.0);
  key.purpose = Purpose::kTemporaryId;
  driver.temporary_id = random_bits(key);
  return driver;
}

bool drawn_equipped(std::uint64_t seed, std::uint32_t vehicle, double equipped_ratio) {
  return uniform01({.run_seed = seed, .purpose = Purpose::kEquipped, .entity = vehicle, .index = 0}) < equipped_ratio;
}

AdvisedDriver drawn_compliance(const EngineParameters& parameters, std::uint32_t vehicle) {
  using Kind = AdvisedDriver::Kind;
  const ComplianceParameters& compliance = parameters.compliance;
  if (compliance.human_share <= 0.0 && compliance.ignoring_share <= 0.0) return {};
  DrawKey key{.run_seed = parameters.seed, .purpose = Purpose::kCompliance, .entity = vehicle, .index = 0};
  const double uniform = uniform01(key);
  // Ignoring drivers from below, humans from above.
  if (uniform < compliance.ignoring_share) return {.kind = Kind::kIgnoring};
  if (uniform < 1.0 - compliance.human_share) return {};
  key.purpose = Purpose::kDriverGain;
  return {.kind = Kind::kHuman, .gain = std::max(0.0, 1.0 + compliance.gain_deviation * standard_normal(key))};
}

bool lane_is_safe(const FollowLaw& law, const std::optional<Motion>& last) {
  return !last || last->position_m >= law.safe_distance_m(last->speed_mps);
}

std::optional<int> chosen_lane(const std::array<bool, kLanesPerApproach>& safe,
                               const std::array<double, kLanesPerApproach>& weights, double uniform) {
  double total = 0.0;
  for (std::size_t i = 0; i < safe.size(); ++i) total += safe[i] ? weights[i] : 0.0;
  double below = 0.0;
  std::optional<int> chosen;
  for (std::size_t i = 0; i < safe.size(); ++i) {
    if (!safe[i] || weights[i] <= 0.0) continue;
    chosen = static_cast<int>(i);  // the last possible one stands if rounding lets `uniform` pass them all
    below += weights[i];
    if (uniform * total < below) break;
  }
  return chosen;
}

double capped_initial_speed_mps(const EngineParameters& parameters, const FollowLaw& law, double drawn_mps,
                                const std::optional<Motion>& last) {
  if (!last) return drawn_mps;
  const double braking_mps2 = parameters.vehicles.acceleration_max_mps2;
  const double room_m =
      stopping_point_m(last->position_m, last->speed_mps, braking_mps2) - parameters.driving.guard_spacing_m;
  double capped_mps = std::min(drawn_mps, std::sqrt(2.0 * braking_mps2 * std::max(room_m, 0.0)));
  if (last->position_m < parameters.driving.reaction_distance_m) {
    const double spare_m = std::max(last->position_m - law.safe_distance_m(last->speed_mps), 0.0);
    capped_mps = std::min(capped_mps, std::sqrt(last->speed_mps * last->speed_mps + braking_mps2 * spare_m));
  }
  return capped_mps;
}

}  // namespace lukou::traffic
