#pragma once

#include <gtest/gtest.h>

#include <optional>

#include "common/messages/rsc.hpp"
#include "common/messages/time_marks.hpp"
#include "services/traffic_engine/engine_node.hpp"

namespace lukou {

/// One equipped car without noise that drives straight on at 15 m/s.
inline EngineConfig lone_car_from_the_west() {
  EngineConfig config;
  config.traffic.vehicles.actuation_noise_mps2 = 0.0;
  config.traffic.driving.desired_speed_deviation = 0.0;
  config.traffic.equipped_ratio = 1.0;
  for (auto& demand : config.traffic.demand) demand.flows.clear();
  auto& west = config.traffic.demand[index(Approach::kWest)];
  west.listed = true;
  west.arrivals_s = {0.05};
  west.lane_weights = {0.0, 1.0, 0.0};
  return config;
}

/// A node whose lights are green for ever and that hears one RSU.
class Drive {
 public:
  explicit Drive(const EngineConfig& config) : node_(config) {}

  void step(const RoadsideBatch* roadside = nullptr) {
    SignalBatch signal;
    signal.step = signal.first = next_;
    signal.heads.assign(kLanes, static_cast<std::uint8_t>(Aspect::kGreen));
    const auto done = node_.step(next_++, &signal, {&roadside, 1}, traffic_, air_);
    ASSERT_TRUE(done) << done.error().text();
  }
  void run_to(Step step_number) {
    while (next_ <= step_number) step();
  }
  [[nodiscard]] Step now() const { return next_ - 1; }
  [[nodiscard]] const TrafficBatch& traffic() const { return traffic_; }
  [[nodiscard]] const AirBatch& air() const { return air_; }
  [[nodiscard]] EngineNode& node() { return node_; }

 private:
  EngineNode node_;
  TrafficBatch traffic_;
  AirBatch air_;
  Step next_ = 0;
};

/// An RSU's batch of one advice.
inline RoadsideBatch guidance(Step step, std::uint64_t target, std::optional<double> acceleration_mps2,
                              std::uint32_t lifetime_ms = 500) {
  RoadsideBatch batch;
  batch.rsu = 2;
  batch.epoch = 7;
  batch.step = step;
  Coordination message;
  message.rsu = 99;
  message.second_mark_ms = second_mark_ms(step);
  VehicleCoordination asked;
  asked.vehicle = target;
  if (acceleration_mps2) asked.path = GuidedPath{{}, *acceleration_mps2, lifetime_ms};
  message.vehicles.push_back(asked);
  append(batch.frames, {.sender = 99, .sequence = 41}, message);
  return batch;
}

}  // namespace lukou
