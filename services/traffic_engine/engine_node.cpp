#include "services/traffic_engine/engine_node.hpp"

#include <algorithm>
#include <string>

#include "common/core/contract.hpp"
#include "common/intersection/geometry.hpp"
#include "common/messages/bsm.hpp"
#include "common/messages/rsc.hpp"
#include "common/messages/time_marks.hpp"
#include "services/traffic_engine/traffic_report.hpp"

namespace lukou {
namespace {

constexpr std::uint32_t kMessageCounts = 128;  ///< a message count is modulo this
/// A car whose deceleration is at least this [m/s2] shows its brakes; assumed.
constexpr double kBrakePedal_mps2 = 0.5;

/// Steps that begin within a lifetime: an advice of 250 ms acts in three.
Step steps_of_life(std::uint32_t lifetime_ms) { return (static_cast<Step>(lifetime_ms) + kStep_ms - 1) / kStep_ms; }

AdviceFate fate_of(LossCause cause) {
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
      between_cars_(config.radio) {}

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
  config_.radio = config.radio;
  modem_.use(config.radio.downlink, downlink_surroundings(config.radio));
  load_.use(config.radio.load, next_);
  between_cars_.use(config.radio);
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
  if (config_.radio.modelled) deliver(k - 1);
  engine_.step(k, k > 0 ? promise_.at(k - 1) : Heads{}, advice_);
  promise_.forget_before(k);

  report(engine_, k, traffic);
  report_fates(traffic);
  if (auto done = report_reception(roadside, traffic); !done) return done;
  for (const RoadsideBatch* batch : roadside) {
    traffic.heard_epoch.push_back(batch != nullptr ? batch->epoch : 0);
    if (batch != nullptr) traffic.answers_malformed += batch->answers_malformed;
  }
  air.step = k;
  air.frames.clear();
  speak(k, air.frames);
  load_.add_air(air.frames, k);
  between_cars_.hear(air.frames, k, load_);
  next_ = k + 1;
  return Done{};
}

void EngineNode::hear(const RoadsideBatch& batch) {
  for (std::size_t frame = 0; frame < batch.frames.size(); ++frame) {
    if (batch.frames.kind[frame] != static_cast<std::uint8_t>(FrameKind::kRsc)) continue;
    hear_coordination(batch, frame);
  }
}

void EngineNode::hear_coordination(const RoadsideBatch& batch, std::size_t frame) {
  const std::uint32_t sequence = batch.frames.sequence[frame];
  const auto message = decode_rsc(batch.frames.payload_of(frame));
  if (!message) {
    fates_.push_back({traffic::kNoVehicle, batch.rsu, sequence, AdviceFate::kMalformed});
    return;
  }
  const Step issued = step_of_second_mark(batch.step, message.value().second_mark_ms);
  for (const VehicleCoordination& asked : message.value().vehicles) {
    traffic::Advice advice{.target = asked.vehicle,
                           .acceleration_mps2 = 0.0,
                           .binding = asked.binding == Binding::kFollowing ? traffic::AdviceBinding::kFollowing
                                                                           : traffic::AdviceBinding::kGuard,
                           .release = !asked.path,
                           .issued = issued,
                           .lifetime = 0,
                           .rsu = batch.rsu,
                           .sequence = sequence};
    if (asked.path) {
      advice.acceleration_mps2 = asked.path->acceleration_mps2;
      advice.lifetime = steps_of_life(asked.path->lifetime_ms);
    }
    if (config_.radio.modelled) {
      send(advice, batch, frame);
    } else {
      advice_.push_back(advice);
    }
  }
}

void EngineNode::send(const traffic::Advice& advice, const RoadsideBatch& batch, std::size_t frame) {
  const auto target = engine_.equipped_car(advice.target);
  if (!target) {
    advice_.push_back(advice);  // nobody is there to miss it: the engine says so
    return;
  }
  const Pose pose = pose_on_path(engine_.parameters().road, target->lane, target->car->motion.position_m);
  const PlanePoint car = centre_of_car({pose.x_m, pose.y_m}, pose.heading_rad, engine_.parameters().vehicles.length_m);
  const PlanePoint mast{batch.frames.antenna_x_m[frame], batch.frames.antenna_y_m[frame]};
  Hop hop{.sender = batch.frames.sender[frame],
          .receiver = advice.target,
          .sequence = advice.sequence,
          .sent = batch.step,
          .distance_m = distance_m(mast, car),
          .car = car,
          .other = mast,
          .rsu = batch.rsu,
          .epoch = batch.epoch,
          .place = static_cast<std::uint32_t>(frame),
          .car_speed_mps = target->car->motion.speed_mps};
  if (modem_.asks_for_collisions()) {
    hop.collision_probability = load_.collision_from_mast(car, load_.width(batch.frames.wire_bytes[frame]));
  }
  const Reception reception = modem_.receive(hop);
  tally_.count_sent(reception);
  if (!reception.lost) {
    inbox_.add(reception, hop, advice);
  } else if (!advice.release) {
    fates_.push_back({target->car->vehicle, advice.rsu, advice.sequence, fate_of(*reception.lost)});
  }
}

void EngineNode::deliver(Step now) {
  for (const auto& item : inbox_.take(now)) {
    const traffic::Advice& advice = item.content;
    tally_.count_delivered(item.arrival.latency_ms, item.duplicate);
    if (!item.duplicate) {
      advice_.push_back(advice);
    } else if (!advice.release) {
      const auto target = engine_.equipped_car(advice.target);
      fates_.push_back(
          {target ? target->car->vehicle : traffic::kNoVehicle, advice.rsu, advice.sequence, AdviceFate::kDuplicate});
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
  }
}

Expected<Done> EngineNode::report_reception(std::span<const RoadsideBatch* const> roadside,
                                            TrafficBatch& traffic) const {
  if (!config_.radio.modelled) return Done{};
  traffic.reception.add(Direction::kDownlink, FrameKind::kRsc, tally_);
  if (between_cars_.drawn()) {
    traffic.reception.add(Direction::kVehicleToVehicle, FrameKind::kBsm, between_cars_.tally());
  }
  for (const RoadsideBatch* batch : roadside) {
    if (batch == nullptr) continue;
    if (!batch->reception.well_formed()) {
      return Error{"roadside", "the reception report of rsu" + std::to_string(batch->rsu) + " has broken columns"};
    }
    traffic.reception.add(batch->reception);
  }
  return Done{};
}

void EngineNode::speak(Step k, Frames& frames) const {
  const traffic::EngineParameters& parameters = engine_.parameters();
  BasicSafety message;
  message.second_mark_ms = second_mark_ms(k);
  message.length_m = parameters.vehicles.length_m;
  message.width_m = parameters.vehicles.width_m;
  for (int i = 0; i < kLanes; ++i) {
    const auto lane = static_cast<Lane>(i);
    for (const traffic::Car& car : engine_.lane(lane).cars()) {
      if (!car.equipped) continue;
      const Pose pose = pose_on_path(parameters.road, lane, car.motion.position_m);
      const auto sequence = static_cast<std::uint32_t>(k - car.entered);
      message.temporary_id = car.temporary_id;
      message.count = static_cast<std::uint8_t>(sequence % kMessageCounts);
      message.centre = centre_of_car({pose.x_m, pose.y_m}, pose.heading_rad, message.length_m);
      message.speed_mps = car.motion.speed_mps;
      message.heading_rad = pose.heading_rad;
      message.acceleration_mps2 = car.motion.acceleration_mps2;
      message.braking = car.motion.acceleration_mps2 <= -kBrakePedal_mps2;
      append(frames,
             {.sender = car.temporary_id,
              .sequence = sequence,
              .antenna_x_m = message.centre.x_m,
              .antenna_y_m = message.centre.y_m},
             message);
    }
  }
}

}  // namespace lukou
