#include "services/traffic_engine/traffic_report.hpp"

namespace lukou {
namespace {

using traffic::AdviceOutcome;
using traffic::Decider;
using traffic::Guidance;
using traffic::Stage;

// The model's words are those of the bus.
static_assert(static_cast<int>(Stage::kIn) == static_cast<int>(CarState::kIn));
static_assert(static_cast<int>(Stage::kBlock) == static_cast<int>(CarState::kBlock));
static_assert(static_cast<int>(Stage::kCommitted) == static_cast<int>(CarState::kCommitted));
static_assert(static_cast<int>(Stage::kExit) == static_cast<int>(CarState::kExit));
static_assert(static_cast<int>(AdviceOutcome::kApplied) == static_cast<int>(AdviceFate::kApplied));
static_assert(static_cast<int>(AdviceOutcome::kChangedLimit) == static_cast<int>(AdviceFate::kChangedLimit));
static_assert(static_cast<int>(AdviceOutcome::kChangedGuard) == static_cast<int>(AdviceFate::kChangedGuard));
static_assert(static_cast<int>(AdviceOutcome::kChangedFollowing) == static_cast<int>(AdviceFate::kChangedFollowing));
static_assert(static_cast<int>(AdviceOutcome::kChangedRed) == static_cast<int>(AdviceFate::kChangedRed));
static_assert(static_cast<int>(AdviceOutcome::kPastStopLine) == static_cast<int>(AdviceFate::kPastStopLine));
static_assert(static_cast<int>(AdviceOutcome::kExpired) == static_cast<int>(AdviceFate::kExpired));
static_assert(static_cast<int>(AdviceOutcome::kSuperseded) == static_cast<int>(AdviceFate::kSuperseded));
static_assert(static_cast<int>(AdviceOutcome::kUnknownVehicle) == static_cast<int>(AdviceFate::kUnknownVehicle));
static_assert(static_cast<int>(AdviceOutcome::kMalformed) == static_cast<int>(AdviceFate::kMalformed));
static_assert(static_cast<int>(AdviceOutcome::kOutOfLimit) == static_cast<int>(AdviceFate::kOutOfLimit));
static_assert(static_cast<int>(AdviceOutcome::kStale) == static_cast<int>(AdviceFate::kStale));
static_assert(static_cast<int>(AdviceOutcome::kNotComplied) == static_cast<int>(AdviceFate::kNotComplied));
static_assert(static_cast<int>(AdviceOutcome::kChangedDriver) == static_cast<int>(AdviceFate::kChangedDriver));
static_assert(static_cast<int>(AdviceOutcome::kLate) == static_cast<int>(AdviceFate::kLate));
static_assert(static_cast<int>(traffic::AdviceKind::kAcceleration) == static_cast<int>(AdviceKind::kAcceleration));
static_assert(static_cast<int>(traffic::AdviceKind::kProfile) == static_cast<int>(AdviceKind::kProfile));
static_assert(static_cast<int>(traffic::AdviceKind::kSpeed) == static_cast<int>(AdviceKind::kSpeed));
static_assert(static_cast<int>(traffic::AdviceKind::kLaneSpeed) == static_cast<int>(AdviceKind::kLaneSpeed));
static_assert(static_cast<int>(Guidance::kNeverAdvised) == static_cast<int>(GuidanceState::kNeverAdvised));
static_assert(static_cast<int>(Guidance::kInForce) == static_cast<int>(GuidanceState::kInForce));
static_assert(static_cast<int>(Guidance::kReleased) == static_cast<int>(GuidanceState::kReleased));
static_assert(static_cast<int>(Guidance::kExpired) == static_cast<int>(GuidanceState::kExpired));
static_assert(static_cast<int>(Guidance::kRsuUnheard) == static_cast<int>(GuidanceState::kRsuUnheard));
static_assert(static_cast<int>(Guidance::kNotComplied) == static_cast<int>(GuidanceState::kNotComplied));
static_assert(static_cast<int>(Guidance::kPastStopLine) == static_cast<int>(GuidanceState::kPastStopLine));
static_assert(static_cast<int>(Guidance::kReacting) == static_cast<int>(GuidanceState::kReacting));
static_assert(static_cast<int>(Decider::kOwnWish) == static_cast<int>(BoundBy::kOwnWish));
static_assert(static_cast<int>(Decider::kCarAhead) == static_cast<int>(BoundBy::kCarAhead));
static_assert(static_cast<int>(Decider::kLight) == static_cast<int>(BoundBy::kLight));
static_assert(static_cast<int>(Decider::kAdvice) == static_cast<int>(BoundBy::kAdvice));
static_assert(static_cast<int>(Decider::kLimit) == static_cast<int>(BoundBy::kLimit));
static_assert(static_cast<int>(Decider::kGuard) == static_cast<int>(BoundBy::kGuard));
static_assert(static_cast<int>(Decider::kBlock) == static_cast<int>(BoundBy::kBlock));

/// A missed word is forgotten when it was issued longer ago than this: 5 s.
constexpr Step kMissedWindow = 50;

std::uint8_t guidance_of(const traffic::Car& car) {
  return static_cast<std::uint8_t>(car.equipped ? static_cast<GuidanceState>(car.unit.state())
                                                : GuidanceState::kNotEquipped);
}

std::uint8_t missed_of(const traffic::Car& car, Step step) {
  const bool counts = car.missed.order > car.unit.newest() && step - car.missed.order.issued <= kMissedWindow;
  return counts ? car.missed.fate : kNothingMissed;
}

void report_cars(const traffic::Engine& engine, Step step, TrafficBatch& batch) {
  for (int i = 0; i < kLanes; ++i) {
    for (const traffic::Car& car : engine.lane(static_cast<Lane>(i)).cars()) {
      batch.vehicle.push_back(car.vehicle);
      batch.lane.push_back(static_cast<std::uint8_t>(i));
      batch.state.push_back(static_cast<std::uint8_t>(car.stage));
      batch.equipped.push_back(car.equipped ? 1 : 0);
      batch.position_m.push_back(car.motion.position_m);
      batch.speed_mps.push_back(car.motion.speed_mps);
      batch.acceleration_mps2.push_back(car.motion.acceleration_mps2);
      batch.commanded_mps2.push_back(car.commanded_mps2);
      batch.noise_mps2.push_back(car.noise_mps2);
      batch.guidance.push_back(guidance_of(car));
      batch.bound_by.push_back(static_cast<std::uint8_t>(car.decider));
      batch.missed.push_back(missed_of(car, step));
    }
  }
}

void report_events(const traffic::Engine& engine, TrafficBatch& batch) {
  for (const traffic::Entry& entry : engine.entries()) {
    batch.entered_vehicle.push_back(entry.vehicle);
    batch.entered_lane.push_back(static_cast<std::uint8_t>(entry.lane));
    batch.entered_equipped.push_back(entry.equipped ? 1 : 0);
    batch.entered_speed_mps.push_back(entry.speed_mps);
    batch.entered_desired_speed_mps.push_back(entry.desired_speed_mps);
  }
  const traffic::LaneEvents& events = engine.events();
  for (const traffic::Crossing& crossing : events.crossings) {
    batch.crossed_vehicle.push_back(crossing.vehicle);
    batch.crossed_time_s.push_back(crossing.time_s);
    batch.crossed_aspect.push_back(static_cast<std::uint8_t>(crossing.aspect));
    batch.crossed_committed.push_back(crossing.committed ? 1 : 0);
  }
  for (const traffic::Departure& departure : events.departures) {
    batch.left_vehicle.push_back(departure.vehicle);
    batch.left_time_s.push_back(departure.time_s);
  }
  for (const traffic::OutcomeEvent& outcome : events.outcomes) {
    batch.fate_vehicle.push_back(outcome.vehicle);
    batch.fate_rsu.push_back(outcome.rsu);
    batch.fate_sequence.push_back(outcome.sequence);
    batch.fate.push_back(static_cast<std::uint8_t>(outcome.outcome));
    batch.fate_again.push_back(outcome.again ? 1 : 0);
    batch.fate_issued.push_back(outcome.issued);
    batch.fate_commanded_mps2.push_back(outcome.command_mps2);
    batch.fate_kind.push_back(static_cast<std::uint8_t>(outcome.kind));
    batch.fate_speed_mps.push_back(outcome.speed_mps);
  }
  batch.guard_interventions = events.guard_interventions;
}

}  // namespace

void report(const traffic::Engine& engine, Step step, TrafficBatch& batch) {
  batch.clear();
  batch.step = step;
  report_cars(engine, step, batch);
  report_events(engine, batch);
  for (const Approach approach : kAllApproaches) {
    batch.arrived.push_back(engine.arrived(approach));
    batch.waiting.push_back(engine.waiting(approach));
    batch.arrived_equipped.push_back(engine.arrived_equipped(approach));
    batch.waiting_equipped.push_back(engine.waiting_equipped(approach));
  }
  batch.overflow = engine.overflows() ? 1 : 0;
}

}  // namespace lukou
