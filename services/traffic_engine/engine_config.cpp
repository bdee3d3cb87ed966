#include "services/traffic_engine/engine_config.hpp"

#include <string>
#include <utility>

#include "common/scenario/radio.hpp"
#include "common/scenario/scenario_steps.hpp"
#include "scenario.pb.h"

namespace lukou {
namespace {

constexpr double kKmhPerMps = 3.6;

const scenario::Demand& demand_of(const scenario::Traffic& traffic, Approach approach) {
  switch (approach) {
    case Approach::kWest:
      return traffic.west();
    case Approach::kSouth:
      return traffic.south();
    case Approach::kEast:
      return traffic.east();
    case Approach::kNorth:
      break;
  }
  return traffic.north();
}

traffic::VehicleParameters vehicle_parameters(const scenario::Vehicles& from) {
  return {.length_m = from.length_m(),
          .width_m = from.width_m(),
          .speed_limit_mps = from.speed_limit_kmh() / kKmhPerMps,
          .acceleration_max_mps2 = from.acceleration_max_mps2(),
          .actuation_noise_mps2 = from.actuation_noise_mps2()};
}

/// A field that is kept absent has its fallback.
traffic::UnitParameters unit_parameters(const scenario::OnBoardUnit& from) {
  traffic::UnitParameters unit;
  unit.fallback_s = from.fallback_s();
  unit.rsu_lost_after_s = from.rsu_lost_after_s();
  if (from.has_speed_gain_time_s()) unit.speed_gain_time_s = from.speed_gain_time_s();
  if (from.has_speed_acceleration_mps2()) unit.speed_acceleration_mps2 = from.speed_acceleration_mps2();
  if (from.has_speed_deceleration_mps2()) unit.speed_deceleration_mps2 = from.speed_deceleration_mps2();
  return unit;
}

traffic::DrivingParameters driving_parameters(const scenario::Driving& from) {
  return {.desired_speed_mean = from.desired_speed_mean(),
          .desired_speed_deviation = from.desired_speed_deviation(),
          .desired_speed_min = from.desired_speed_min(),
          .desired_speed_max = from.desired_speed_max(),
          .initial_speed_min = from.initial_speed_min(),
          .safe_time_s = from.safe_time_s(),
          .standstill_spacing_m = from.standstill_spacing_m(),
          .guard_spacing_m = from.guard_spacing_m(),
          .reaction_distance_m = from.reaction_distance_m(),
          .comfortable_braking_mps2 = from.comfortable_braking_mps2(),
          .perception_threshold_radps = from.perception_threshold_radps(),
          .perception_floor_mps = from.perception_floor_mps(),
          .band_near = from.band_near(),
          .band_far = from.band_far(),
          .singularity_m = from.singularity_m(),
          .speed_relaxation_s = from.speed_relaxation_s(),
          .gap_closing_mps2 = from.gap_closing_mps2(),
          .discharge_speed_mps = from.discharge_speed_kmh() / kKmhPerMps,
          .reaction_time_s = from.reaction_time_s()};
}

traffic::UnitErrorParameters unit_error_parameters(const scenario::Vehicles& from) {
  traffic::UnitErrorParameters errors;
  errors.clock_offset_ms = from.clock_offset_ms();
  if (!from.has_positioning()) return errors;
  errors.bias_m = from.positioning().bias_m();
  errors.noise_m = from.positioning().noise_m();
  errors.correlation_s = from.positioning().correlation_s();
  return errors;
}

std::vector<traffic::SensorParameters> sensor_parameters(const scenario::Scenario& scenario) {
  std::vector<traffic::SensorParameters> sensors;
  for (int rsu = 0; rsu < scenario.rsus_size(); ++rsu) {
    for (int i = 0; i < scenario.rsus(rsu).sensors_size(); ++i) {
      const scenario::Sensor& from = scenario.rsus(rsu).sensors(i);
      sensors.push_back({.rsu = static_cast<std::uint32_t>(rsu),
                         .sensor = static_cast<std::uint32_t>(i),
                         .approach = static_cast<Approach>(from.approach() - scenario::Sensor::WEST),
                         .from_m = from.from_m(),
                         .to_m = from.to_m(),
                         .miss_rate = from.miss_rate(),
                         .position_noise_m = from.position_noise_m(),
                         .speed_noise_mps = from.speed_noise_mps(),
                         .latency_ms = from.latency_ms()});
    }
  }
  return sensors;
}

Expected<traffic::DemandParameters> demand_parameters(const scenario::Resolved& scenario, Approach approach) {
  const scenario::Demand& from = demand_of(scenario.message().traffic(), approach);
  traffic::DemandParameters demand;
  demand.lane_weights = {from.shares().left(), from.shares().center(), from.shares().right()};
  demand.flows.clear();
  if (from.has_arrivals_csv()) {
    auto arrivals_s = scenario::arrivals(scenario, approach);
    if (!arrivals_s) return arrivals_s.error();
    demand.listed = true;
    demand.arrivals_s = std::move(arrivals_s).value();
  } else if (from.flow_series_size() > 0) {
    for (const scenario::FlowPoint& point : from.flow_series()) {
      demand.flows.push_back({.from_s = point.from_s(), .flow_veh_per_h = point.flow_veh_per_h()});
    }
  } else {
    demand.flows.push_back({.from_s = 0.0, .flow_veh_per_h = from.flow_veh_per_h()});
  }
  return demand;
}

/// A truncated normal needs an interval that is not out of reach; see keyed_random.hpp.
bool holds_enough(double low, double high, double mean, double deviation) {
  constexpr double kLeastWidth = 0.05;  // in deviations: about 2 % of the mass if the mean lies inside
  return low <= mean && mean <= high && high - low >= kLeastWidth * deviation;
}

/// What the check of the scenario leaves to the model that needs it.
Expected<Done> fit_together(const traffic::DrivingParameters& driving) {
  if (driving.guard_spacing_m > driving.standstill_spacing_m) {
    return Error{"driving.guard_spacing_m", "must be at most driving.standstill_spacing_m"};
  }
  const double mean = driving.desired_speed_mean;
  const double deviation = driving.desired_speed_deviation;
  if (!holds_enough(driving.initial_speed_min, 1.0, mean, deviation)) {
    return Error{"driving.initial_speed_min",
                 "must be at most driving.desired_speed_mean, and below 1 by at least a "
                 "twentieth of driving.desired_speed_deviation"};
  }
  return Done{};
}

}  // namespace

Expected<EngineConfig> engine_config(const scenario::Resolved& scenario) {
  const scenario::Scenario& from = scenario.message();
  EngineConfig config;
  config.radio = scenario::radio_parameters(from);
  config.unit_errors = unit_error_parameters(from.vehicles());
  config.sensors = sensor_parameters(from);
  config.rsu_measured = scenario::protocol(scenario).rsu_measured;
  config.record_frames = scenario::logs_everything(scenario);
  config.traffic.seed = from.run().seed();
  config.traffic.overflow_wait_s = from.run().overflow_wait_s();
  config.traffic.vehicles = vehicle_parameters(from.vehicles());
  config.traffic.equipped_ratio = from.vehicles().equipped_ratio();
  config.traffic.unit = unit_parameters(from.vehicles().on_board_unit());
  const scenario::Compliance& compliance = from.vehicles().compliance();
  config.traffic.compliance = {.human_share = compliance.human_share(),
                               .ignoring_share = compliance.ignoring_share(),
                               .reaction_s = compliance.reaction_s(),
                               .gain_deviation = compliance.gain_deviation(),
                               .threshold_mps2 = compliance.threshold_mps2()};
  config.traffic.driving = driving_parameters(from.driving());
  if (const auto fits = fit_together(config.traffic.driving); !fits) return fits.error();
  config.traffic.road = {.approach_m = from.traffic().approach_length_m(), .exit_m = from.traffic().exit_length_m()};
  for (const Approach approach : kAllApproaches) {
    auto demand = demand_parameters(scenario, approach);
    if (!demand) return demand.error();
    config.traffic.demand[index(approach)] = std::move(demand).value();
  }
  return config;
}

}  // namespace lukou
