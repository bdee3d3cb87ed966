#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "services/traffic_engine/model/follow_law.hpp"
#include "services/traffic_engine/model/on_board_unit.hpp"
#include "services/traffic_engine/model/parameters.hpp"

namespace lukou::traffic {

/// What a driver brings along, drawn for the vehicle and nothing else.
struct Driver {
  double desired_speed_mps = 0.0;
  double initial_speed_mps = 0.0;
  std::uint64_t temporary_id = 0;
};

Driver drawn_driver(const EngineParameters& parameters, std::uint32_t vehicle);
/// True if the vehicle has an on-board unit under this ratio, [0, 1].
bool drawn_equipped(std::uint64_t seed, std::uint32_t vehicle, double equipped_ratio);

/// How the driver of a car with a unit takes advice. Raising one share leaves the drivers of the other alone.
AdvisedDriver drawn_compliance(const EngineParameters& parameters, std::uint32_t vehicle);

/// True if a car may come onto a lane whose last car is `last` (none: an empty lane): equation (5).
bool lane_is_safe(const FollowLaw& law, const std::optional<Motion>& last);
/// Chooses among the safe lanes of an approach by their weights; nothing if no safe lane has a weight > 0.
std::optional<int> chosen_lane(const std::array<bool, kLanesPerApproach>& safe,
                               const std::array<double, kLanesPerApproach>& weights, double uniform);
/// Caps the speed [m/s] at the entrance, so that the car can follow `last` without braking hard. Requires a safe lane.
double capped_initial_speed_mps(const EngineParameters& parameters, const FollowLaw& law, double drawn_mps,
                                const std::optional<Motion>& last);

}  // namespace lukou::traffic
