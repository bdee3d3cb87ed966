#include "services/rsu/rsu_config.hpp"

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

}  // namespace

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
  config.algorithm = from.algorithm();
  // An RSU with another algorithm says nothing of this one: then its parameters stay at their defaults.
  config.parameters.arrive_on_green.acceleration_max_mps2 = scenario.vehicles().acceleration_max_mps2();
  if (from.has_arrive_on_green()) {
    config.parameters.arrive_on_green =
        arrive_on_green_of(from.arrive_on_green(), scenario.vehicles().acceleration_max_mps2());
  }
  for (const scenario::Sensor& sensor : from.sensors()) {
    config.sensors.push_back(
        {.radar = sensor.kind() == scenario::Sensor::RADAR, .accuracy_m = sensor.position_noise_m()});
  }
  return config;
}

}  // namespace lukou
