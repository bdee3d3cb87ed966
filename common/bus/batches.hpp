#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "common/core/step.hpp"
#include "common/messages/frames.hpp"
#include "common/radio/frame_fates.hpp"
#include "common/radio/reception_report.hpp"

// What crosses the bus in every step, as plain structures of arrays; idl/bus.idl is the same contract for DDS.
// One batch per producer, topic and step, empty or not. All arrays of a group have the same length.

namespace lukou {

/// How long a sensor takes a vehicle to be; the values stand on the bus. Limits assumed.
enum class LengthClass : std::uint8_t { kShort = 1, kMedium = 2, kLong = 3 };  ///< below 6 m, to 12 m, longer

/// What the roadside sensors report, a row per detection. It comes over a wire, not over the radio. A row knows no
/// vehicle, unit or lane; it is in the order of RSU, sensor, step, track.
struct SensedColumns {
  std::vector<std::uint32_t> rsu;     ///< whose sensor: index in the scenario's list
  std::vector<std::uint32_t> sensor;  ///< index in that RSU's list
  std::vector<std::uint32_t> track;   ///< drawn; the same as long as this sensor follows this car
  std::vector<double> x_m;            ///< centre of the car's front, with the sensor's error
  std::vector<double> y_m;
  std::vector<double> speed_mps;           ///< with the sensor's error, >= 0
  std::vector<double> heading_rad;         ///< clockwise from north; that of the approach
  std::vector<std::uint8_t> length_class;  ///< LengthClass
  std::vector<Step> measured;              ///< the step whose instant it tells of

  [[nodiscard]] std::size_t size() const { return rsu.size(); }
  /// Whether all columns have the same length.
  [[nodiscard]] bool well_formed() const;
  void clear();
};

/// Engine to RSUs: what the vehicles sent at t_step, and what roadside sensors delivered then.
struct AirBatch {
  Step step = 0;
  Frames frames;
  SensedColumns sensed;
};

/// RSU to engine and signal controller: what the roadside sent at t_step.
struct RoadsideBatch {
  std::uint32_t rsu = 0;    ///< index in the scenario's list
  std::uint32_t epoch = 1;  ///< counts the RSU's starts in this run
  Step step = 0;
  Frames frames;
  std::uint32_t frames_heard = 0;       ///< frames that reached the RSU in this step, duplicates not counted
  std::uint32_t frames_malformed = 0;   ///< heard, but not decodable: dropped
  std::uint32_t answers_malformed = 0;  ///< the algorithm's advice that no message can carry: refused, not sent
  ReceptionReport reception;            ///< uplink; empty under the ideal radio
  std::uint32_t requests_refused = 0;   ///< requests for greens that nobody takes: the plan is fixed
  std::uint32_t computing_ms = 0;       ///< delays whatever the algorithm answered in this step; 0 if its time is free
  FrameFates uplink;                    ///< of each frame in the air of this step; empty under the ideal radio
  // The request of the RequestBatch of this step, for the record; none or one.
  std::vector<std::uint16_t> request_lanes;
  std::vector<Step> request_lifetime;
};

/// RSU to signal controller: the greens that it asks for at t_step. Only in a run with signals.actuation.
struct RequestBatch {
  std::uint32_t rsu = 0;
  std::uint32_t epoch = 1;
  Step step = 0;
  std::vector<std::uint16_t> lanes;  ///< bit n = lane n in the order WL ... NR; no request or one
  std::vector<Step> lifetime;        ///< steps from `step` on
};

/// Controller to engine and RSUs. The batch of controller step k promises the heads through step k + P.
struct SignalBatch {
  Step step = 0;
  Step first = 0;                           ///< first step that `heads` speaks of
  std::vector<std::uint8_t> heads;          ///< Aspect, (steps x 12) row-major, lanes in the order WL ... NR
  std::vector<std::uint8_t> change_lane;    ///< forecast: changes of the heads from `first` on under the running plan,
  std::vector<std::uint8_t> change_aspect;  ///<   by lane, then by time; at least three cycles ahead
  std::vector<Step> change_step;

