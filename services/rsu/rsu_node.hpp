#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "common/bus/batches.hpp"
#include "common/messages/map.hpp"
#include "common/messages/rsc.hpp"
#include "common/messages/rsm.hpp"
#include "common/messages/spat.hpp"
#include "common/radio/channel_load.hpp"
#include "common/radio/inbox.hpp"
#include "common/radio/modem.hpp"
#include "common/radio/station_speed.hpp"
#include "services/rsu/model/heard_cars.hpp"
#include "services/rsu/model/sensed_cars.hpp"
#include "services/rsu/model/signal_view.hpp"
#include "services/rsu/rsu_config.hpp"
#include "services/rsu/sdk/rsu_algorithm.hpp"

namespace lukou {

/// One RSU: hears the air of a step, looks through its sensors, lets its algorithm think, and says SPAT (each step),
/// MAP (each second), guidance, and RSM if it sees anything.
class RsuNode {
 public:
  /// Requires an algorithm.
  RsuNode(RsuConfig config, std::unique_ptr<RsuAlgorithm> algorithm);

  /// Where the node reads the wall clock [s] if its computing time is to be measured; without one it counts as 0.
  void measure_with(std::function<double()> wall_s) { wall_s_ = std::move(wall_s); }
  /// The scenario after the directives of the next step: takes over the radio and how good its
  /// sensors are, nothing else.
  void change(const RsuConfig& config);
  /// The step function. `new_signal` is the controller's batch if there is a new one, otherwise null: then what it
  /// promised before stands. `out` is overwritten, all but its epoch.
  /// Requires steps one after the other, air of the same step with well-formed columns, and a promise that covers it:
  /// the lockstep has checked them.
  void step(Step k, const SignalBatch* new_signal, const AirBatch& air, RoadsideBatch& out);
  /// What the last step asks of the signal controller, its epoch excepted; nothing if the plan is fixed.
  [[nodiscard]] const RequestBatch& request() const { return request_; }

 private:
  /// A frame on its way to this RSU.
  struct Underway {
    std::uint8_t kind = 0;  ///< FrameKind
    std::vector<std::uint8_t> payload;
  };

  /// A request that is still being computed.
  struct HeldRequest {
    Step due = 0;
    SignalRequest request;
  };

  void hear(Step k, const AirBatch& air, RoadsideBatch& out);
  void receive(const AirBatch& air, FrameFates& fates);
  void understand(Step k, std::uint8_t kind, std::span<const std::uint8_t> payload, RoadsideBatch& out);
  void look(Step k, const SensedColumns& sensed);
  void think(Step k);
  void ask_for_green(Step k, RoadsideBatch& out);
  /// Lets the algorithm answer; returns by how much that delays the answer [ms].
  std::uint32_t answer();
  void say_spat(Step k, Frames& frames);
  void say_map(Step k, Frames& frames);
  void say_guidance(Step k, RoadsideBatch& out);
  void send_guidance(Frames& frames);
  void say_sensed(Frames& frames);
  void send_sensed(Frames& frames);
  [[nodiscard]] Envelope next_envelope();
  [[nodiscard]] std::uint8_t next_count(FrameKind kind);

  RsuConfig config_;
  std::unique_ptr<RsuAlgorithm> algorithm_;
  std::function<double()> wall_s_;
  Modem modem_;
  ChannelLoad load_;
  StationSpeed speeds_;            ///< of the cars, if the latency asks for them
  std::uint32_t frames_sent_ = 0;  ///< in the step before
  Step next_ = 0;                  ///< the step after the last one
  Inbox<Underway> inbox_;          ///< stays empty under the ideal radio
  ReceptionTally tally_;           ///< of this step
  HeardCars cars_;
  SensedCars sensed_;
  SignalView signals_;
  RsuView view_;
  RsuAnswer answer_;
  std::deque<HeldRequest> held_requests_;
  RequestBatch request_;
  MapData map_;
  Spat spat_;
  Coordination guidance_;
  RoadsideSafety safety_;
  std::uint32_t next_sequence_ = 0;
  std::array<std::uint8_t, 6> next_count_{};  ///< by FrameKind
};

}  // namespace lukou
