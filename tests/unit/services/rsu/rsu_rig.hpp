#pragma once

#include <functional>
#include <memory>
#include <utility>

#include "common/core/math.hpp"
#include "common/messages/bsm.hpp"
#include "common/messages/time_marks.hpp"
#include "services/rsu/rsu_node.hpp"

namespace lukou {

/// Steps that a batch of signals() speaks of.
inline constexpr Step kPromised = 11;

/// An algorithm that does what the test says.
class Scripted final : public RsuAlgorithm {
 public:
  using Script = std::function<void(const RsuView&, RsuAnswer&)>;
  explicit Scripted(Script script) : script_(std::move(script)) {}
  void on_step(const RsuView& heard, RsuAnswer& answer) override { script_(heard, answer); }

 private:
  Script script_;
};

inline RsuConfig config() {
  RsuConfig config;
  config.station_id = 900;
  config.road = {.approach_m = 500.0, .exit_m = 100.0};
  config.speed_limit_mps = 60.0 / 3.6;
  return config;
}

inline RsuNode node_with(Scripted::Script script) { return {config(), std::make_unique<Scripted>(std::move(script))}; }
inline RsuNode idle_node() {
  return node_with([](const RsuView&, RsuAnswer&) {});
}

/// The controller's batch for the steps first ... first + 10 of the paper's plan, with changes for three cycles.
inline SignalBatch signals(Step first) {
  const SignalPlan plan = paper_plan();
  SignalBatch batch;
  batch.first = first;
  for (Step step = first; step < first + kPromised; ++step) {
    for (std::uint8_t lane = 0; lane < kLanes; ++lane) {
      batch.heads.push_back(static_cast<std::uint8_t>(aspect_at(plan, static_cast<Lane>(lane), step)));
    }
  }
  for (std::uint8_t lane = 0; lane < kLanes; ++lane) {
    for (Step step = next_change(plan, static_cast<Lane>(lane), first); step < first + 3 * plan.cycle;
         step = next_change(plan, static_cast<Lane>(lane), step)) {
      batch.change_lane.push_back(lane);
      batch.change_aspect.push_back(static_cast<std::uint8_t>(aspect_at(plan, static_cast<Lane>(lane), step)));
      batch.change_step.push_back(step);
    }
  }
  return batch;
}

/// A BSM of a car on WC, `distance_m` before the line.
inline void add_car(AirBatch& air, std::uint64_t id, double distance_m, double speed_mps) {
  BasicSafety message;
  message.temporary_id = id;
  message.second_mark_ms = second_mark_ms(air.step);
  message.centre = centre_of_car({-15.5 - distance_m, -5.25}, math::kPi / 2, 4.5);
  message.speed_mps = speed_mps;
  message.heading_rad = math::kPi / 2;
  message.acceleration_mps2 = 0.5;
  message.length_m = 4.5;
  append(air.frames, {.sender = id, .sequence = 0, .antenna_x_m = message.centre.x_m, .antenna_y_m = -5.25}, message);
}

}  // namespace lukou