  // What became of the requests of RSUs, as the controller decided since its batch before; by step, then by RSU. A
  // request that stays in force has a further row whenever its outcome changes.
  std::vector<Step> request_step;   ///< of the controller that decided; its heads are those of request_step + P
  std::vector<Step> request_asked;  ///< the RSU's step of the request; names it together with the RSU
  std::vector<std::uint32_t> request_rsu;
  std::vector<std::uint16_t> request_lanes;   ///< bit n = lane n
  std::vector<std::uint8_t> request_outcome;  ///< RequestOutcome (common/intersection/actuation.hpp)
};

/// Where a car stands in the life of its lane; the values stand on the bus.
enum class CarState : std::uint8_t { kIn = 0, kBlock = 1, kCommitted = 2, kExit = 3 };

/// What became of an advice: see docs/topics.md. The values stand on the bus.
enum class AdviceFate : std::uint8_t {
  kApplied = 0,           ///< the wanted acceleration was the commanded one
  kChangedLimit = 1,      ///< used, but cut to the limit of acceleration or speed
  kChangedGuard = 2,      ///< used, but the collision or stop-line guard braked harder
  kChangedFollowing = 3,  ///< FOLLOWING: the following law asked for less
  kChangedRed = 4,        ///< FOLLOWING: braking for a light that is not green asked for less
  kPastStopLine = 5,      ///< refused: the car has crossed its stop line
  kExpired = 6,           ///< refused: it came in time, but its life ended before a step could use it
  kSuperseded = 7,        ///< refused: a newer advice for the car came before a step could use it
  kUnknownVehicle = 8,    ///< refused: nobody on the road has this temporary id
  kMalformed = 9,         ///< refused: undecodable, not a number, or out of the standard's range
  kOutOfLimit = 10,       ///< refused: beyond the limits of acceleration of every car, +-a_max
  kLostRandom = 11,       ///< its frame did not reach the car: lost by itself
  kLostBurst = 12,        ///< ... lost in a burst
  kLostRange = 13,        ///< ... the car was out of range
  kStale = 14,            ///< dropped: a word issued later had reached the car before
  kDuplicate = 15,        ///< dropped: the same frame had reached the car before
  kLostPathLoss = 16,     ///< its frame did not reach the car: too weak there
  kLostCollision = 17,    ///< ... another station sent in the same resource
  kLostHalfDuplex = 18,   ///< ... the car was sending itself
  kLostOutage = 19,       ///< ... a planned outage
  kNotComplied = 20,      ///< refused: the driver does not follow
  kChangedDriver = 21,    ///< used, but late or imperfectly: the driver is human
  kLate = 22,             ///< refused: it came after its life had ended
};
inline constexpr std::size_t kAdviceFates = 23;

/// What an advice asked for. The values stand on the bus.
enum class AdviceKind : std::uint8_t {
  kAcceleration = 0,  ///< an acceleration
  kProfile = 1,       ///< accelerations one after the other
  kSpeed = 2,         ///< a speed
  kLaneSpeed = 3,     ///< a speed for everybody on the lane: one advice for each car that it is for
};
inline constexpr std::size_t kAdviceKinds = 4;

/// Where a car stands with guidance. The values stand on the bus.
enum class GuidanceState : std::uint8_t {
  kNotEquipped = 0,   ///< has no on-board unit
  kNeverAdvised = 1,  ///< no advice has ever reached it in time
  kInForce = 2,       ///< the driver acts on an advice
  kReleased = 3,      ///< the newest word was a release
  kExpired = 4,       ///< the life of the last advice ended, no newer word came
  kRsuUnheard = 5,    ///< the unit gave the last advice up: it had heard nothing of its RSU for too long
  kNotComplied = 6,   ///< an advice is shown, but the driver does not follow
  kPastStopLine = 7,  ///< guidance does not apply any more
  kReacting = 8,      ///< an advice is shown, the driver will follow soon
};
inline constexpr std::size_t kGuidanceStates = 9;

/// What decided a car's acceleration in a step. The values stand on the bus.
enum class BoundBy : std::uint8_t {
  kOwnWish = 0,   ///< nothing hindered the driver
  kCarAhead = 1,  ///< braking for the car ahead
  kLight = 2,     ///< braking to stand before the line, or before the standing block there
  kAdvice = 3,    ///< the advice in force, as the driver took it
  kLimit = 4,     ///< a limit of acceleration or speed cut the advice in force
  kGuard = 5,     ///< the guard: the car ahead, or the stop line
  kBlock = 6,     ///< starts or stops with the block at the stop line, behind its first car
};

/// In TrafficBatch::missed: no word was missed.
inline constexpr std::uint8_t kNothingMissed = 255;

/// Engine to recorder: the truth at t_step, with what happened in (t_step-1, t_step].
struct TrafficBatch {
  Step step = 0;

