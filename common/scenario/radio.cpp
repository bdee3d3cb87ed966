#include "common/scenario/radio.hpp"

#include <cmath>
#include <optional>

#include "scenario.pb.h"

namespace lukou::scenario {
namespace {

LatencyModel latency_model(const Latency& from) {
  const bool per_reservation = from.redraw() == Redraw::RESERVATION;
  if (from.has_uniform()) {
    return {.law = LatencyModel::Law::kUniform,
            .min_ms = from.uniform().min_ms(),
            .max_ms = from.uniform().max_ms(),
            .per_reservation = per_reservation};
  }
  if (from.has_gamma()) {
    return {.law = LatencyModel::Law::kGamma,
            .min_ms = from.gamma().min_ms(),
            .mean_ms = from.gamma().mean_ms(),
            .per_reservation = per_reservation,
            .speed_factor = from.gamma().speed_factor()};
  }
  return {.law = LatencyModel::Law::kConstant, .min_ms = from.constant_ms()};
}

PathLossModel path_loss_model(const PathLoss& from) {
  return {.law = from.law() == PathLoss::WINNER_B1 ? PathLossModel::Law::kWinnerB1 : PathLossModel::Law::kTr37885,
          .power_dbm = from.power_dbm(),
          .antenna_gain_dbi = from.antenna_gain_dbi(),
          .sensitivity_dbm = from.sensitivity_dbm(),
          .antenna_height_m = from.antenna_height_m()};
}

LoadModel load_model(const Radio& radio) {
  LoadModel model;
  if (!radio.has_load()) return model;
  const Load& from = radio.load();
  const Link& between = radio.vehicle_to_vehicle().has_path_loss() ? radio.vehicle_to_vehicle() : radio.uplink();
  return {.counted = true,
          .sub_channels = from.sub_channels(),
          .bytes_per_sub_channel = from.bytes_per_sub_channel(),
          .security_bytes = from.security_bytes(),
          .sir_threshold_db = from.sir_threshold_db(),
          .path_loss = path_loss_model(between.path_loss())};
}

std::optional<Arm> arm_of(Outage::Arm from) {
  switch (from) {
    case Outage::WEST:
      return Arm::kWest;
    case Outage::SOUTH:
      return Arm::kSouth;
    case Outage::EAST:
      return Arm::kEast;
    case Outage::NORTH:
      return Arm::kNorth;
    default:
      return std::nullopt;
  }
}

lukou::Outage outage_of(const Outage& from) {
  lukou::Outage outage{.from = std::llround(from.from_s() * kStepsPerSecond),
                       .to = std::llround(from.to_s() * kStepsPerSecond),
                       .uplink = from.direction() != Outage::DOWNLINK,
                       .downlink = from.direction() != Outage::UPLINK,
                       .rsu = {},
                       .arm = arm_of(from.approach()),
                       .area = {}};
  if (from.has_rsu()) outage.rsu = from.rsu();
  if (from.has_area()) {
    outage.area = {.x_min_m = from.area().x_min_m(),
                   .x_max_m = from.area().x_max_m(),
                   .y_min_m = from.area().y_min_m(),
                   .y_max_m = from.area().y_max_m()};
  }
  return outage;
}

LinkModel link_model(const Link& from) {
  LinkModel model;
  model.latency = latency_model(from.latency());
  model.loss_rate = from.loss().rate();
  if (from.loss().has_burst()) {
    model.burst_rate = from.loss().burst().rate();
    model.burst_mean_length = from.loss().burst().mean_length();
  }
  if (from.has_range_m()) model.range_m = from.range_m();
  model.duplicate_rate = from.duplicate_rate();
  if (from.has_path_loss()) model.path_loss = path_loss_model(from.path_loss());
  model.half_duplex = from.half_duplex();
  model.collisions = from.collisions();
  return model;
}

}  // namespace

RadioParameters radio_parameters(const Scenario& scenario) {
  const Radio& radio = scenario.radio();
  RadioParameters parameters;
  parameters.seed = scenario.run().seed();
  parameters.modelled = radio.has_uplink() || radio.has_downlink() || radio.has_vehicle_to_vehicle() ||
                        radio.has_load() || radio.outages_size() > 0;
  if (radio.has_uplink()) parameters.uplink = link_model(radio.uplink());
  if (radio.has_downlink()) parameters.downlink = link_model(radio.downlink());
  if (radio.has_vehicle_to_vehicle()) {
    parameters.vehicle_to_vehicle = link_model(radio.vehicle_to_vehicle());
    parameters.awareness_m = radio.awareness_m();
  }
  parameters.keep_probability = radio.reservation().keep_probability();
  parameters.load = load_model(radio);
  for (const Outage& outage : radio.outages()) parameters.outages.push_back(outage_of(outage));
  return parameters;
}

}  // namespace lukou::scenario
