#include "services/rsu/rsu_config.hpp"

#include "common/scenario/actuation.hpp"
#include "common/scenario/radio.hpp"
#include "scenario.pb.h"

namespace lukou {
namespace {

constexpr std::uint64_t kFirstStationId = 0x5253'5500'0000'0000;  // "RSU" and its index; a car's id is drawn

ArriveOnGreenParameters arrive_on_green_of(const scenario::ArriveOnGreen& from, double acceleration_max_mps2) {
  return {.acceleration_max_mps2 = acceleration_max_mps2,
          .headway_s = from.headway_s(),
          .first_crossing_s = from.first_crossing_s(),
          .tail_s = from.tail_s(),
          .slack_s = from.slack_s(),
          .target_speed_share = from.target_speed_share(),
          .rates = {.speeding_up_mps2 = from.speeding_up_mps2(),
                    .slowing_down_mps2 = from.slowing_down_mps2(),
                    .final_braking_mps2 = from.final_braking_mps2()},
          .speed_min_mps = from.speed_min_mps(),
          .gain_time_s = from.gain_time_s(),
          .first_speed_mps = from.first_speed_mps(),
          .speed_ramp_mps2 = from.speed_ramp_mps2(),
          .lifetime_s = from.lifetime_s()};
}

/// Every algorithm's message but that of arrive_on_green has the same fields for these.
template <class Message>
ApproachRules approach_of(const Message& from, double acceleration_max_mps2) {
  return {.acceleration_max_mps2 = acceleration_max_mps2,
          .activation_distance_m = from.activation_distance_m(),
          .speed_min_mps = from.speed_min_kmh() / 3.6,
          .target_speed_share = from.target_speed_share(),
          .speeding_up_mps2 = from.speeding_up_mps2(),
          .slowing_down_mps2 = from.slowing_down_mps2(),
          .first_crossing_s = from.first_crossing_s(),
          .tail_s = from.tail_s(),
          .slack_s = from.slack_s(),
          .gain_time_s = from.gain_time_s(),
          .lifetime_s = from.lifetime_s()};
}

template <class Message>
QueueRules queue_of(const Message& from) {
  return {.headway_s = from.headway_s(), .spacing_m = from.spacing_m(), .equipped_share = from.equipped_share()};
}

Staging staging_of(scenario::Staging::Stages stages) {
  return stages == scenario::Staging::PROTECTED_LEFTS ? Staging::kProtectedLefts : Staging::kAxes;
}

/// A message that is absent belongs to an algorithm that is not chosen: its parameters stay at their defaults.
AlgorithmParameters parameters_of(const scenario::Rsu& from, double acceleration_max_mps2) {
  AlgorithmParameters parameters;
  parameters.arrive_on_green.acceleration_max_mps2 = acceleration_max_mps2;
  if (from.has_arrive_on_green()) {
    parameters.arrive_on_green = arrive_on_green_of(from.arrive_on_green(), acceleration_max_mps2);
  }
  if (from.has_actuated()) {
    parameters.actuated = {.staging = staging_of(from.actuated().stages()),
                           .gap_s = from.actuated().gap_s(),
                           .detection_m = from.actuated().detection_m(),
                           .max_green_s = from.actuated().max_green_s()};
  }
  if (from.has_cv_phase()) {
    const scenario::CvPhase& said = from.cv_phase();
    parameters.cv_phase = {.staging = staging_of(said.stages()),
                           .headway_s = said.headway_s(),
                           .equipped_share = said.equipped_share(),
                           .horizon_s = said.horizon_s(),
                           .decision_s = said.decision_s(),
                           .speeding_up_mps2 = said.speeding_up_mps2(),
                           .target_speed_share = said.target_speed_share(),
                           .first_crossing_s = said.first_crossing_s(),
                           .tail_s = said.tail_s(),
                           .gap_s = said.gap_s(),
                           .max_red_s = said.max_red_s()};
  }
  if (from.has_max_pressure()) {
    parameters.max_pressure = {.staging = staging_of(from.max_pressure().stages()),
                               .distance_m = from.max_pressure().distance_m(),
                               .decision_s = from.max_pressure().decision_s(),
                               .hysteresis_veh = from.max_pressure().hysteresis_veh()};
  }
  if (from.has_eco()) {
    parameters.eco = {
        .approach = approach_of(from.eco(), acceleration_max_mps2), .queue = queue_of(from.eco()), .end_speed_mps = {}};
    if (from.eco().end_speed_kmh() > 0.0) parameters.eco.end_speed_mps = from.eco().end_speed_kmh() / 3.6;
  }
  if (from.has_glosa()) parameters.glosa.approach = approach_of(from.glosa(), acceleration_max_mps2);
  if (from.has_glosa_queue()) {
    parameters.glosa_queue = {.approach = approach_of(from.glosa_queue(), acceleration_max_mps2),
                              .queue = queue_of(from.glosa_queue())};
  }
  if (from.has_platoon()) {
    parameters.platoon = {.approach = approach_of(from.platoon(), acceleration_max_mps2),
                          .queue = queue_of(from.platoon()),
                          .gap_s = from.platoon().gap_s(),
                          .end_speed_mps = from.platoon().end_speed_kmh() / 3.6};
  }
  if (from.has_speed_harmonisation()) {
    const scenario::SpeedHarmonisation& said = from.speed_harmonisation();
    parameters.speed_harmonisation = {.approach = approach_of(said, acceleration_max_mps2),
                                      .queue = queue_of(said),
                                      .speed_change_mps2 = said.speed_change_kmh_per_s() / 3.6};
  }
  return parameters;
}

}  // namespace

MapView map_view(const RsuConfig& config) {
  return {.speed_limit_mps = config.speed_limit_mps, .approach_length_m = config.road.approach_m};
}

Expected<RsuConfig> rsu_config(const scenario::Scenario& scenario, std::uint32_t rsu) {
  if (static_cast<std::int64_t>(rsu) >= scenario.rsus_size()) {
    return Error{"rsus", "there is no RSU number " + std::to_string(rsu) + ": the scenario has " +
                             std::to_string(scenario.rsus_size())};
  }
  const scenario::Rsu& from = scenario.rsus(static_cast<int>(rsu));
  RsuConfig config;
  config.rsu = rsu;
  config.station_id = kFirstStationId + rsu;
  config.road = {.approach_m = scenario.traffic().approach_length_m(), .exit_m = scenario.traffic().exit_length_m()};
  config.speed_limit_mps = scenario.vehicles().speed_limit_kmh() / 3.6;
  config.acceleration_max_mps2 = scenario.vehicles().acceleration_max_mps2();
  config.radio = scenario::radio_parameters(scenario);
  config.signal_promise = static_cast<Step>(scenario.run().signal_promise_steps());
  config.actuation = scenario::actuation(scenario);
  config.algorithm = from.algorithm();
  config.computing.measured = from.computing().mode() == scenario::Computing::REAL;
  if (from.computing().mode() == scenario::Computing::DECLARED) {
    config.computing.declared_ms = from.computing().declared_ms();
  }
  config.parameters = parameters_of(from, config.acceleration_max_mps2);
  for (const scenario::Sensor& sensor : from.sensors()) {
    config.sensors.push_back(
        {.radar = sensor.kind() == scenario::Sensor::RADAR, .accuracy_m = sensor.position_noise_m()});
  }
  return config;
}

}  // namespace lukou