  // Every car on the road, lane after lane (WL ... NR), front to back.
  std::vector<std::uint32_t> vehicle;  ///< 4 * n + approach, n = place among the approach's arrivals
  std::vector<std::uint8_t> lane;
  std::vector<std::uint8_t> state;     ///< CarState
  std::vector<std::uint8_t> equipped;  ///< 1 = has an on-board unit
  std::vector<double> position_m;      ///< front, along the lane's path
  std::vector<double> speed_mps;
  std::vector<double> acceleration_mps2;  ///< of the step that ended
  std::vector<double> commanded_mps2;     ///< the advice in force in that step, NaN if none
  std::vector<double> noise_mps2;         ///< actuation noise of that step
  std::vector<std::uint8_t> guidance;     ///< GuidanceState
  std::vector<std::uint8_t> bound_by;     ///< BoundBy
  std::vector<std::uint8_t>
      missed;  ///< AdviceFate of the newest word, if it was lost or late; kNothingMissed: it was not

  std::vector<std::uint32_t> arrived;           ///< per approach (4): arrivals since step 0
  std::vector<std::uint32_t> waiting;           ///< per approach (4): arrived, not yet on the road
  std::vector<std::uint32_t> arrived_equipped;  ///< of these, with an on-board unit
  std::vector<std::uint32_t> waiting_equipped;

  // Cars that came onto the road at t_step.
  std::vector<std::uint32_t> entered_vehicle;
  std::vector<std::uint8_t> entered_lane;
  std::vector<std::uint8_t> entered_equipped;
  std::vector<double> entered_speed_mps;
  std::vector<double> entered_desired_speed_mps;

  // Cars whose front crossed the stop line.
  std::vector<std::uint32_t> crossed_vehicle;
  std::vector<double> crossed_time_s;           ///< interpolated
  std::vector<std::uint8_t> crossed_aspect;     ///< what the head showed
  std::vector<std::uint8_t> crossed_committed;  ///< 1 = could not have stopped when the green ended

  // Cars whose front left the end of the exit.
  std::vector<std::uint32_t> left_vehicle;
  std::vector<double> left_time_s;  ///< interpolated

  // Fates of advice, as they became known. An advice may first be applied and be changed in a later step of its life:
  // then a second row says so with `fate_again` = 1.
  std::vector<std::uint32_t> fate_vehicle;  ///< 4294967295 = unknown
  std::vector<std::uint32_t> fate_rsu;
  std::vector<std::uint32_t> fate_sequence;  ///< of the frame
  std::vector<std::uint8_t> fate;            ///< AdviceFate
  std::vector<std::uint8_t> fate_again;
  std::vector<Step> fate_issued;            ///< -1 = not decodable
  std::vector<double> fate_commanded_mps2;  ///< as decoded; NaN if it was not

  std::uint32_t answers_malformed = 0;     ///< advice that the RSUs' algorithms gave and no message could carry
  std::uint32_t guard_interventions = 0;   ///< cars that the guard braked in this step
  std::uint8_t overflow = 0;               ///< 1 = some car has waited outside longer than the scenario allows
  std::vector<std::uint32_t> heard_epoch;  ///< per RSU: the epoch heard in this step, 0 = silent
  std::uint32_t requests_refused = 0;      ///< requests for greens of the RSUs in a run whose plan is fixed
  ReceptionReport reception;  ///< of the instant t_(step-1): what cars heard, then what RSUs said they heard

  // Two more columns of the fates.
  std::vector<std::uint8_t> fate_kind;  ///< AdviceKind
  std::vector<double> fate_speed_mps;   ///< of the kinds that ask for a speed; else NaN

  std::vector<std::uint32_t> computing_ms;  ///< per RSU: what delayed its answer of step - 1; 0 if it is silent

  // What became of the frames that cars sent at t_(step-1), RSU by RSU as each told it; none under the ideal radio.
  std::vector<std::uint32_t> uplink_vehicle;
  std::vector<std::uint32_t> uplink_rsu;
  FrameFates uplink;

  // All that was said and sensed, for a run log that holds it; else empty.
  Frames air;                              ///< what the cars sent at t_step: as in AirBatch
  SensedColumns sensed;                    ///< what sensors delivered then
  Frames said;                             ///< what the RSUs had sent at t_(step-1), as heard in this step, RSU by RSU
  std::vector<std::uint32_t> said_rsu;     ///< of each of these frames
  std::vector<std::uint32_t> asked_rsu;    ///< whose request for greens of t_(step-1) ...
  std::vector<std::uint16_t> asked_lanes;  ///< ... was for these: bit n = lane n ...
  std::vector<Step> asked_lifetime;        ///< ... for so many steps

  void clear();
};

}  // namespace lukou
