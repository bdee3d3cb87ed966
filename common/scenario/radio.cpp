#include "common/scenario/radio.hpp"

#include "scenario.pb.h"

namespace lukou::scenario {
namespace {

LatencyModel latency_model(const Latency& from) {
  if (from.has_uniform()) {
    return {.law = LatencyModel::Law::kUniform, .min_ms = from.uniform().min_ms(), .max_ms = from.uniform().max_ms()};
  }
  if (from.has_gamma()) {
    return {.law = LatencyModel::Law::kGamma, .min_ms = from.gamma().min_ms(), .mean_ms = from.gamma().mean_ms()};
  }
  return {.law = LatencyModel::Law::kConstant, .min_ms = from.constant_ms()};
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
  return model;
}

}  // namespace

RadioParameters radio_parameters(const Scenario& scenario) {
  const Radio& radio = scenario.radio();
  RadioParameters parameters;
  parameters.seed = scenario.run().seed();
  parameters.modelled = radio.has_uplink() || radio.has_downlink();
  if (radio.has_uplink()) parameters.uplink = link_model(radio.uplink());
  if (radio.has_downlink()) parameters.downlink = link_model(radio.downlink());
  return parameters;
}

}  // namespace lukou::scenario
