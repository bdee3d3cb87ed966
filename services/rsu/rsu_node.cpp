#include "services/rsu/rsu_node.hpp"

#include <algorithm>
#include <utility>

#include "common/core/contract.hpp"
#include "common/messages/bsm.hpp"
#include "common/messages/time_marks.hpp"
#include "services/rsu/guided_path.hpp"

namespace lukou {
namespace {

constexpr std::uint16_t kNode = 1;          // id of the intersection; assumed, from the range for tests
constexpr std::size_t kStatesPerPhase = 3;  // what shows now and the two aspects after it
constexpr Step kMapEvery = kStepsPerSecond;

constexpr double kTypicalWidth_m = 1.8;            // of what a sensor sees; assumed
constexpr Step kClockTolerance = kStepsPerSecond;  // a car's clock may be this far ahead; assumed

/// Length of a vehicle of a class; assumed.
double typical_length_m(std::uint8_t length_class) {
  switch (static_cast<LengthClass>(length_class)) {
    case LengthClass::kShort:
      return 4.5;
    case LengthClass::kMedium:
      return 9.0;
    case LengthClass::kLong:
      return 16.0;
  }
  return 0.0;
}

MapData map_of(const RsuConfig& config) {
  MapData map;
  map.node = kNode;
  map.lane_width_m = kLaneWidth_m;
  map.speed_limit_mps = config.speed_limit_mps;
  for (std::size_t i = 0; i < map.lanes.size(); ++i) {
    const Pose entrance = pose_on_path(config.road, static_cast<Lane>(i), 0.0);
    const Pose line = pose_on_path(config.road, static_cast<Lane>(i), config.road.approach_m);
    map.lanes[i] = {{entrance.x_m, entrance.y_m}, {line.x_m, line.y_m}};
  }
  return map;
}

/// Steps by which a declared computing time delays a request: what is said before the next instant is heard there.
Step request_delay(const RsuConfig& config) { return config.computing.declared_ms / kStep_ms; }

/// What a message says of its car, if it says enough to place it on the map.
std::optional<CarReport> report_of(const BasicSafety& message, Step now) {
  if (!message.speed_mps || !message.heading_rad) return std::nullopt;
  return CarReport{.id = static_cast<TemporaryId>(message.temporary_id),
                   .made = step_near_second_mark(now, message.second_mark_ms, kClockTolerance),
                   .place = {.centre_x_m = message.centre.x_m,
                             .centre_y_m = message.centre.y_m,
                             .heading_rad = *message.heading_rad,
                             .length_m = message.length_m},
                   .speed_mps = *message.speed_mps,
                   .acceleration_mps2 = message.acceleration_mps2.value_or(0.0),
                   .accuracy_m = message.accuracy_m};
}

}  // namespace

RsuNode::RsuNode(RsuConfig config, std::unique_ptr<RsuAlgorithm> algorithm)
    : config_(std::move(config)),
      algorithm_(std::move(algorithm)),
      modem_(config_.radio.seed, config_.radio.uplink, uplink_surroundings(config_.radio)),
      load_(config_.radio.load, load_reach_m(config_.road.approach_m, config_.road.exit_m)),
      cars_(config_.road),
      sensed_(config_.road),
      map_(map_of(config_)) {
  LUKOU_EXPECT(algorithm_ != nullptr);
  view_.map = map_view(config_);
  view_.actuation = config_.actuation;
  spat_.node = kNode;
  guidance_.rsu = config_.station_id;
  guidance_.node = kNode;
  safety_.rsu = config_.station_id;
}

void RsuNode::step(Step k, const SignalBatch* new_signal, const AirBatch& air, RoadsideBatch& out) {
  LUKOU_EXPECT(air.step == k && air.sensed.well_formed());
  out.rsu = config_.rsu;
  out.step = k;
  out.frames.clear();
  out.frames_heard = 0;
  out.frames_malformed = 0;
  out.answers_malformed = 0;
  out.requests_refused = 0;
  out.reception.clear();
  out.uplink.clear();
  if (new_signal != nullptr) {
    const auto taken = signals_.take({.first = new_signal->first,
                                      .heads = new_signal->heads,
                                      .change_lane = new_signal->change_lane,
                                      .change_aspect = new_signal->change_aspect,
                                      .change_step = new_signal->change_step});
    LUKOU_EXPECT(taken.ok());
  }
  signals_.advance(k);
  hear(k, air, out);
  look(k, air.sensed);
  think(k);
  out.computing_ms = answer();
  ask_for_green(k, out);
  say_spat(k, out.frames);
  if (k % kMapEvery == 0) say_map(k, out.frames);
  say_guidance(k, out);
  say_sensed(out.frames);
  load_.add_roadside(out.frames, k);
  frames_sent_ = static_cast<std::uint32_t>(out.frames.size());
  next_ = k + 1;
}

void RsuNode::change(const RsuConfig& config) {
  config_.radio = config.radio;
  modem_.use(config.radio.uplink, uplink_surroundings(config.radio));
  load_.use(config.radio.load, next_);
  config_.sensors = config.sensors;
}

void RsuNode::hear(Step k, const AirBatch& air, RoadsideBatch& out) {
  if (!config_.radio.modelled) {
    for (std::size_t frame = 0; frame < air.frames.size(); ++frame) {
      understand(k, air.frames.kind[frame], air.frames.payload_of(frame), out);
    }
  } else {
    tally_.clear();
    load_.add_air(air.frames, k);
    if (load_.counted()) tally_.busy_ratio = load_.busy_ratio_at_mast();
    receive(air, out.uplink);
    for (const auto& item : inbox_.take(k)) {
      tally_.count_delivered(item.arrival.latency_ms, item.duplicate);
      if (!item.duplicate) understand(k, item.content.kind, item.content.payload, out);
    }
    out.reception.add(Direction::kUplink, FrameKind::kBsm, tally_);
  }
  cars_.arrange(k);
}

void RsuNode::receive(const AirBatch& air, FrameFates& fates) {
  const Frames& frames = air.frames;
  for (std::size_t frame = 0; frame < frames.size(); ++frame) {
    const PlanePoint antenna{frames.antenna_x_m[frame], frames.antenna_y_m[frame]};
    Hop hop{.sender = frames.sender[frame],
            .receiver = config_.station_id,
            .sequence = frames.sequence[frame],
            .kind = frames.kind[frame],
            .sent = air.step,
            .distance_m = distance_m(antenna, config_.antenna),
            .car = antenna,
            .other = config_.antenna,
            .rsu = config_.rsu,
            .receiver_frames = frames_sent_};
    if (modem_.asks_for_speed()) hop.car_speed_mps = speeds_.of(hop.sender, antenna, air.step);
    if (modem_.asks_for_collisions()) {
      hop.collision_probability = load_.collision_to_mast(antenna, load_.width(frames.wire_bytes[frame]));
    }
    const Reception reception = modem_.receive(hop);
    tally_.count_sent(reception);
    fates.add(reception);
    if (reception.lost) continue;
    const auto payload = frames.payload_of(frame);
    inbox_.add(reception, hop, {frames.kind[frame], {payload.begin(), payload.end()}});
  }
}

void RsuNode::understand(Step k, std::uint8_t kind, std::span<const std::uint8_t> payload, RoadsideBatch& out) {
  ++out.frames_heard;
  if (kind != static_cast<std::uint8_t>(FrameKind::kBsm)) return;
  const Expected<BasicSafety> message = decode_bsm(payload);
  if (!message) {
    ++out.frames_malformed;
  } else if (const auto report = report_of(message.value(), k)) {
    cars_.hear(*report);
  }
}

void RsuNode::look(Step k, const SensedColumns& sensed) {
  sensed_.begin(k);
  for (std::size_t row = 0; row < sensed.size(); ++row) {
    if (sensed.rsu[row] != config_.rsu || sensed.sensor[row] >= config_.sensors.size()) continue;
    sensed_.take({.sensor = sensed.sensor[row],
                  .track = sensed.track[row],
                  .front_x_m = sensed.x_m[row],
                  .front_y_m = sensed.y_m[row],
                  .speed_mps = sensed.speed_mps[row],
                  .heading_rad = sensed.heading_rad[row],
                  .length_m = typical_length_m(sensed.length_class[row]),
                  .seen = sensed.measured[row]});
  }
  sensed_.arrange();
}

void RsuNode::think(Step k) {
  view_.step = k;
  view_.time_s = time_s(k);
  view_.promised_to = signals_.promised_to();
  view_.request_acts = k + request_delay(config_) + 1 + config_.signal_promise;
  for (std::size_t i = 0; i < view_.lanes.size(); ++i) {
    const auto lane = static_cast<Lane>(i);
    view_.lanes[i] = {.cars = cars_.cars(lane),
                      .sensed = sensed_.cars(lane),
                      .last_crossing_s = cars_.last_crossing_s(lane),
                      .aspect = signals_.aspect(lane),
                      .aspect_since = signals_.since(lane),
                      .changes = signals_.changes(lane)};
  }
}

std::uint32_t RsuNode::answer() {
  answer_.clear();
  const bool measured = config_.computing.measured && wall_s_;
  const double begin_s = measured ? wall_s_() : 0.0;
  algorithm_->on_step(view_, answer_);
  if (!measured) return config_.computing.declared_ms;
  // Whole milliseconds: as they are recorded, so that a replay has exactly them.
  const double took_ms = std::clamp((wall_s_() - begin_s) * 1e3, 0.0, kLatencyMax_ms);
  return static_cast<std::uint32_t>(took_ms + 0.5);
}

void RsuNode::ask_for_green(Step k, RoadsideBatch& out) {
  request_.rsu = config_.rsu;
  request_.step = k;
  request_.lanes.clear();
  request_.lifetime.clear();
  out.request_lanes.clear();
  out.request_lifetime.clear();
  if (answer_.request() && !config_.actuation) {
    out.requests_refused = 1;
  } else if (answer_.request()) {
    held_requests_.push_back({k + request_delay(config_), *answer_.request()});
  }
  if (held_requests_.empty() || held_requests_.front().due > k) return;
  // A lifetime counts from the step of the answer.
  const SignalRequest& due = held_requests_.front().request;
  const Step lifetime = due.lifetime - request_delay(config_);
  if (lifetime > 0 || due.lifetime <= 0) {
    request_.lanes.push_back(due.green.bits());
    request_.lifetime.push_back(lifetime);
    out.request_lanes = request_.lanes;
    out.request_lifetime = request_.lifetime;
  }
  held_requests_.pop_front();
}

void RsuNode::say_spat(Step k, Frames& frames) {
  spat_.count = next_count(FrameKind::kSpat);
  spat_.minute_of_year = minute_of_year(k);
  spat_.second_mark_ms = second_mark_ms(k);
  for (std::size_t i = 0; i < spat_.lanes.size(); ++i) {
    const auto lane = static_cast<Lane>(i);
    std::vector<PhaseState>& states = spat_.lanes[i];
    states.clear();
    states.push_back({.aspect = signals_.aspect(lane), .starts_in = 0, .ends_in = std::nullopt});
    for (const SignalChange& change : signals_.changes(lane)) {
      states.back().ends_in = change.step - k;
      if (states.size() == kStatesPerPhase) break;
      states.push_back({.aspect = change.aspect, .starts_in = change.step - k, .ends_in = std::nullopt});
    }
  }
  append(frames, next_envelope(), spat_);
}

void RsuNode::say_map(Step k, Frames& frames) {
  map_.count = next_count(FrameKind::kMap);
  map_.minute_of_year = minute_of_year(k);
  append(frames, next_envelope(), map_);
}

void RsuNode::say_guidance(Step k, RoadsideBatch& out) {
  guidance_.second_mark_ms = second_mark_ms(k);
  for (const RsuAnswer::Item& item : answer_.items()) {
    VehicleCoordination& vehicle = guidance_.vehicles.emplace_back();
    vehicle.vehicle = static_cast<std::uint64_t>(item.car);
    vehicle.path = guided_path(item, cars_.report(item.car));
    vehicle.binding = binding_of(item);
    if (vehicle.path && !fits(*vehicle.path)) {
      guidance_.vehicles.pop_back();
      ++out.answers_malformed;
      continue;
    }
    if (guidance_.vehicles.size() == kMaxCoordinations) send_guidance(out.frames);
  }
  if (!guidance_.vehicles.empty()) send_guidance(out.frames);
  for (const LaneSpeedAdvice& advice : answer_.lanes()) {
    const LaneSpeed word = lane_word(advice);
    if (!fits(word)) {
      ++out.answers_malformed;
      continue;
    }
    guidance_.lanes.push_back(word);
    if (guidance_.lanes.size() == kMaxLaneCoordinations) send_guidance(out.frames);
  }
  if (!guidance_.lanes.empty()) send_guidance(out.frames);
}

void RsuNode::send_guidance(Frames& frames) {
  guidance_.count = next_count(FrameKind::kRsc);
  append(frames, next_envelope(), guidance_);
  guidance_.vehicles.clear();
  guidance_.lanes.clear();
}

void RsuNode::say_sensed(Frames& frames) {
  safety_.participants.clear();
  for (const NumberedReading& item : sensed_.readings()) {
    const SensorReading& seen = item.reading;
    const RsuSensor& sensor = config_.sensors[seen.sensor];
    const PlanePoint centre = centre_of_car({seen.front_x_m, seen.front_y_m}, seen.heading_rad, seen.length_m);
    if (!fits_offset(centre)) continue;
    safety_.participants.push_back(
        {.type = ParticipantType::kMotor,
         .number = item.number,
         .source = sensor.radar ? ParticipantSource::kMicrowaveRadar : ParticipantSource::kVideo,
         .vehicle = {},
         .second_mark_ms = second_mark_ms(seen.seen),
         .centre = centre,
         .accuracy_m = sensor.accuracy_m,
         .speed_mps = seen.speed_mps,
         .heading_rad = seen.heading_rad,
         .width_m = kTypicalWidth_m,
         .length_m = seen.length_m});
    if (safety_.participants.size() == kMaxParticipants) send_sensed(frames);
  }
  if (!safety_.participants.empty()) send_sensed(frames);
}

void RsuNode::send_sensed(Frames& frames) {
  safety_.count = next_count(FrameKind::kRsm);
  append(frames, next_envelope(), safety_);
  safety_.participants.clear();
}

Envelope RsuNode::next_envelope() {
  return {.sender = config_.station_id,
          .sequence = next_sequence_++,
          .antenna_x_m = config_.antenna.x_m,
          .antenna_y_m = config_.antenna.y_m};
}

std::uint8_t RsuNode::next_count(FrameKind kind) {
  std::uint8_t& next = next_count_[static_cast<std::size_t>(kind)];
  const std::uint8_t count = next;
  next = static_cast<std::uint8_t>((next + 1) % 128);
  return count;
}

}  // namespace lukou
