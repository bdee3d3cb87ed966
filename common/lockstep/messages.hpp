#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "common/core/directive.hpp"
#include "common/core/step.hpp"
#include "common/lockstep/roster.hpp"

namespace lukou {

/// Version of the step protocol and of idl/bus.idl; members with another are refused.
inline constexpr std::uint32_t kProtocolVersion = 1;

/// One process start; random, so that a restarted process is somebody else.
using Incarnation = std::uint64_t;

/// From the clock to the members: one ordered stream, checked by `sequence`.
struct Control {
  enum class Kind : std::uint8_t {
    kWelcome = 1,  ///< to one: you are in, with epoch and scenario
    kRefuse = 2,   ///< to one: why not
    kRoster = 3,   ///< who takes part; answer with Sees once every endpoint is matched
    kGrant = 4,    ///< you may execute steps through `through`; `last` = no step follows it
    kFence = 5,    ///< the RSU `rsu` of `epoch` is gone: cut its edge at what is in hand, answer with Receipt
    kEnded = 6,    ///< the run is over and recorded: leave
    kAbort = 7,    ///< the run ends unfinished; `text` says why, `culprit` who
    kReply = 8,    ///< to one: the answer to its request
  };
  Kind kind = Kind::kGrant;
  Incarnation clock = 0;  ///< the sender
  std::uint64_t sequence = 0;
  Incarnation to = 0;        ///< 0 = everybody
  std::uint32_t epoch = 0;   ///< Welcome, Fence
  std::uint32_t rsu = 0;     ///< Fence
  Step through = -1;         ///< Grant
  bool last = false;         ///< Grant
  bool ok = true;            ///< Reply
  std::uint64_t number = 0;  ///< Reply: of the request that it answers
  std::uint32_t roster_version = 0;
  std::vector<Incarnation> roster_incarnation;  ///< Roster; parallel to roster_role
  std::vector<std::string> roster_role;
  /// Grant: new ones; Welcome, Reply to `scenario`: all that grants have said so far; parallel to directive_set.
  std::vector<Step> directive_step;
  std::vector<std::string> directive_set;
  std::vector<std::uint32_t> attach_rsu;  ///< Grant: RSUs that take part again; three parallel arrays
  std::vector<std::uint32_t> attach_epoch;
  std::vector<Step> attach_from;
  std::string text;     ///< Refuse, Abort, Reply; Welcome, Reply to `scenario`: the resolved scenario; last Grant: "",
                        ///< "stopped", "interrupted"
  std::string culprit;  ///< Abort: role
};

/// From everybody to the clock.
struct Up {
  enum class Kind : std::uint8_t {
    kJoin = 1,  ///< role, protocol, hash (may be empty)
    kSees = 2,  ///< number = roster version whose members are all matched
    kProgress =
        3,        ///< step = last one executed; text = whom it waits for ("" = nobody); number = foreign samples so far
    kCredit = 4,  ///< recorder: step = last one committed
    kReceipt = 5,  ///< number = RSU, step = first step not heard of it
    kRequest = 6,  ///< operator: text = verb and argument; number = its requests so far, repeated until answered
    kClosed = 7,   ///< recorder: the record is safe; step = complete to; text = anomaly, "" if none
    kLeave = 8,    ///< number = foreign samples
    kLost = 9,  ///< launcher: the child with this role has ended; member: the role, its own perhaps, is of no use any
                ///< more; text = how, why
  };
  Kind kind = Kind::kProgress;
  Incarnation incarnation = 0;
  std::string role;  ///< of the sender; Lost: of the lost one
  std::uint32_t protocol = kProtocolVersion;
  std::uint64_t number = 0;
  Step step = -1;
  std::string text;
  std::string hash;  ///< Join: sha256 of the scenario the member was built for; "" = takes the clock's
};

enum class RunPhase : std::uint8_t { kForming = 0, kRunning = 1, kPaused = 2, kEnding = 3, kEnded = 4, kAborted = 5 };
std::string_view name(RunPhase phase);

/// From the clock to observers, on change and a few times a second.
struct RunState {
  std::string run;
  RunPhase phase = RunPhase::kForming;
  Step granted = -1;
  Step recorded = -1;
  Step end = 0;                       ///< last step that the run plans
  double pace = 0.0;                  ///< asked, simulated seconds per second; 0 = as fast as possible
  std::string text;                   ///< kForming: who is missing; kAborted: why
  std::string culprit;                ///< kAborted: role
  Incarnation recorder = 0;           ///< whose pictures are the run's; 0: none has joined yet
  std::uint64_t foreign_samples = 0;  ///< what members have ignored because nobody of the run had sent it
};

/// Running figures of groups of cars; each column has three entries: all cars, the equipped ones, the others. All count
/// from step 0 on, warm-up included; docs/topics.md defines each.
struct FigureColumns {
  std::vector<std::uint32_t> arrived;
  std::vector<std::uint32_t> waiting;  ///< arrived, not yet on the road
  std::vector<std::uint32_t> in_system;
  std::vector<std::uint32_t> left;
  std::vector<std::uint32_t> standing;
  std::vector<std::uint32_t> stops;
  std::vector<double> throughput_veh_per_h;  ///< of the last minute
  std::vector<double> stops_per_vehicle;     ///< not a number: no car yet, as the next but one and the last
  std::vector<double> stop_time_s;
  std::vector<double> mean_stop_time_s;
  std::vector<double> mean_delay_s;
};

/// From the recorder to observers, at most 30 times a second of wall time.
struct View {
  Step step = 0;
  FigureColumns figures;
  std::vector<std::uint32_t> queue;        ///< per lane (12): cars that stand
  std::vector<std::uint32_t> arrived;      ///< per approach (4): since step 0
  std::vector<std::uint32_t> waiting;      ///< per approach (4): arrived, not yet on the road
  std::vector<std::uint32_t> heard_epoch;  ///< per RSU: the epoch that the engine heard in this step, 0 = silent
  // Every car on the road, lane after lane, front to back: columns of TrafficBatch and what is measured of each.
  std::vector<std::uint32_t> vehicle;
  std::vector<std::uint8_t> lane;
  std::vector<std::uint8_t> state;
  std::vector<std::uint8_t> equipped;
  std::vector<double> position_m;
  std::vector<double> speed_mps;
  std::vector<double> acceleration_mps2;
  std::vector<double> commanded_mps2;
  std::vector<std::uint8_t> guidance;
  std::vector<std::uint8_t> bound_by;
  std::vector<std::uint8_t> missed;
  std::vector<std::uint32_t> standing_steps;  ///< so far, before the stop line
  std::vector<Step> advice_step;              ///< when the newest advice that reached it was issued; -1 = none has
  // The heads of the twelve lanes.
  std::vector<std::uint8_t> heads;        ///< Aspect
  std::vector<Step> change_step;          ///< next change; -1 = not known
  std::vector<std::uint8_t> next_aspect;  ///< Aspect after it; 0 = not known
  // The radio in the last full second, a row per direction and kind of frame; none under the ideal radio.
  std::vector<std::uint8_t> radio_direction;  ///< Direction
  std::vector<std::uint8_t> radio_kind;       ///< FrameKind
  std::vector<std::uint32_t> radio_sent;
  std::vector<std::uint32_t> radio_heard;
  std::vector<std::uint32_t>
      radio_lost;  ///< seven a row: random, burst, range, path loss, collision, half duplex, outage
  std::vector<double> radio_latency_ms;  ///< mean of what was heard; not a number: nothing was
  // Two more columns of the cars: what became of their messages to the roadside.
  std::vector<std::uint8_t> uplink;   ///< of its newest: 0 heard, 1 + LossCause lost; 255 = it has sent none
  std::vector<Step> heard_step;       ///< when the newest that an RSU has heard was sent; -1 = none was
  std::vector<std::uint32_t> advice;  ///< by AdviceFate (23): each since step 0, by its last fate

  /// Whether each group's columns have one length, and those of lanes, approaches and figures theirs.
  [[nodiscard]] bool well_formed() const;
};

}  // namespace lukou
