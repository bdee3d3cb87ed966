#include "services/traffic_engine/model/engine.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/core/contract.hpp"
#include "common/core/keyed_random.hpp"

namespace lukou::traffic {

Engine::Engine(const EngineParameters& parameters)
    : parameters_(parameters), law_(parameters_.vehicles, parameters_.driving) {
  LUKOU_EXPECT(parameters_.driving.guard_spacing_m <= parameters_.driving.standstill_spacing_m);
  lanes_.reserve(kLanes);
  for (int i = 0; i < kLanes; ++i) lanes_.emplace_back(parameters_);
  for (const Approach approach : kAllApproaches) {
    entrances_.push_back({.demand = Demand(parameters_.seed, approach, parameters_.demand[index(approach)]),
                          .waiting = {},
                          .arrived_equipped = 0,
                          .waiting_equipped = 0});
  }
}

void Engine::step(Step step, const Heads& heads, std::span<const Advice> advice) {
  LUKOU_EXPECT(step == next_step_);
  ++next_step_;
  events_.clear();
  entries_.clear();
  if (step == 0) return;
  for (const Advice& heard : advice) hear(heard, step);
  const UnitRules rules{.fallback = step_at_or_after(parameters_.unit.fallback_s),
                        .rsu_lost_after = step_at_or_after(parameters_.unit.rsu_lost_after_s),
                        .reaction = step_at_or_after(parameters_.compliance.reaction_s),
                        .threshold_mps2 = parameters_.compliance.threshold_mps2,
                        .speed_gain_time_s = parameters_.unit.speed_gain_time_s,
                        .speed_acceleration_mps2 = parameters_.unit.speed_acceleration_mps2,
                        .speed_deceleration_mps2 = parameters_.unit.speed_deceleration_mps2,
                        .everybody = heard_by_all_};
  for (std::size_t lane = 0; lane < lanes_.size(); ++lane) lanes_[lane].advance(step, heads[lane], rules, events_);
  forget_departed();
  overflows_ = false;
  for (const Approach approach : kAllApproaches) admit(approach, time_s(step));
}

void Engine::hear(const Advice& advice, Step step) {
  LUKOU_EXPECT(advice.issued < step);
  const auto refuse = [&](std::uint32_t vehicle, AdviceOutcome reason) {
    if (advice.release) return;
    events_.outcomes.push_back(outcome_of(advice, reason, vehicle));
  };
  Car* car = car_of(advice.target);
  if (car == nullptr) return refuse(kNoVehicle, AdviceOutcome::kUnknownVehicle);
  if (!advice.release && advice.kind <= AdviceKind::kProfile) {
    double largest_mps2 = std::abs(advice.acceleration_mps2);
    for (const LaterCommand& later : advice.later) {
      largest_mps2 = std::max(largest_mps2, std::abs(later.acceleration_mps2));
    }
    if (!std::isfinite(advice.acceleration_mps2)) return refuse(car->vehicle, AdviceOutcome::kMalformed);
    if (largest_mps2 > parameters_.vehicles.acceleration_max_mps2) {
      return refuse(car->vehicle, AdviceOutcome::kOutOfLimit);
    }
  }
  if (car->stage == Stage::kExit) return refuse(car->vehicle, AdviceOutcome::kPastStopLine);
  const std::size_t before = events_.outcomes.size();
  car->unit.take(advice, step, car->vehicle, events_.outcomes);
  const bool late = events_.outcomes.size() > before && events_.outcomes.back().outcome == AdviceOutcome::kLate;
  if (late) miss(advice, static_cast<std::uint8_t>(AdviceOutcome::kLate));
}

void Engine::hear_rsu(std::uint32_t rsu, Step heard) {
  if (rsu >= heard_by_all_.size()) heard_by_all_.resize(rsu + 1, -1);
  heard_by_all_[rsu] = heard;
}

void Engine::hear_rsu(std::uint64_t temporary_id, std::uint32_t rsu, Step heard) {
  if (Car* car = car_of(temporary_id)) car->unit.hear(rsu, heard);
}

void Engine::miss(const Advice& advice, std::uint8_t fate) {
  const bool asks_the_car = !advice.release && advice.kind != AdviceKind::kLaneSpeed;
  Car* car = asks_the_car ? car_of(advice.target) : nullptr;
  if (car != nullptr && order_of(advice) > car->missed.order) car->missed = {order_of(advice), fate};
}

Car* Engine::car_of(std::uint64_t temporary_id) {
  const Station* found = station(temporary_id);
  if (found == nullptr) return nullptr;
  Car* car = lanes_[index(found->lane)].find(found->vehicle);
  LUKOU_EXPECT(car != nullptr);
  return car;
}

void Engine::admit(Approach approach, double now_s) {
  Entrance& entrance = entrances_[index(approach)];
  for (std::uint32_t n = entrance.demand.taken(); const auto arrival_s = entrance.demand.next_until(now_s); ++n) {
    const std::uint32_t vehicle = vehicle_number(approach, n);
    const bool equipped = drawn_equipped(parameters_.seed, vehicle, parameters_.equipped_ratio);
    entrance.waiting.push_back({*arrival_s, vehicle, equipped});
    if (equipped) ++entrance.arrived_equipped, ++entrance.waiting_equipped;
  }
  while (!entrance.waiting.empty() && admit_first(approach)) {
  }
  if (!entrance.waiting.empty() && now_s - entrance.waiting.front().since_s > parameters_.overflow_wait_s) {
    overflows_ = true;
  }
}

bool Engine::admit_first(Approach approach) {
  Entrance& entrance = entrances_[index(approach)];
  std::array<std::optional<Motion>, kLanesPerApproach> last;
  std::array<bool, kLanesPerApproach> safe{};
  for (int i = 0; i < kLanesPerApproach; ++i) {
    const auto place = static_cast<std::size_t>(i);
    last[place] = lanes_[index(lane_of(approach, static_cast<Turn>(i)))].last();
    safe[place] = lane_is_safe(law_, last[place]);
  }
  const std::uint32_t vehicle = entrance.waiting.front().vehicle;
  const double uniform =
      uniform01({.run_seed = parameters_.seed, .purpose = Purpose::kLane, .entity = vehicle, .index = 0});
  const auto chosen = chosen_lane(safe, parameters_.demand[index(approach)].lane_weights, uniform);
  if (!chosen) return false;

  const Driver driver = drawn_driver(parameters_, vehicle);
  const Lane lane = lane_of(approach, static_cast<Turn>(*chosen));
  Car car;
  car.motion.speed_mps =
      capped_initial_speed_mps(parameters_, law_, driver.initial_speed_mps, last[static_cast<std::size_t>(*chosen)]);
  if (car.motion.speed_mps < driver.initial_speed_mps) car.decider = Decider::kCarAhead;
  car.desired_speed_mps = driver.desired_speed_mps;
  car.commanded_mps2 = std::numeric_limits<double>::quiet_NaN();
  car.temporary_id = driver.temporary_id;
  car.entered = next_step_ - 1;
  car.vehicle = vehicle;
  car.equipped = entrance.waiting.front().equipped;
  if (car.equipped) car.unit = OnBoardUnit(drawn_compliance(parameters_, vehicle));
  lanes_[index(lane)].enter(car);
  entries_.push_back({vehicle, lane, car.equipped, car.motion.speed_mps, car.desired_speed_mps});
  if (car.equipped) {
    const auto at = std::ranges::lower_bound(stations_, car.temporary_id, {}, &Station::temporary_id);
    stations_.insert(at, {car.temporary_id, vehicle, lane});
  }
  if (car.equipped) --entrance.waiting_equipped;
  entrance.waiting.pop_front();
  return true;
}

void Engine::forget_departed() {
  for (const Departure& departure : events_.departures) {
    std::erase_if(stations_, [&](const Station& known) { return known.vehicle == departure.vehicle; });
  }
}

const Engine::Station* Engine::station(std::uint64_t temporary_id) const {
  const auto found = std::ranges::lower_bound(stations_, temporary_id, {}, &Station::temporary_id);
  return found != stations_.end() && found->temporary_id == temporary_id ? &*found : nullptr;
}

std::optional<Engine::EquippedCar> Engine::equipped_car(std::uint64_t temporary_id) const {
  const Station* found = station(temporary_id);
  if (found == nullptr) return std::nullopt;
  const Car* car = lanes_[index(found->lane)].find(found->vehicle);
  LUKOU_EXPECT(car != nullptr);
  return EquippedCar{found->lane, car};
}

void Engine::change_flow(Approach approach, double flow_veh_per_h) {
  entrances_[index(approach)].demand.change_flow(time_s(std::max<Step>(next_step_ - 1, 0)), flow_veh_per_h);
}

void Engine::change_equipped_ratio(double ratio) { parameters_.equipped_ratio = ratio; }

void Engine::change_units(const UnitParameters& unit, const ComplianceParameters& compliance) {
  parameters_.unit = unit;
  parameters_.compliance = compliance;
}

}  // namespace lukou::traffic
