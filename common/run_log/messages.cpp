#include "common/run_log/messages.hpp"

#include <algorithm>
#include <initializer_list>
#include <string>

#include "run_log.pb.h"

namespace lukou::run_log {
namespace {

using google::protobuf::RepeatedField;

bool all_are(std::size_t length, std::initializer_list<std::size_t> sizes) {
  return std::ranges::all_of(sizes, [&](std::size_t size) { return size == length; });
}

// A column in either direction; the first argument is the one that is written.
template <class T, class F>
void put(RepeatedField<F>* field, const std::vector<T>& column) {
  field->Clear();
  field->Add(column.begin(), column.end());
}
void put(std::string* field, const std::vector<std::uint8_t>& column) { field->assign(column.begin(), column.end()); }
template <class T, class F>
void put(std::vector<T>& column, const RepeatedField<F>& field) {
  column.resize(static_cast<std::size_t>(field.size()));
  std::ranges::transform(field, column.begin(), [](F value) { return static_cast<T>(value); });
}
void put(std::vector<std::uint8_t>& column, const std::string& field) { column.assign(field.begin(), field.end()); }

// The columns of both directions, once: `m` is the message to fill or the one to read, `b` the batch.
#define LUKOU_OUT(column) put(m.mutable_##column(), b.column)
#define LUKOU_IN(column) put(b.column, m.column())
#define LUKOU_CARS(MOVE)                                                                                              \
  MOVE(vehicle), MOVE(lane), MOVE(state), MOVE(equipped), MOVE(position_m), MOVE(speed_mps), MOVE(acceleration_mps2), \
      MOVE(commanded_mps2), MOVE(noise_mps2), MOVE(guidance), MOVE(bound_by), MOVE(missed)
#define LUKOU_EVENTS(MOVE)                                                                                            \
  MOVE(arrived), MOVE(waiting), MOVE(arrived_equipped), MOVE(waiting_equipped), MOVE(entered_vehicle),                \
      MOVE(entered_lane), MOVE(entered_equipped), MOVE(entered_speed_mps), MOVE(entered_desired_speed_mps),           \
      MOVE(crossed_vehicle), MOVE(crossed_time_s), MOVE(crossed_aspect), MOVE(crossed_committed), MOVE(left_vehicle), \
      MOVE(left_time_s), MOVE(fate_vehicle), MOVE(fate_rsu), MOVE(fate_sequence), MOVE(fate), MOVE(fate_again),       \
      MOVE(fate_issued), MOVE(fate_commanded_mps2), MOVE(fate_kind), MOVE(fate_speed_mps), MOVE(heard_epoch),         \
      MOVE(computing_ms)
#define LUKOU_RECEPTION(MOVE)                                                                                  \
  MOVE(direction), MOVE(kind), MOVE(sent), MOVE(heard), MOVE(lost_random), MOVE(lost_burst), MOVE(lost_range), \
      MOVE(lost_path_loss), MOVE(lost_collision), MOVE(lost_half_duplex), MOVE(lost_outage), MOVE(duplicates), \
      MOVE(busy_ratio), MOVE(latency_ms)
#define LUKOU_FRAMES(MOVE)                                                                                             \
  MOVE(sender), MOVE(sequence), MOVE(kind), MOVE(wire_bytes), MOVE(antenna_x_m), MOVE(antenna_y_m), MOVE(payload_end), \
      MOVE(payload)
#define LUKOU_SENSED(MOVE)                                                                                            \
  MOVE(rsu), MOVE(sensor), MOVE(track), MOVE(x_m), MOVE(y_m), MOVE(speed_mps), MOVE(heading_rad), MOVE(length_class), \
      MOVE(measured)
#define LUKOU_SIGNAL(MOVE)                                                                                         \
  MOVE(heads), MOVE(change_lane), MOVE(change_aspect), MOVE(change_step), MOVE(request_step), MOVE(request_asked), \
      MOVE(request_rsu), MOVE(request_lanes), MOVE(request_outcome)

void fill(record::Frames& m, const Frames& b) { LUKOU_FRAMES(LUKOU_OUT); }

bool take(const record::Frames& m, Frames& b) {
  LUKOU_FRAMES(LUKOU_IN);
  return all_are(b.size(), {b.sequence.size(), b.kind.size(), b.wire_bytes.size(), b.antenna_x_m.size(),
                            b.antenna_y_m.size(), b.payload_end.size()}) &&
         std::ranges::is_sorted(b.payload_end) &&
         b.payload.size() == (b.payload_end.empty() ? 0 : b.payload_end.back());
}

}  // namespace

void fill(record::Cars& m, const TrafficBatch& b) {
  m.set_step(b.step);
  LUKOU_CARS(LUKOU_OUT);
}

bool take(const record::Cars& m, TrafficBatch& b) {
  LUKOU_CARS(LUKOU_IN);
  return all_are(b.vehicle.size(), {b.lane.size(), b.state.size(), b.equipped.size(), b.position_m.size(),
                                    b.speed_mps.size(), b.acceleration_mps2.size(), b.commanded_mps2.size(),
                                    b.noise_mps2.size(), b.guidance.size(), b.bound_by.size(), b.missed.size()});
}

void fill(record::Events& m, const TrafficBatch& b) {
  m.set_step(b.step);
  LUKOU_EVENTS(LUKOU_OUT);
  m.set_answers_malformed(b.answers_malformed);
  m.set_requests_refused(b.requests_refused);
  m.set_guard_interventions(b.guard_interventions);
  m.set_overflow(b.overflow != 0);
}

bool take(const record::Events& m, TrafficBatch& b) {
  LUKOU_EVENTS(LUKOU_IN);
  b.answers_malformed = m.answers_malformed();
  b.requests_refused = m.requests_refused();
  b.guard_interventions = m.guard_interventions();
  b.overflow = m.overflow() ? 1 : 0;
  constexpr std::size_t kApproaches = 4;
  return all_are(kApproaches,
                 {b.arrived.size(), b.waiting.size(), b.arrived_equipped.size(), b.waiting_equipped.size()}) &&
         all_are(b.entered_vehicle.size(), {b.entered_lane.size(), b.entered_equipped.size(),
                                            b.entered_speed_mps.size(), b.entered_desired_speed_mps.size()}) &&
         all_are(b.crossed_vehicle.size(),
                 {b.crossed_time_s.size(), b.crossed_aspect.size(), b.crossed_committed.size()}) &&
         b.left_vehicle.size() == b.left_time_s.size() &&
         all_are(b.fate_vehicle.size(),
                 {b.fate_rsu.size(), b.fate_sequence.size(), b.fate.size(), b.fate_again.size(), b.fate_issued.size(),
                  b.fate_commanded_mps2.size(), b.fate_kind.size(), b.fate_speed_mps.size()});
}

void fill(record::Reception& m, const TrafficBatch& batch) {
  m.set_step(batch.step);
  const ReceptionReport& b = batch.reception;
  LUKOU_RECEPTION(LUKOU_OUT);
  put(m.mutable_uplink_vehicle(), batch.uplink_vehicle);
  put(m.mutable_uplink_rsu(), batch.uplink_rsu);
  put(m.mutable_uplink_fate(), batch.uplink.fate);
  put(m.mutable_uplink_due(), batch.uplink.due);
  put(m.mutable_uplink_latency_ms(), batch.uplink.latency_ms);
}

bool take(const record::Reception& m, TrafficBatch& batch) {
  ReceptionReport& b = batch.reception;
  LUKOU_RECEPTION(LUKOU_IN);
  put(batch.uplink_vehicle, m.uplink_vehicle());
  put(batch.uplink_rsu, m.uplink_rsu());
  put(batch.uplink.fate, m.uplink_fate());
  put(batch.uplink.due, m.uplink_due());
  put(batch.uplink.latency_ms, m.uplink_latency_ms());
  return b.well_formed() && batch.uplink.well_formed() &&
         all_are(batch.uplink.size(), {batch.uplink_vehicle.size(), batch.uplink_rsu.size()});
}

void fill(record::Air& message, const TrafficBatch& batch) {
  message.set_step(batch.step);
  fill(*message.mutable_frames(), batch.air);
  record::Sensed& m = *message.mutable_sensed();
  const SensedColumns& b = batch.sensed;
  LUKOU_SENSED(LUKOU_OUT);
}

bool take(const record::Air& message, TrafficBatch& batch) {
  const record::Sensed& m = message.sensed();
  SensedColumns& b = batch.sensed;
  LUKOU_SENSED(LUKOU_IN);
  return take(message.frames(), batch.air) && b.well_formed();
}

void fill(record::Roadside& m, const TrafficBatch& b) {
  m.set_step(b.step);
  fill(*m.mutable_frames(), b.said);
  put(m.mutable_rsu(), b.said_rsu);
  put(m.mutable_request_rsu(), b.asked_rsu);
  put(m.mutable_request_lanes(), b.asked_lanes);
  put(m.mutable_request_lifetime(), b.asked_lifetime);
}

bool take(const record::Roadside& m, TrafficBatch& b) {
  put(b.said_rsu, m.rsu());
  put(b.asked_rsu, m.request_rsu());
  put(b.asked_lanes, m.request_lanes());
  put(b.asked_lifetime, m.request_lifetime());
  return take(m.frames(), b.said) && b.said_rsu.size() == b.said.size() &&
         all_are(b.asked_rsu.size(), {b.asked_lanes.size(), b.asked_lifetime.size()});
}

void fill(record::Signal& m, const SignalBatch& b, Step step) {
  m.set_step(step);
  m.set_batch(b.step);
  m.set_first(b.first);
  LUKOU_SIGNAL(LUKOU_OUT);
}

bool take(const record::Signal& m, SignalBatch& b) {
  b.step = m.batch();
  b.first = m.first();
  LUKOU_SIGNAL(LUKOU_IN);
  return all_are(b.change_lane.size(), {b.change_aspect.size(), b.change_step.size()}) &&
         all_are(b.request_step.size(),
                 {b.request_asked.size(), b.request_rsu.size(), b.request_lanes.size(), b.request_outcome.size()});
}

#undef LUKOU_OUT
#undef LUKOU_IN
#undef LUKOU_CARS
#undef LUKOU_EVENTS
#undef LUKOU_RECEPTION
#undef LUKOU_FRAMES
#undef LUKOU_SENSED
#undef LUKOU_SIGNAL

}  // namespace lukou::run_log
