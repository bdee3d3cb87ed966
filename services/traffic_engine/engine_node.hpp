#pragma once

#include <span>
#include <vector>

#include "common/bus/batches.hpp"
#include "common/core/expected.hpp"
#include "common/intersection/signal_promise.hpp"
#include "common/radio/modem.hpp"
#include "services/traffic_engine/engine_config.hpp"
#include "services/traffic_engine/model/engine.hpp"

namespace lukou {

/// The traffic engine's step function, with the on-board units of all cars.
class EngineNode {
 public:
  explicit EngineNode(const EngineConfig& config);

  /// The scenario after the directives of the next step: takes over flows and the equipped ratio, nothing else.
  void change(const EngineConfig& config);
  /// Executes step k. `new_signal` is the controller's newest batch if one came, `roadside` each RSU's batch of step
  /// k - 1 (nullptr = silent). Fills `traffic` and `air`. Fails if the controller's promise does not hold the heads of
  /// step k - 1. Requires the steps 0, 1, 2, ... in order.
  Expected<Done> step(Step k, const SignalBatch* new_signal, std::span<const RoadsideBatch* const> roadside,
                      TrafficBatch& traffic, AirBatch& air);

 private:
  struct Undecodable {
    std::uint32_t rsu = 0;
    std::uint32_t sequence = 0;
  };

  void hear(const RoadsideBatch& batch);
  void hear_coordination(const RoadsideBatch& batch, std::size_t frame);
  void report_undecodable(TrafficBatch& traffic) const;
  void speak(Step k, Frames& frames) const;

  EngineConfig config_;  ///< as it is in force
  traffic::Engine engine_;
  SignalPromise promise_;
  /// Stands for the units of all cars, since the ideal radio treats every place alike.
  Modem modem_;
  std::vector<traffic::Advice> advice_;   ///< heard in this step
  std::vector<Undecodable> undecodable_;  ///< frames heard in this step
};

}  // namespace lukou
