#include "services/traffic_engine/model/lane_traffic.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/core/contract.hpp"
#include "common/core/keyed_random.hpp"

namespace lukou::traffic {
namespace {

// Source of all: study of the model, e3 and e8.
constexpr double kFrontSpare_m = 0.5;    ///< the first car of a block stops this far before the line
constexpr double kSpacingSpare_m = 0.1;  ///< the others this much farther than the standstill spacing
constexpr double kJoinDistance_m = 0.3;
constexpr double kJoinSpeed_mps = 0.3;

/// A stopping point grows by up to a_max dt^2 / 8 in the step in which the car comes to stand. No stopping point of a
/// car that the light holds lies closer to the line than that and a little more: 5 mm at 3 m/s2.
double line_margin_m(double braking_mps2) {
  constexpr double kSpare_m = 0.00125;
  return braking_mps2 * kStep_s * kStep_s / 8.0 + kSpare_m;
}
constexpr double kCommitMargin_m = 0.005;  ///< a car is held if its stopping point keeps this more than the margin

// A FOLLOWING advice leaves out the comfortable braking for red, unless more than this would be needed or the car
// nearly stands. Source: guidance study.
constexpr double kHardBraking_mps2 = 2.5;
constexpr double kCrawling_mps = 1.0;

/// Differences of acceleration [m/s2] below this are rounding.
constexpr double kRounding_mps2 = 1e-9;

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

}  // namespace

void LaneEvents::clear() {
  crossings.clear();
  departures.clear();
  outcomes.clear();
  guard_interventions = 0;
}

LaneTraffic::LaneTraffic(const EngineParameters& parameters)
    : parameters_(parameters),
      law_(parameters.vehicles, parameters.driving),
      delay_steps_(static_cast<std::size_t>(step_at_or_after(parameters.driving.reaction_time_s) - 1)) {
  LUKOU_EXPECT(parameters.driving.reaction_time_s >= kStep_s);
}

std::optional<Motion> LaneTraffic::last() const {
  if (cars_.empty()) return std::nullopt;
  return cars_.back().motion;
}

Car* LaneTraffic::find(std::uint32_t vehicle) {
  // Cars of an approach enter in the order of their numbers, and nobody overtakes.
  const auto found = std::ranges::lower_bound(cars_, vehicle, {}, &Car::vehicle);
  return found != cars_.end() && found->vehicle == vehicle ? &*found : nullptr;
}

const Car* LaneTraffic::find(std::uint32_t vehicle) const {
  const auto found = std::ranges::lower_bound(cars_, vehicle, {}, &Car::vehicle);
  return found != cars_.end() && found->vehicle == vehicle ? &*found : nullptr;
}

void LaneTraffic::enter(const Car& car) {
  cars_.push_back(car);
  natural_mps2_.resize(natural_mps2_.size() + delay_steps_, 0.0);
}

void LaneTraffic::advance(Step step, Aspect aspect, const UnitRules& rules, LaneEvents& events) {
  const bool green = aspect == Aspect::kGreen;
  note_light(green);
  if (!green) let_the_first_join_the_block();
  before_.clear();
  for (const Car& car : cars_) before_.push_back(car.motion);

  double block_mps = block_target_mps(green);
  double stop_target_m = parameters_.road.approach_m - kFrontSpare_m;
  bool block_open = true;  // false: a car has left the block, and the cars behind it with it
  bool block_has_front = false;
  bool line_holds_one = green;  // true: the first car that may not cross is already found
  bool target_given = green;
  for (std::size_t place = 0; place < cars_.size(); ++place) {
    Car& car = cars_[place];
    car.unit.advance(step, car.motion.speed_mps, rules, car.vehicle, events.outcomes);
    View view{.step = step,
              .ahead = nullptr,
              .moved_ahead = nullptr,
              .stop_target_m = {},
              .held_by_line = false,
              .fallback = rules.fallback};
    if (place > 0) view.ahead = &before_[place - 1], view.moved_ahead = &cars_[place - 1].motion;
    if (car.stage == Stage::kBlock && (!block_open || leaves_block(car, block_mps))) {
      car.stage = Stage::kIn;
      block_open = false;
    }
    const bool may_not_cross = car.stage == Stage::kIn || car.stage == Stage::kBlock;
    view.held_by_line = may_not_cross && !line_holds_one;
    line_holds_one = line_holds_one || may_not_cross;
    if (car.stage == Stage::kBlock) {
      block_mps = move_in_block(car, view, block_mps, !block_has_front, events);
      block_has_front = true;
      stop_target_m = before_[place].position_m - parameters_.driving.standstill_spacing_m - kSpacingSpare_m;
      continue;
    }
    if (car.stage == Stage::kIn && !target_given) {
      view.stop_target_m = stop_target_m;
      target_given = true;
    }
    move_freely(car, place, view, events);
  }
  block_speed_mps_ = block_has_front ? block_mps : 0.0;
  note_crossings(step, aspect, events);
}

void LaneTraffic::note_light(bool green) {
  const bool green_ended = was_green_ && !green;
  was_green_ = green;
  if (!green && !green_ended) return;
  const double braking_mps2 = parameters_.vehicles.acceleration_max_mps2;
  const double last_stop_m = parameters_.road.approach_m - line_margin_m(braking_mps2) - kCommitMargin_m;
  for (Car& car : cars_) {
    if (car.stage == Stage::kExit) continue;
    if (green && car.stage == Stage::kCommitted) car.stage = Stage::kIn;
    if (green_ended && stopping_point_m(car.motion.position_m, car.motion.speed_mps, braking_mps2) > last_stop_m) {
      car.stage = Stage::kCommitted;
    }
  }
}

void LaneTraffic::let_the_first_join_the_block() {
  if (block_speed_mps_ > 0.0) return;
  // Joining stops the car within a step: no faster than the limit of acceleration allows.
  const double join_mps = std::min(kJoinSpeed_mps, parameters_.vehicles.acceleration_max_mps2 * kStep_s);
  double target_m = parameters_.road.approach_m - kFrontSpare_m;
  for (Car& car : cars_) {
    if (car.stage == Stage::kBlock) {
      target_m = car.motion.position_m - parameters_.driving.standstill_spacing_m - kSpacingSpare_m;
    }
    if (car.stage != Stage::kIn) continue;
    const bool commanded = car.unit.in_force() && car.unit.binding() == AdviceBinding::kGuard;
    const bool there = target_m - car.motion.position_m <= kJoinDistance_m && car.motion.speed_mps <= join_mps;
    if (there && !commanded) car.stage = Stage::kBlock;
    return;
  }
}

double LaneTraffic::block_target_mps(bool green) const {
  const double change_mps = parameters_.vehicles.acceleration_max_mps2 * kStep_s;
  return green ? std::min(block_speed_mps_ + change_mps, parameters_.driving.discharge_speed_mps)
               : std::max(block_speed_mps_ - change_mps, 0.0);
}

bool LaneTraffic::leaves_block(const Car& car, double block_mps) const {
  if (!car.unit.in_force()) return false;
  const double next_mps =
      std::clamp(car.motion.speed_mps + car.unit.acted_mps2() * kStep_s, 0.0, parameters_.vehicles.speed_limit_mps);
  const double difference_mps = next_mps - block_mps;
  if (difference_mps < -kRounding_mps2 * kStep_s) return true;
  return car.unit.binding() == AdviceBinding::kGuard && difference_mps > kRounding_mps2 * kStep_s;
}

double LaneTraffic::move_in_block(Car& car, const View& view, double block_mps, bool front, LaneEvents& events) {
  const double next_mps = front ? guarded_mps(car, view, block_mps) : block_mps;
  const bool guarded = next_mps < block_mps;
  if (guarded) ++events.guard_interventions;
  Motion& motion = car.motion;
  car.noise_mps2 = 0.0;
  car.commanded_mps2 = kNone;
  car.decider = front ? Decider::kLight : Decider::kBlock;
  if (car.unit.in_force()) {
    car.commanded_mps2 = car.unit.command_mps2();
    const double excess_mps2 = car.unit.acted_mps2() - (block_mps - motion.speed_mps) / kStep_s;
    AdviceOutcome outcome = guarded ? AdviceOutcome::kChangedGuard : AdviceOutcome::kApplied;
    if (std::abs(excess_mps2) > kRounding_mps2) outcome = AdviceOutcome::kChangedLimit;
    if (excess_mps2 > kRounding_mps2 && car.unit.binding() == AdviceBinding::kFollowing) {
      outcome = AdviceOutcome::kChangedFollowing;
    }
    if (outcome == AdviceOutcome::kApplied) car.decider = Decider::kAdvice;
    car.unit.used(outcome, car.vehicle, events.outcomes);
  }
  if (guarded) car.decider = Decider::kGuard;
  motion.position_m = advanced_m(motion.position_m, motion.speed_mps, next_mps);
  motion.acceleration_mps2 = (next_mps - motion.speed_mps) / kStep_s;
  motion.speed_mps = next_mps;
  return next_mps;
}

void LaneTraffic::move_freely(Car& car, std::size_t place, const View& view, LaneEvents& events) {
  Motion& motion = car.motion;
  const Wanted want = wanted(car, place, view, events);
  car.noise_mps2 = 0.0;
  if (motion.speed_mps > 0.0 && parameters_.vehicles.actuation_noise_mps2 > 0.0) {
    car.noise_mps2 =
        parameters_.vehicles.actuation_noise_mps2 * standard_normal({.run_seed = parameters_.seed,
                                                                     .purpose = Purpose::kActuationNoise,
                                                                     .entity = car.vehicle,
                                                                     .index = static_cast<std::uint64_t>(view.step)});
  }
  const double limit_mps2 = parameters_.vehicles.acceleration_max_mps2;
  const double unlimited_mps2 = want.acceleration_mps2 + car.noise_mps2;
  const double limited_mps =
      std::clamp(motion.speed_mps + std::clamp(unlimited_mps2, -limit_mps2, limit_mps2) * kStep_s, 0.0,
                 parameters_.vehicles.speed_limit_mps);
  const double next_mps = guarded_mps(car, view, limited_mps);
  const bool guarded = next_mps < limited_mps;
  if (guarded) ++events.guard_interventions;

  car.decider = want.decider;
  if (car.unit.in_force()) {
    AdviceOutcome outcome = want.outcome;
    // Exact: the same product and sum unless a limit has cut it.
    const bool limited = motion.speed_mps + unlimited_mps2 * kStep_s != limited_mps;
    if (outcome == AdviceOutcome::kApplied && limited) outcome = AdviceOutcome::kChangedLimit;
    if (outcome == AdviceOutcome::kChangedLimit) car.decider = Decider::kLimit;
    if (outcome == AdviceOutcome::kApplied && guarded) outcome = AdviceOutcome::kChangedGuard;
    car.unit.used(outcome, car.vehicle, events.outcomes);
  }
  if (guarded) car.decider = Decider::kGuard;
  motion.position_m = advanced_m(motion.position_m, motion.speed_mps, next_mps);
  motion.acceleration_mps2 = (next_mps - motion.speed_mps) / kStep_s;
  motion.speed_mps = next_mps;
}

double LaneTraffic::wished_mps(Car& car, LaneEvents& events) {
  const double lane_mps = car.unit.lane_speed_mps();
  if (lane_mps == std::numeric_limits<double>::infinity() || car.unit.in_force()) return car.desired_speed_mps;
  car.unit.kept_to_lane_speed(car.vehicle, events.outcomes);
  return std::min(lane_mps, car.desired_speed_mps);
}

LaneTraffic::Wanted LaneTraffic::wanted(Car& car, std::size_t place, const View& view, LaneEvents& events) {
  const double wish_mps = wished_mps(car, events);
  const double following_mps2 = view.ahead != nullptr ? law_.following_mps2(car.motion, wish_mps, *view.ahead)
                                                      : law_.free_mps2(car.motion.speed_mps, wish_mps);
  double natural_mps2 = following_mps2;
  Decider decider = view.ahead != nullptr && following_mps2 <= 0.0 ? Decider::kCarAhead : Decider::kOwnWish;
  if (view.stop_target_m) {
    const double braking_mps2 = law_.braking_to_mps2(car.motion, wish_mps, *view.stop_target_m);
    if (braking_mps2 < natural_mps2) {
      natural_mps2 = braking_mps2;
      decider = Decider::kLight;
    }
  }
  natural_mps2 = delayed(place, natural_mps2);
  car.commanded_mps2 = kNone;
  if (!car.unit.in_force()) {
    const double share = car.unit.fallback_share(view.step, view.fallback);
    if (share > 0.0) natural_mps2 = faded(car, wish_mps, natural_mps2, share);
    return {natural_mps2, AdviceOutcome::kApplied, decider};
  }
  car.commanded_mps2 = car.unit.command_mps2();
  return commanded(car, view, following_mps2);
}

double LaneTraffic::faded(const Car& car, double wish_mps, double natural_mps2, double share) const {
  const double mixed_mps2 = share * car.unit.last_acted_mps2() + (1.0 - share) * natural_mps2;
  // Who is hindered brakes at once, with what the laws of braking ask for: comfort alone may wait.
  const bool hindered = natural_mps2 < law_.free_mps2(car.motion.speed_mps, wish_mps);
  return hindered ? std::min(natural_mps2, mixed_mps2) : mixed_mps2;
}

LaneTraffic::Wanted LaneTraffic::commanded(const Car& car, const View& view, double following_mps2) const {
  Wanted want{car.unit.acted_mps2(), AdviceOutcome::kApplied, Decider::kAdvice};
  if (car.unit.binding() == AdviceBinding::kGuard) return want;
  if (following_mps2 < want.acceleration_mps2) {
    want = {following_mps2, AdviceOutcome::kChangedFollowing,
            view.ahead != nullptr ? Decider::kCarAhead : Decider::kOwnWish};
  }
  if (!view.stop_target_m) return want;

  const double speed_mps = car.motion.speed_mps;
  const double distance_m = *view.stop_target_m - car.motion.position_m;
  const bool must_brake = speed_mps * speed_mps > 2.0 * kHardBraking_mps2 * distance_m || speed_mps < kCrawling_mps;
  if (!must_brake) return want;
  const double braking_mps2 = law_.braking_to_mps2(car.motion, car.desired_speed_mps, *view.stop_target_m);
  if (braking_mps2 >= want.acceleration_mps2) return want;
  const bool first_change = want.outcome == AdviceOutcome::kApplied;
  return {braking_mps2, first_change ? AdviceOutcome::kChangedRed : want.outcome, Decider::kLight};
}

double LaneTraffic::delayed(std::size_t place, double natural_mps2) {
  if (delay_steps_ == 0) return natural_mps2;
  const auto oldest = natural_mps2_.begin() + static_cast<std::ptrdiff_t>(place * delay_steps_);
  const auto end = oldest + static_cast<std::ptrdiff_t>(delay_steps_);
  const double acting_mps2 = *oldest;
  std::move(oldest + 1, end, oldest);
  *(end - 1) = natural_mps2;
  return acting_mps2;
}

double LaneTraffic::guarded_mps(const Car& car, const View& view, double next_mps) const {
  if (view.moved_ahead == nullptr && !view.held_by_line) return next_mps;
  const double braking_mps2 = parameters_.vehicles.acceleration_max_mps2;
  const double spacing_m = parameters_.driving.guard_spacing_m;
  constexpr double kUnbounded = std::numeric_limits<double>::infinity();
  Room room{kUnbounded, kUnbounded};
  if (view.moved_ahead != nullptr) {
    const Motion& ahead = *view.moved_ahead;
    room = {ahead.position_m - spacing_m,
            stopping_point_m(ahead.position_m, ahead.speed_mps, braking_mps2) - spacing_m};
  }
  if (view.held_by_line) {
    room.stopping_point_m = std::min(room.stopping_point_m, parameters_.road.approach_m - line_margin_m(braking_mps2));
  }
  return guarded_speed_mps(car.motion.position_m, car.motion.speed_mps, next_mps, room, braking_mps2);
}

void LaneTraffic::note_crossings(Step step, Aspect aspect, LaneEvents& events) {
  const double line_m = parameters_.road.approach_m;
  const double end_m = line_m + parameters_.road.exit_m;
  // Linear over the step between the positions at its ends.
  const auto passed_at_s = [&](std::size_t place, double mark_m) {
    const double from_m = before_[place].position_m;
    return time_s(step - 1) + kStep_s * (mark_m - from_m) / (cars_[place].motion.position_m - from_m);
  };
  std::size_t departed = 0;
  for (std::size_t place = 0; place < cars_.size() && cars_[place].motion.position_m >= line_m; ++place) {
    Car& car = cars_[place];
    if (car.stage != Stage::kExit) {
      events.crossings.push_back({car.vehicle, passed_at_s(place, line_m), aspect, car.stage == Stage::kCommitted});
      car.stage = Stage::kExit;
      car.unit.forget(car.vehicle, events.outcomes);
    }
    if (car.motion.position_m > end_m) {
      events.departures.push_back({car.vehicle, passed_at_s(place, end_m)});
      departed = place + 1;
    }
  }
  if (departed == 0) return;
  cars_.erase(cars_.begin(), cars_.begin() + static_cast<std::ptrdiff_t>(departed));
  natural_mps2_.erase(natural_mps2_.begin(),
                      natural_mps2_.begin() + static_cast<std::ptrdiff_t>(departed * delay_steps_));
}

}  // namespace lukou::traffic
