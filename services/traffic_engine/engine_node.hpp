#pragma once

#include <map>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "common/bus/batches.hpp"
#include "common/core/directive.hpp"
#include "common/core/expected.hpp"
#include "common/intersection/signal_promise.hpp"
#include "common/messages/rsc.hpp"
#include "common/radio/between_cars.hpp"
#include "common/radio/channel_load.hpp"
#include "common/radio/inbox.hpp"
#include "common/radio/modem.hpp"
#include "services/traffic_engine/engine_config.hpp"
#include "services/traffic_engine/model/engine.hpp"
#include "services/traffic_engine/model/roadside_sensors.hpp"
#include "services/traffic_engine/model/unit_errors.hpp"

namespace lukou {

/// The traffic engine's step function, with the on-board units of all cars.
class EngineNode {
 public:
  explicit EngineNode(const EngineConfig& config);

  /// The scenario after the directives of the next step: takes over flows, the equipped ratio, the radio,
  /// the errors of on-board units and those of roadside sensors.
  void change(const EngineConfig& config);
  /// From now on measured computing times are those of an earlier run, whatever the RSUs say.
  void replay(const std::vector<ComputingDelay>& computed);
  /// Executes step k. `new_signal` is the controller's newest batch if one came, `roadside` each RSU's batch of step
  /// k - 1 (nullptr = silent). Fills `traffic` and `air`. Fails if the controller's promise does not hold the heads of
  /// step k - 1. Requires the steps 0, 1, 2, ... in order.
  Expected<Done> step(Step k, const SignalBatch* new_signal, std::span<const RoadsideBatch* const> roadside,
                      TrafficBatch& traffic, AirBatch& air);

 private:
  /// The end of an advice that no on-board unit decides on.
  struct Fate {
    std::uint32_t vehicle = 0;
    std::uint32_t rsu = 0;
    std::uint32_t sequence = 0;
    AdviceFate fate{};
    Step issued = -1;
    double commanded_mps2 = 0.0;
    traffic::AdviceKind kind = traffic::AdviceKind::kAcceleration;
    double speed_mps = traffic::kNoSpeed;
  };
  /// That a car hears an RSU, whatever it says.
  struct Hearing {
    std::uint64_t target = 0;
    std::uint32_t rsu = 0;
  };

  /// By how much an RSU's answer is delayed [ms].
  [[nodiscard]] std::uint32_t computing_ms(const RoadsideBatch& batch) const;
  void hear(const RoadsideBatch& batch);
  /// Lets units whose advice outlives a silence of its RSU hear that it speaks.
  void hear_spat(const RoadsideBatch& batch, std::size_t frame);
  [[nodiscard]] Hop hop_to(Lane lane, const traffic::Car& car, const RoadsideBatch& batch, std::size_t frame);
  void hear_coordination(const RoadsideBatch& batch, std::size_t frame);
  /// A speed for a lane is for every car with a unit that is before its line.
  void say_on_lane(const LaneSpeed& word, traffic::Advice advice, const RoadsideBatch& batch, std::size_t frame);
  /// Hands an advice to the radio, or to the engine at once.
  void pass_on(traffic::Advice&& advice, const RoadsideBatch& batch, std::size_t frame);
  /// Under the ideal radio an advice that its RSU computed for a while is under way for as long.
  void delay(const traffic::Advice& advice, const RoadsideBatch& batch, std::size_t frame);
  void send(const traffic::Advice& advice, const RoadsideBatch& batch, std::size_t frame);
  [[nodiscard]] static Fate fate_of(const traffic::Advice& advice, std::uint32_t vehicle, AdviceFate fate);
  /// Takes the advice that has reached its car by `now`.
  void deliver(Step now);
  void report_fates(TrafficBatch& traffic) const;
  void report_reception(std::span<const RoadsideBatch* const> roadside, TrafficBatch& traffic) const;
  /// What an RSU heard of the frames that cars sent in the step before.
  Expected<Done> report_uplink(const RoadsideBatch& batch, TrafficBatch& traffic) const;
  /// What a full run log holds of this step beside the cars.
  static void report_frames(std::span<const RoadsideBatch* const> roadside, const AirBatch& air, TrafficBatch& traffic);

  EngineConfig config_;  ///< as it is in force
  traffic::Engine engine_;
  SignalPromise promise_;
  Modem modem_;       ///< of the units of all cars
  ChannelLoad load_;  ///< what the channel carries
  BetweenCars between_cars_;
  traffic::UnitErrors unit_errors_;
  traffic::RoadsideSensors sensors_;
  std::vector<std::uint32_t> speakers_;  ///< vehicles whose units sent a frame in the last step, in the frames' order
  Step next_ = 0;                        ///< the step after the last one
  Inbox<traffic::Advice> inbox_;         ///< stays empty under the ideal radio if the RSUs' time is free
  Inbox<Hearing> spats_;                 ///< likewise
  ReceptionTally tally_;                 ///< of this step
  std::vector<traffic::Advice> advice_;  ///< heard in this step
  std::vector<Fate> fates_;              ///< that became known in this step
  std::optional<std::map<std::pair<Step, std::uint32_t>, std::uint32_t>> replayed_;  ///< [ms] by step and RSU
};

}  // namespace lukou
