#include "services/traffic_engine/engine_node.hpp"

#include <algorithm>
#include <limits>
#include <string>
#include <utility>

#include "common/core/contract.hpp"
#include "common/intersection/geometry.hpp"
#include "common/messages/bsm.hpp"
#include "common/messages/rsc.hpp"
#include "common/messages/time_marks.hpp"
#include "services/traffic_engine/air_report.hpp"
#include "services/traffic_engine/traffic_report.hpp"

namespace lukou {
namespace {

/// Steps that begin within a lifetime: an advice of 250 ms acts in three.
Step steps_of_life(std::uint32_t lifetime_ms) { return (static_cast<Step>(lifetime_ms) + kStep_ms - 1) / kStep_ms; }

AdviceFate loss_fate(LossCause cause) {
  switch (cause) {
    case LossCause::kRandom:
      return AdviceFate::kLostRandom;
    case LossCause::kBurst:
      return AdviceFate::kLostBurst;
    case LossCause::kPathLoss:
      return AdviceFate::kLostPathLoss;
    case LossCause::kCollision:
      return AdviceFate::kLostCollision;
    case LossCause::kHalfDuplex:
      return AdviceFate::kLostHalfDuplex;
    case LossCause::kOutage:
      return AdviceFate::kLostOutage;
    case LossCause::kRange:
      break;
  }
  return AdviceFate::kLostRange;
}

/// What an RSC asks of a car, but for its frame.
traffic::Advice advice_of(const VehicleCoordination& asked) {
  traffic::Advice advice{.target = asked.vehicle,
                         .binding = asked.binding == Binding::kFollowing ? traffic::AdviceBinding::kFollowing
                                                                         : traffic::AdviceBinding::kGuard,
                         .release = !asked.path};
  if (!asked.path) return advice;
  const GuidedPath& path = *asked.path;
  advice.acceleration_mps2 = path.acceleration_mps2;
  advice.lifetime = steps_of_life(path.lifetime_ms);
  if (path.speed_mps) {
    advice.kind = traffic::AdviceKind::kSpeed;
    advice.speed_mps = *path.speed_mps;
    advice.acceleration_mps2 = std::numeric_limits<double>::quiet_NaN();
  }
  if (!path.later.empty()) advice.kind = traffic::AdviceKind::kProfile;
  for (const LaterAcceleration& later : path.later) {
    // From the first step that begins then: a point at 250 ms acts from the fourth step on.
    advice.later.push_back({.after = steps_of_life(later.from_ms), .acceleration_mps2 = later.acceleration_mps2});
  }
  return advice;
}

bool same_flows(const traffic::DemandParameters& a, const traffic::DemandParameters& b) {
  const auto same = [](const traffic::Flow& x, const traffic::Flow& y) {
    return x.from_s == y.from_s && x.flow_veh_per_h == y.flow_veh_per_h;
  };
  return a.listed == b.listed && std::equal(a.flows.begin(), a.flows.end(), b.flows.begin(), b.flows.end(), same);
}

}  // namespace

EngineNode::EngineNode(const EngineConfig& config)
    : config_(config),
      engine_(config.traffic),
      modem_(config.radio.seed, config.radio.downlink, downlink_surroundings(config.radio)),
      load_(config.radio.load, load_reach_m(config.traffic.road.approach_m, config.traffic.road.exit_m)),
      between_cars_(config.radio),
      unit_errors_(config.traffic.seed, config.unit_errors),
      sensors_(config.traffic.seed, config.sensors) {}

void EngineNode::change(const EngineConfig& config) {
  for (const Approach approach : kAllApproaches) {
    const traffic::DemandParameters& demand = config.traffic.demand[index(approach)];
    traffic::DemandParameters& in_force = config_.traffic.demand[index(approach)];
    if (same_flows(demand, in_force)) continue;
    LUKOU_EXPECT(!demand.listed && demand.flows.size() == 1);  // only a constant flow is live
    engine_.change_flow(approach, demand.flows.front().flow_veh_per_h);
    in_force = demand;
  }
  config_.traffic.equipped_ratio = config.traffic.equipped_ratio;
  engine_.change_equipped_ratio(config.traffic.equipped_ratio);
  engine_.change_units(config.traffic.unit, config.traffic.compliance);
  config_.radio = config.radio;
  modem_.use(config.radio.downlink, downlink_surroundings(config.radio));
  load_.use(config.radio.load, next_);
  between_cars_.use(config.radio);
  unit_errors_.use(config.unit_errors);
  sensors_.use(config.sensors);
}

Expected<Done> EngineNode::step(Step k, const SignalBatch* new_signal, std::span<const RoadsideBatch* const> roadside,
                                TrafficBatch& traffic, AirBatch& air) {
  if (new_signal != nullptr && !promise_.extend(new_signal->first, new_signal->heads)) {
    return Error{"signal", "the heads from step " + std::to_string(new_signal->first) +
                               " on leave a gap or hold an unknown aspect"};
  }
  if (k > 0 && !promise_.covers(k - 1)) {
    return Error{"signal", "the heads of step " + std::to_string(k - 1) + " are not promised"};
  }
  advice_.clear();
  fates_.clear();
  tally_.clear();
  if (load_.counted()) tally_.busy_ratio = load_.busy_ratio_of_cars();
  for (const RoadsideBatch* batch : roadside) {
    if (batch == nullptr) continue;
    hear(*batch);
    load_.add_roadside(batch->frames, batch->step);
  }
  if (config_.radio.modelled || !inbox_.empty()) deliver(k - 1);
  engine_.step(k, k > 0 ? promise_.at(k - 1) : Heads{}, advice_);
  promise_.forget_before(k);

  report(engine_, k, traffic);
  report_fates(traffic);
  report_reception(roadside, traffic);
  for (const RoadsideBatch* batch : roadside) {
    if (batch == nullptr) continue;
    if (auto done = report_uplink(*batch, traffic); !done) return done;
  }
  for (const RoadsideBatch* batch : roadside) {
    traffic.heard_epoch.push_back(batch != nullptr ? batch->epoch : 0);
    traffic.computing_ms.push_back(batch != nullptr ? computing_ms(*batch) : 0);
    if (batch == nullptr) continue;
    traffic.answers_malformed += batch->answers_malformed;
    traffic.requests_refused += batch->requests_refused;
  }
  air.step = k;
  air.frames.clear();
  say_safety_messages(engine_, unit_errors_, k, air.frames, speakers_);
  report_sensed(sensors_.look(k, engine_), air.sensed);
  if (config_.record_frames) report_frames(roadside, air, traffic);
  load_.add_air(air.frames, k);
  between_cars_.hear(air.frames, k, load_);
  next_ = k + 1;
  return Done{};
}

void EngineNode::replay(const std::vector<ComputingDelay>& computed) {
  replayed_.emplace();
  for (const ComputingDelay& delay : computed) replayed_->insert({{delay.step, delay.rsu}, delay.delay_ms});
}

std::uint32_t EngineNode::computing_ms(const RoadsideBatch& batch) const {
  const bool measured = batch.rsu < config_.rsu_measured.size() && config_.rsu_measured[batch.rsu];
  if (!replayed_ || !measured) return batch.computing_ms;
  const auto recorded = replayed_->find({batch.step, batch.rsu});
  return recorded == replayed_->end() ? 0 : recorded->second;
}

void EngineNode::hear(const RoadsideBatch& batch) {
  if (!config_.radio.modelled) engine_.hear_rsu(batch.rsu, batch.step);
  for (std::size_t frame = 0; frame < batch.frames.size(); ++frame) {
    const auto kind = static_cast<FrameKind>(batch.frames.kind[frame]);
    if (kind == FrameKind::kRsc) hear_coordination(batch, frame);
    if (kind == FrameKind::kSpat && config_.radio.modelled) hear_spat(batch, frame);
  }
}

void EngineNode::hear_spat(const RoadsideBatch& batch, std::size_t frame) {
  const Step lost_after = step_at_or_after(engine_.parameters().unit.rsu_lost_after_s);
  for (int i = 0; i < kLanes; ++i) {
    const auto lane = static_cast<Lane>(i);
    for (const traffic::Car& car : engine_.lane(lane).cars()) {
      if (!car.unit.listens(batch.rsu, batch.step + 1, lost_after)) continue;
      Hop hop = hop_to(lane, car, batch, frame);
      hop.computing_ms = 0.0;  // no algorithm has a part in it
      const Reception reception = modem_.receive(hop);
      if (!reception.lost) spats_.add(reception, hop, {car.temporary_id, batch.rsu});
    }
  }
}

void EngineNode::hear_coordination(const RoadsideBatch& batch, std::size_t frame) {
  const std::uint32_t sequence = batch.frames.sequence[frame];
  const auto message = decode_rsc(batch.frames.payload_of(frame));
  if (!message) {
    fates_.push_back({.vehicle = traffic::kNoVehicle,
                      .rsu = batch.rsu,
                      .sequence = sequence,
                      .fate = AdviceFate::kMalformed,
                      .issued = -1,
                      .commanded_mps2 = std::numeric_limits<double>::quiet_NaN()});
    return;
  }
  const Step issued = step_of_second_mark(batch.step, message.value().second_mark_ms);
  for (const VehicleCoordination& asked : message.value().vehicles) {
    traffic::Advice advice = advice_of(asked);
    advice.issued = issued;
    advice.rsu = batch.rsu;
    advice.sequence = sequence;
    pass_on(std::move(advice), batch, frame);
  }
  for (const LaneSpeed& word : message.value().lanes) {
    const traffic::Advice advice{.acceleration_mps2 = std::numeric_limits<double>::quiet_NaN(),
                                 .issued = issued,
                                 .lifetime = steps_of_life(word.lifetime_ms),
                                 .rsu = batch.rsu,
                                 .sequence = sequence,
                                 .kind = traffic::AdviceKind::kLaneSpeed,
                                 .speed_mps = word.speed_mps};
    say_on_lane(word, advice, batch, frame);
  }
}

void EngineNode::say_on_lane(const LaneSpeed& word, traffic::Advice advice, const RoadsideBatch& batch,
                             std::size_t frame) {
  for (const traffic::Car& car : engine_.lane(word.lane).cars()) {
    if (!car.equipped || car.stage == traffic::Stage::kExit) continue;
    advice.target = car.temporary_id;
    pass_on(traffic::Advice(advice), batch, frame);
  }
}

void EngineNode::pass_on(traffic::Advice&& advice, const RoadsideBatch& batch, std::size_t frame) {
  if (config_.radio.modelled) {
    send(advice, batch, frame);
  } else if (computing_ms(batch) > 0) {
    delay(advice, batch, frame);
  } else {
    advice_.push_back(std::move(advice));
  }
}

void EngineNode::delay(const traffic::Advice& advice, const RoadsideBatch& batch, std::size_t frame) {
  const auto target = engine_.equipped_car(advice.target);
  if (!target) {
    advice_.push_back(advice);
    return;
  }
  const Hop hop = hop_to(target->lane, *target->car, batch, frame);
  inbox_.add(modem_.receive(hop), hop, advice);
}

EngineNode::Fate EngineNode::fate_of(const traffic::Advice& advice, std::uint32_t vehicle, AdviceFate fate) {
  return {vehicle,     advice.rsu,      advice.sequence, fate, advice.issued, advice.acceleration_mps2,
          advice.kind, advice.speed_mps};
}

void EngineNode::send(const traffic::Advice& advice, const RoadsideBatch& batch, std::size_t frame) {
  const auto target = engine_.equipped_car(advice.target);
  if (!target) {
    advice_.push_back(advice);  // nobody is there to miss it: the engine says so
    return;
  }
  const Hop hop = hop_to(target->lane, *target->car, batch, frame);
  const Reception reception = modem_.receive(hop);
  tally_.count_sent(reception);
  if (!reception.lost) {
    inbox_.add(reception, hop, advice);
  } else if (!advice.release) {
    const AdviceFate fate = loss_fate(*reception.lost);
    fates_.push_back(fate_of(advice, target->car->vehicle, fate));
    engine_.miss(advice, static_cast<std::uint8_t>(fate));
  }
}

Hop EngineNode::hop_to(Lane lane, const traffic::Car& car, const RoadsideBatch& batch, std::size_t frame) {
  const traffic::EngineParameters& parameters = engine_.parameters();
  const Pose pose = pose_on_path(parameters.road, lane, car.motion.position_m);
  const PlanePoint antenna = centre_of_car({pose.x_m, pose.y_m}, pose.heading_rad, parameters.vehicles.length_m);
  const PlanePoint mast{batch.frames.antenna_x_m[frame], batch.frames.antenna_y_m[frame]};
  Hop hop{.sender = batch.frames.sender[frame],
          .receiver = car.temporary_id,
          .sequence = batch.frames.sequence[frame],
          .kind = batch.frames.kind[frame],
          .sent = batch.step,
          .distance_m = distance_m(mast, antenna),
          .car = antenna,
          .other = mast,
          .rsu = batch.rsu,
          .epoch = batch.epoch,
          .place = static_cast<std::uint32_t>(frame),
          .car_speed_mps = car.motion.speed_mps,
          .computing_ms = static_cast<double>(computing_ms(batch))};
  if (modem_.asks_for_collisions()) {
    hop.collision_probability = load_.collision_from_mast(antenna, load_.width(batch.frames.wire_bytes[frame]));
  }
  return hop;
}

void EngineNode::deliver(Step now) {
  for (const auto& item : spats_.take(now)) engine_.hear_rsu(item.content.target, item.content.rsu, now);
  for (const auto& item : inbox_.take(now)) {
    const traffic::Advice& advice = item.content;
    tally_.count_delivered(item.arrival.latency_ms, item.duplicate);
    if (!item.duplicate) {
      advice_.push_back(advice);
    } else if (!advice.release) {
      const auto target = engine_.equipped_car(advice.target);
      fates_.push_back(fate_of(advice, target ? target->car->vehicle : traffic::kNoVehicle, AdviceFate::kDuplicate));
    }
  }
}

void EngineNode::report_fates(TrafficBatch& traffic) const {
  for (const Fate& known : fates_) {
    traffic.fate_vehicle.push_back(known.vehicle);
    traffic.fate_rsu.push_back(known.rsu);
    traffic.fate_sequence.push_back(known.sequence);
    traffic.fate.push_back(static_cast<std::uint8_t>(known.fate));
    traffic.fate_again.push_back(0);
    traffic.fate_issued.push_back(known.issued);
    traffic.fate_commanded_mps2.push_back(known.commanded_mps2);
    traffic.fate_kind.push_back(static_cast<std::uint8_t>(known.kind));
    traffic.fate_speed_mps.push_back(known.speed_mps);
  }
}

void EngineNode::report_reception(std::span<const RoadsideBatch* const> roadside, TrafficBatch& traffic) const {
  if (!config_.radio.modelled) return;
  traffic.reception.add(Direction::kDownlink, FrameKind::kRsc, tally_);
  if (between_cars_.drawn()) {
    traffic.reception.add(Direction::kVehicleToVehicle, FrameKind::kBsm, between_cars_.tally());
  }
  for (const RoadsideBatch* batch : roadside)
    if (batch != nullptr) traffic.reception.add(batch->reception);
}

Expected<Done> EngineNode::report_uplink(const RoadsideBatch& batch, TrafficBatch& traffic) const {
  const FrameFates& told = batch.uplink;
  if (told.size() == 0) return Done{};
  if (!told.well_formed() || told.size() != speakers_.size()) {
    return Error{"topic lukou/roadside", "what rsu" + std::to_string(batch.rsu) + " heard in step " +
                                             std::to_string(batch.step) + " speaks of " + std::to_string(told.size()) +
                                             " frames, must speak of the " + std::to_string(speakers_.size()) +
                                             " that were sent"};
  }
  traffic.uplink_vehicle.insert(traffic.uplink_vehicle.end(), speakers_.begin(), speakers_.end());
  traffic.uplink_rsu.insert(traffic.uplink_rsu.end(), speakers_.size(), batch.rsu);
  traffic.uplink.add(told);
  return Done{};
}

void EngineNode::report_frames(std::span<const RoadsideBatch* const> roadside, const AirBatch& air,
                               TrafficBatch& traffic) {
  traffic.air = air.frames;
  traffic.sensed = air.sensed;
  for (const RoadsideBatch* batch : roadside) {
    if (batch == nullptr) continue;
    traffic.said.append(batch->frames);
    traffic.said_rsu.resize(traffic.said.size(), batch->rsu);
    if (batch->request_lanes.empty()) continue;
    traffic.asked_rsu.push_back(batch->rsu);
    traffic.asked_lanes.push_back(batch->request_lanes.front());
    traffic.asked_lifetime.push_back(batch->request_lifetime.front());
  }
}

}  // namespace lukou
