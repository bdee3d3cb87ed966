#include "common/bus/samples.hpp"

namespace lukou::bus {
namespace {

template <class T, class Sequence>
void lend_column(const std::vector<T>& column, Sequence& sequence) {
  sequence._buffer = const_cast<T*>(column.data());
  sequence._length = sequence._maximum = static_cast<std::uint32_t>(column.size());
  sequence._release = false;
}

template <class Sequence>
void lend_strings(const std::vector<std::string>& column, Sequence& sequence, std::vector<char*>& pointers) {
  pointers.clear();
  for (const std::string& text : column) pointers.push_back(const_cast<char*>(text.c_str()));
  sequence._buffer = pointers.data();
  sequence._length = sequence._maximum = static_cast<std::uint32_t>(pointers.size());
  sequence._release = false;
}

char* lend_string(const std::string& text) { return const_cast<char*>(text.c_str()); }

template <class T, class Sequence>
void copy_column(const Sequence& sequence, std::vector<T>& column) {
  column.assign(sequence._buffer, sequence._buffer + sequence._length);
}

template <class Sequence>
void copy_strings(const Sequence& sequence, std::vector<std::string>& column) {
  column.assign(sequence._buffer, sequence._buffer + sequence._length);
}

void copy_string(const char* text, std::string& target) { target = text == nullptr ? "" : text; }

// The columns of both directions, once: `move` is lend_column or copy_column.
template <class Plain, class Sample, class Move>
void frames_columns(Plain& plain, Sample& sample, Move move) {
  move(plain.sender, sample.sender), move(plain.sequence, sample.sequence_number), move(plain.kind, sample.kind);
  move(plain.wire_bytes, sample.wire_bytes), move(plain.antenna_x_m, sample.antenna_x_m);
  move(plain.antenna_y_m, sample.antenna_y_m), move(plain.payload_end, sample.payload_end);
  move(plain.payload, sample.payload);
}

template <class Plain, class Sample, class Move>
void sensed_columns(Plain& plain, Sample& sample, Move move) {
  move(plain.rsu, sample.rsu), move(plain.sensor, sample.sensor), move(plain.track, sample.track);
  move(plain.x_m, sample.x_m), move(plain.y_m, sample.y_m), move(plain.speed_mps, sample.speed_mps);
  move(plain.heading_rad, sample.heading_rad), move(plain.length_class, sample.length_class);
  move(plain.measured, sample.measured_step);
}

template <class Plain, class Sample, class Move>
void reception_columns(Plain& plain, Sample& sample, Move move) {
  move(plain.direction, sample.direction), move(plain.kind, sample.kind), move(plain.sent, sample.sent);
  move(plain.heard, sample.heard), move(plain.lost_random, sample.lost_random);
  move(plain.lost_burst, sample.lost_burst), move(plain.lost_range, sample.lost_range);
  move(plain.duplicates, sample.duplicates), move(plain.lost_path_loss, sample.lost_path_loss);
  move(plain.lost_collision, sample.lost_collision), move(plain.lost_half_duplex, sample.lost_half_duplex);
  move(plain.lost_outage, sample.lost_outage), move(plain.busy_ratio, sample.busy_ratio);
  move(plain.latency_ms, sample.latency_ms);
}

template <class Plain, class Sample, class Move>
void fates_columns(Plain& plain, Sample& sample, Move move) {
  move(plain.fate, sample.fate), move(plain.due, sample.due), move(plain.latency_ms, sample.latency_ms);
}

template <class Plain, class Sample, class Move>
void roadside_columns(Plain& plain, Sample& sample, Move move) {
  frames_columns(plain.frames, sample.frames, move);
  reception_columns(plain.reception, sample.reception, move);
  fates_columns(plain.uplink, sample.uplink, move);
  move(plain.request_lanes, sample.request_lanes), move(plain.request_lifetime, sample.request_lifetime);
}

template <class Plain, class Sample, class Move>
void signal_columns(Plain& plain, Sample& sample, Move move) {
  move(plain.heads, sample.heads), move(plain.change_lane, sample.change_lane);
  move(plain.change_aspect, sample.change_aspect), move(plain.change_step, sample.change_step);
  move(plain.request_step, sample.request_step), move(plain.request_asked, sample.request_asked);
  move(plain.request_rsu, sample.request_rsu), move(plain.request_lanes, sample.request_lanes);
  move(plain.request_outcome, sample.request_outcome);
}

template <class Plain, class Sample, class Move>
void request_columns(Plain& plain, Sample& sample, Move move) {
  move(plain.lanes, sample.lanes), move(plain.lifetime, sample.lifetime);
}

template <class Plain, class Sample, class Move>
void traffic_columns(Plain& plain, Sample& sample, Move move) {
  move(plain.vehicle, sample.vehicle), move(plain.lane, sample.lane), move(plain.state, sample.state);
  move(plain.equipped, sample.equipped), move(plain.position_m, sample.position_m);
  move(plain.speed_mps, sample.speed_mps), move(plain.acceleration_mps2, sample.acceleration_mps2);
  move(plain.commanded_mps2, sample.commanded_mps2), move(plain.noise_mps2, sample.noise_mps2);
  move(plain.guidance, sample.guidance), move(plain.bound_by, sample.bound_by), move(plain.missed, sample.missed);
  move(plain.arrived, sample.arrived), move(plain.waiting, sample.waiting);
  move(plain.arrived_equipped, sample.arrived_equipped), move(plain.waiting_equipped, sample.waiting_equipped);
  move(plain.entered_vehicle, sample.entered_vehicle), move(plain.entered_lane, sample.entered_lane);
  move(plain.entered_equipped, sample.entered_equipped), move(plain.entered_speed_mps, sample.entered_speed_mps);
  move(plain.entered_desired_speed_mps, sample.entered_desired_speed_mps);
  move(plain.crossed_vehicle, sample.crossed_vehicle), move(plain.crossed_time_s, sample.crossed_time_s);
  move(plain.crossed_aspect, sample.crossed_aspect), move(plain.crossed_committed, sample.crossed_committed);
  move(plain.left_vehicle, sample.left_vehicle), move(plain.left_time_s, sample.left_time_s);
  move(plain.fate_vehicle, sample.fate_vehicle), move(plain.fate_rsu, sample.fate_rsu);
  move(plain.fate_sequence, sample.fate_sequence), move(plain.fate, sample.fate);
  move(plain.fate_again, sample.fate_again), move(plain.fate_issued, sample.fate_issued);
  move(plain.fate_commanded_mps2, sample.fate_commanded_mps2), move(plain.heard_epoch, sample.heard_epoch);
  move(plain.fate_kind, sample.fate_kind), move(plain.fate_speed_mps, sample.fate_speed_mps);
  move(plain.computing_ms, sample.computing_ms), move(plain.uplink_vehicle, sample.uplink_vehicle);
  move(plain.uplink_rsu, sample.uplink_rsu), move(plain.said_rsu, sample.said_rsu);
  move(plain.asked_rsu, sample.asked_rsu), move(plain.asked_lanes, sample.asked_lanes);
  move(plain.asked_lifetime, sample.asked_lifetime);
  fates_columns(plain.uplink, sample.uplink, move);
  reception_columns(plain.reception, sample.reception, move);
  frames_columns(plain.air, sample.air, move);
  sensed_columns(plain.sensed, sample.sensed, move);
  frames_columns(plain.said, sample.said, move);
}

template <class Plain, class Sample, class Move>
void view_columns(Plain& plain, Sample& sample, Move move) {
  auto& figures = plain.figures;
  auto& sampled = sample.figures;
  move(figures.arrived, sampled.arrived), move(figures.waiting, sampled.waiting);
  move(figures.in_system, sampled.in_system), move(figures.left, sampled.left);
  move(figures.standing, sampled.standing), move(figures.stops, sampled.stops);
  move(figures.throughput_veh_per_h, sampled.throughput_veh_per_h);
  move(figures.stops_per_vehicle, sampled.stops_per_vehicle), move(figures.stop_time_s, sampled.stop_time_s);
  move(figures.mean_stop_time_s, sampled.mean_stop_time_s), move(figures.mean_delay_s, sampled.mean_delay_s);
  move(plain.queue, sample.queue), move(plain.arrived, sample.arrived), move(plain.waiting, sample.waiting);
  move(plain.heard_epoch, sample.heard_epoch), move(plain.vehicle, sample.vehicle), move(plain.lane, sample.lane);
  move(plain.state, sample.state), move(plain.equipped, sample.equipped), move(plain.position_m, sample.position_m);
  move(plain.speed_mps, sample.speed_mps), move(plain.acceleration_mps2, sample.acceleration_mps2);
  move(plain.commanded_mps2, sample.commanded_mps2), move(plain.guidance, sample.guidance);
  move(plain.bound_by, sample.bound_by), move(plain.missed, sample.missed);
  move(plain.standing_steps, sample.standing_steps), move(plain.advice_step, sample.advice_step);
  move(plain.heads, sample.heads), move(plain.change_step, sample.change_step);
  move(plain.next_aspect, sample.next_aspect), move(plain.radio_direction, sample.radio_direction);
  move(plain.radio_kind, sample.radio_kind), move(plain.radio_sent, sample.radio_sent);
  move(plain.radio_heard, sample.radio_heard), move(plain.radio_lost, sample.radio_lost);
  move(plain.radio_latency_ms, sample.radio_latency_ms), move(plain.uplink, sample.uplink);
  move(plain.heard_step, sample.heard_step), move(plain.advice, sample.advice);
}

constexpr auto kLend = [](const auto& column, auto& sequence) { lend_column(column, sequence); };
constexpr auto kCopy = [](auto& column, const auto& sequence) { copy_column(sequence, column); };

}  // namespace

void lend(const AirBatch& batch, lukou_bus_Air& sample, Scratch&) {
  sample.step = batch.step;
  frames_columns(batch.frames, sample.frames, kLend);
  sensed_columns(batch.sensed, sample.sensed, kLend);
}

void copy(const lukou_bus_Air& sample, AirBatch& batch) {
  batch.step = sample.step;
  frames_columns(batch.frames, sample.frames, kCopy);
  sensed_columns(batch.sensed, sample.sensed, kCopy);
}

void lend(const RoadsideBatch& batch, lukou_bus_Roadside& sample, Scratch&) {
  sample.step = batch.step;
  sample.rsu = batch.rsu;
  sample.frames_heard = batch.frames_heard;
  sample.frames_malformed = batch.frames_malformed;
  sample.answers_malformed = batch.answers_malformed;
  sample.computing_ms = batch.computing_ms;
  roadside_columns(batch, sample, kLend);
  sample.requests_refused = batch.requests_refused;
}

void copy(const lukou_bus_Roadside& sample, RoadsideBatch& batch) {
  batch.step = sample.step;
  batch.rsu = sample.rsu;
  batch.epoch = sample.epoch;
  batch.frames_heard = sample.frames_heard;
  batch.frames_malformed = sample.frames_malformed;
  batch.answers_malformed = sample.answers_malformed;
  batch.computing_ms = sample.computing_ms;
  roadside_columns(batch, sample, kCopy);
  batch.requests_refused = sample.requests_refused;
}

void lend(const RequestBatch& batch, lukou_bus_Request& sample, Scratch&) {
  sample.step = batch.step;
  sample.rsu = batch.rsu;
  request_columns(batch, sample, kLend);
}

void copy(const lukou_bus_Request& sample, RequestBatch& batch) {
  batch.step = sample.step;
  batch.rsu = sample.rsu;
  batch.epoch = sample.epoch;
  request_columns(batch, sample, kCopy);
}

void lend(const SignalBatch& batch, lukou_bus_Signal& sample, Scratch&) {
  sample.step = batch.step;
  sample.first = batch.first;
  signal_columns(batch, sample, kLend);
}

void copy(const lukou_bus_Signal& sample, SignalBatch& batch) {
  batch.step = sample.step;
  batch.first = sample.first;
  signal_columns(batch, sample, kCopy);
}

void lend(const TrafficBatch& batch, lukou_bus_Traffic& sample, Scratch&) {
  sample.step = batch.step;
  sample.answers_malformed = batch.answers_malformed;
  sample.guard_interventions = batch.guard_interventions;
  sample.overflow = batch.overflow;
  traffic_columns(batch, sample, kLend);
  sample.requests_refused = batch.requests_refused;
}

void copy(const lukou_bus_Traffic& sample, TrafficBatch& batch) {
  batch.step = sample.step;
  batch.answers_malformed = sample.answers_malformed;
  batch.guard_interventions = sample.guard_interventions;
  batch.overflow = sample.overflow;
  traffic_columns(batch, sample, kCopy);
  batch.requests_refused = sample.requests_refused;
}

void lend(const Control& message, lukou_bus_Control& sample, Scratch& scratch) {
  sample.clock = message.clock;
  sample.sequence_number = message.sequence;
  sample.kind = static_cast<std::uint8_t>(message.kind);
  sample.to = message.to;
  sample.epoch = message.epoch;
  sample.rsu = message.rsu;
  sample.through = message.through;
  sample.last = message.last;
  sample.ok = message.ok;
  sample.number = message.number;
  sample.roster_version = message.roster_version;
  lend_column(message.roster_incarnation, sample.roster_incarnation);
  lend_strings(message.roster_role, sample.roster_role, scratch.strings_a);
  lend_column(message.directive_step, sample.directive_step);
  lend_strings(message.directive_set, sample.directive_set, scratch.strings_b);
  lend_column(message.attach_rsu, sample.attach_rsu);
  lend_column(message.attach_epoch, sample.attach_epoch);
  lend_column(message.attach_from, sample.attach_from);
  sample.text = lend_string(message.text);
  sample.culprit = lend_string(message.culprit);
}

void copy(const lukou_bus_Control& sample, Control& message) {
  message.clock = sample.clock;
  message.sequence = sample.sequence_number;
  message.kind = static_cast<Control::Kind>(sample.kind);
  message.to = sample.to;
  message.epoch = sample.epoch;
  message.rsu = sample.rsu;
  message.through = sample.through;
  message.last = sample.last;
  message.ok = sample.ok;
  message.number = sample.number;
  message.roster_version = sample.roster_version;
  copy_column(sample.roster_incarnation, message.roster_incarnation);
  copy_strings(sample.roster_role, message.roster_role);
  copy_column(sample.directive_step, message.directive_step);
  copy_strings(sample.directive_set, message.directive_set);
  copy_column(sample.attach_rsu, message.attach_rsu);
  copy_column(sample.attach_epoch, message.attach_epoch);
  copy_column(sample.attach_from, message.attach_from);
  copy_string(sample.text, message.text);
  copy_string(sample.culprit, message.culprit);
}

void lend(const Up& message, lukou_bus_Up& sample, Scratch&) {
  sample.incarnation = message.incarnation;
  sample.kind = static_cast<std::uint8_t>(message.kind);
  sample.role = lend_string(message.role);
  sample.protocol = message.protocol;
  sample.number = message.number;
  sample.step = message.step;
  sample.text = lend_string(message.text);
  sample.hash = lend_string(message.hash);
}

void copy(const lukou_bus_Up& sample, Up& message) {
  message.incarnation = sample.incarnation;
  message.kind = static_cast<Up::Kind>(sample.kind);
  copy_string(sample.role, message.role);
  message.protocol = sample.protocol;
  message.number = sample.number;
  message.step = sample.step;
  copy_string(sample.text, message.text);
  copy_string(sample.hash, message.hash);
}

void lend(const RunState& message, lukou_bus_RunState& sample, Scratch&) {
  sample.run = lend_string(message.run);
  sample.phase = static_cast<std::uint8_t>(message.phase);
  sample.granted = message.granted;
  sample.recorded = message.recorded;
  sample.end = message.end;
  sample.pace = message.pace;
  sample.text = lend_string(message.text);
  sample.culprit = lend_string(message.culprit);
  sample.recorder = message.recorder;
  sample.foreign_samples = message.foreign_samples;
}

void copy(const lukou_bus_RunState& sample, RunState& message) {
  copy_string(sample.run, message.run);
  message.phase = static_cast<RunPhase>(sample.phase);
  message.granted = sample.granted;
  message.recorded = sample.recorded;
  message.end = sample.end;
  message.pace = sample.pace;
  copy_string(sample.text, message.text);
  copy_string(sample.culprit, message.culprit);
  message.recorder = sample.recorder;
  message.foreign_samples = sample.foreign_samples;
}

void lend(const View& message, lukou_bus_View& sample, Scratch&) {
  sample.step = message.step;
  view_columns(message, sample, kLend);
}

void copy(const lukou_bus_View& sample, View& message) {
  message.step = sample.step;
  view_columns(message, sample, kCopy);
}

}  // namespace lukou::bus
