#pragma once

#include <tuple>

#include "common/bus/batches.hpp"
#include "common/lockstep/messages.hpp"

namespace lukou {

// Each type's members stand in one structured binding: a member that is added to a batch and not to its list here does
// not compile, one that the bus forgets arrives empty.

inline auto members(Frames& f) {
  auto& [sender, sequence, kind, bytes, x, y, end, payload] = f;
  return std::tie(sender, sequence, kind, bytes, x, y, end, payload);
}

inline auto members(SensedColumns& s) {
  auto& [rsu, sensor, track, x, y, speed, heading, length, measured] = s;
  return std::tie(rsu, sensor, track, x, y, speed, heading, length, measured);
}

inline auto members(AirBatch& b) {
  auto& [step, frames, sensed] = b;
  return std::tuple_cat(std::tie(step), members(frames), members(sensed));
}

inline auto members(ReceptionReport& r) {
  auto& [direction, kind, sent, heard, lost_random, lost_burst, lost_range, duplicates, path_loss, collision,
         half_duplex, outage, busy, latency] = r;
  return std::tie(direction, kind, sent, heard, lost_random, lost_burst, lost_range, duplicates, path_loss, collision,
                  half_duplex, outage, busy, latency);
}

inline auto members(FrameFates& f) {
  auto& [fate, due, latency] = f;
  return std::tie(fate, due, latency);
}

inline auto members(RoadsideBatch& b) {
  auto& [rsu, epoch, step, frames, heard, malformed, answers, reception, requests, computing, uplink, request_lanes,
         request_lifetime] = b;
  return std::tuple_cat(
      std::tie(rsu, epoch, step, heard, malformed, answers, requests, computing, request_lanes, request_lifetime),
      members(frames), members(reception), members(uplink));
}

inline auto members(RequestBatch& b) {
  auto& [rsu, epoch, step, lanes, lifetime] = b;
  return std::tie(rsu, epoch, step, lanes, lifetime);
}

inline auto members(SignalBatch& b) {
  auto& [step, first, heads, lane, aspect, at, request_step, asked, rsu, lanes, outcome] = b;
  return std::tie(step, first, heads, lane, aspect, at, request_step, asked, rsu, lanes, outcome);
}

inline auto members(TrafficBatch& b) {
  auto& [step, vehicle, lane, state, equipped, position, speed, acceleration, commanded, noise, guidance, bound_by,
         missed, arrived, waiting, arrived_equipped, waiting_equipped, entered, entered_lane, entered_equipped,
         entered_speed, entered_desired, crossed, crossed_time, crossed_aspect, crossed_committed, left, left_time,
         fate_vehicle, fate_rsu, fate_sequence, fate, fate_again, fate_issued, fate_commanded, answers, guard, overflow,
         heard, requests, reception, fate_kind, fate_speed, computing, uplink_vehicle, uplink_rsu, uplink, air, sensed,
         said, said_rsu, asked_rsu, asked_lanes, asked_lifetime] = b;
  return std::tuple_cat(
      std::tie(step, vehicle, lane, state, equipped, position, speed, acceleration, commanded, noise, guidance,
               bound_by, missed, arrived, waiting, arrived_equipped, waiting_equipped, entered, entered_lane,
               entered_equipped, entered_speed, entered_desired, crossed, crossed_time, crossed_aspect,
               crossed_committed, left, left_time, fate_vehicle, fate_rsu, fate_sequence, fate, fate_again, fate_issued,
               fate_commanded, answers, guard, overflow, heard, requests, fate_kind, fate_speed, computing,
               uplink_vehicle, uplink_rsu, said_rsu, asked_rsu, asked_lanes, asked_lifetime),
      members(reception), members(uplink), members(air), members(sensed), members(said));
}

inline auto members(Control& m) {
  auto& [kind, clock, sequence, to, epoch, rsu, through, last, ok, number, version, roster_incarnation, roster_role,
         directive_step, directive_set, attach_rsu, attach_epoch, attach_from, text, culprit] = m;
  return std::tie(kind, clock, sequence, to, epoch, rsu, through, last, ok, number, version, roster_incarnation,
                  roster_role, directive_step, directive_set, attach_rsu, attach_epoch, attach_from, text, culprit);
}

inline auto members(Up& m) {
  auto& [kind, incarnation, role, protocol, number, step, text, hash] = m;
  return std::tie(kind, incarnation, role, protocol, number, step, text, hash);
}

inline auto members(RunState& m) {
  auto& [run, phase, granted, recorded, end, pace, text, culprit, recorder, foreign] = m;
  return std::tie(run, phase, granted, recorded, end, pace, text, culprit, recorder, foreign);
}

inline auto members(FigureColumns& f) {
  auto& [arrived, waiting, in_system, left, standing, stops, throughput, per_vehicle, stop_time, mean_stop_time,
         mean_delay] = f;
  return std::tie(arrived, waiting, in_system, left, standing, stops, throughput, per_vehicle, stop_time,
                  mean_stop_time, mean_delay);
}

inline auto members(View& m) {
  auto& [step, figures, queue, arrived, waiting, heard, vehicle, lane, state, equipped, position, speed, acceleration,
         commanded, guidance, bound_by, missed, stood, advice, heads, change, next, direction, kind, sent, radio_heard,
         lost, latency, uplink, heard_step, advice_by_fate] = m;
  return std::tuple_cat(
      std::tie(step, queue, arrived, waiting, heard, vehicle, lane, state, equipped, position, speed, acceleration,
               commanded, guidance, bound_by, missed, stood, advice, heads, change, next, direction, kind, sent,
               radio_heard, lost, latency, uplink, heard_step, advice_by_fate),
      members(figures));
}

}  // namespace lukou
