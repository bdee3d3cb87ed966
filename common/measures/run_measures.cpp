#include "common/measures/run_measures.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/core/contract.hpp"

namespace lukou {
namespace {

constexpr auto kExit = static_cast<std::uint8_t>(CarState::kExit);

/// Whether an advice with this fate came to the car's unit.
bool reached(AdviceFate fate) {
  switch (fate) {
    case AdviceFate::kUnknownVehicle:
    case AdviceFate::kMalformed:
    case AdviceFate::kLostRandom:
    case AdviceFate::kLostBurst:
    case AdviceFate::kLostRange:
    case AdviceFate::kLostPathLoss:
    case AdviceFate::kLostCollision:
    case AdviceFate::kLostHalfDuplex:
    case AdviceFate::kLostOutage:
      return false;
    default:
      return true;
  }
}

/// What a car burns in a step. Slower than `stop_speed_mps` is standing.
inline void add_step(FuelTotals& fuel, double speed_mps, double acceleration_mps2, double stop_speed_mps) {
  const FuelRate rate = kamal_fuel(speed_mps, acceleration_mps2);
  const double burnt_ml = rate.total_ml_per_s() * kStep_s;
  fuel.fuel_ml += burnt_ml;
  fuel.check_ml += cpfm_fuel_ml_per_s(speed_mps, acceleration_mps2) * kStep_s;
  if (speed_mps < stop_speed_mps) {
    fuel.standing_ml += burnt_ml;
  } else {
    fuel.accelerating_ml += rate.accelerating_ml_per_s * kStep_s;
  }
}

std::uint64_t sum(const std::vector<std::uint32_t>& column) {
  std::uint64_t total = 0;
  for (const std::uint32_t value : column) total += value;
  return total;
}

}  // namespace

RunMeasures::RunMeasures(const MeasureParameters& parameters)
    : parameters_(parameters), warmup_step_(step_at_or_after(parameters.warmup_s)) {}

RunMeasures::Record& RunMeasures::record(std::uint32_t vehicle) {
  Records& records = records_[vehicle % kApproaches];
  const std::uint32_t n = vehicle / kApproaches;
  LUKOU_EXPECT(n >= records.first && n - records.first < records.cars.size());
  return records.cars[n - records.first];
}

RunMeasures::Record* RunMeasures::record_if_known(std::uint32_t vehicle) {
  Records& records = records_[vehicle % kApproaches];
  const std::uint32_t n = vehicle / kApproaches;
  const bool known = n >= records.first && n - records.first < records.cars.size();
  return known ? &records.cars[n - records.first] : nullptr;
}

void RunMeasures::add(const TrafficBatch& batch) {
  LUKOU_EXPECT(batch.step == step_ + 1);
  step_ = batch.step;
  const std::size_t place = static_cast<std::size_t>(step_) % equipped_crossings_.size();
  equipped_.crossed_last_minute -= std::exchange(equipped_crossings_[place], std::uint16_t{0});
  unequipped_.crossed_last_minute -= std::exchange(unequipped_crossings_[place], std::uint16_t{0});
  finished_.clear();
  finished_stops_.clear();
  if (step_ > warmup_step_) ++measured_steps_;
  add_entries(batch);
  add_motion(batch);
  add_crossings(batch);
  add_departures(batch);
  add_fates(batch);
  equipped_.arrived = sum(batch.arrived_equipped);
  equipped_.waiting = sum(batch.waiting_equipped);
  unequipped_.arrived = sum(batch.arrived) - equipped_.arrived;
  unequipped_.waiting = sum(batch.waiting) - equipped_.waiting;
  totals_.guard_interventions += batch.guard_interventions;
}

void RunMeasures::add_entries(const TrafficBatch& batch) {
  entrance_.add_arrivals(batch);
  for (std::size_t i = 0; i < batch.entered_vehicle.size(); ++i) {
    Record entering;
    FinishedCar& car = entering.car;
    car.vehicle = batch.entered_vehicle[i];
    car.lane = static_cast<Lane>(batch.entered_lane[i]);
    car.equipped = batch.entered_equipped[i] != 0;
    car.entered_s = time_s(batch.step);
    car.initial_speed_mps = batch.entered_speed_mps[i];
    car.theoretical_time_s = theoretical_time_s(parameters_.road.approach_m, car.initial_speed_mps,
                                                parameters_.speed_limit_mps, parameters_.acceleration_max_mps2);
    entering.driver = {.initial_mps = car.initial_speed_mps,
                       .desired_mps = batch.entered_desired_speed_mps[i],
                       .relaxation_s = parameters_.speed_relaxation_s,
                       .acceleration_max_mps2 = parameters_.acceleration_max_mps2};
    entering.free_time_s = free_time_s(entering.driver, parameters_.road.approach_m + parameters_.road.exit_m);
    entering.counts = batch.step >= warmup_step_;
    const Step arrived = entrance_.enter(kAllApproaches[car.vehicle % kApproaches], car.equipped);
    entering.waited_s = time_s(batch.step - arrived);
    entering.arrival_counts = arrived >= warmup_step_;
    Records& records = records_[car.vehicle % kApproaches];
    LUKOU_EXPECT(car.vehicle / kApproaches == records.first + records.cars.size());
    ++sums(entering).entered;
    records.cars.push_back(entering);
  }
}

void RunMeasures::add_motion(const TrafficBatch& batch) {
  for (LaneTotals& lane : lanes_) lane.standing_now = 0;
  equipped_.standing = unequipped_.standing = 0;
  const bool measured = step_ > warmup_step_;
  for (std::size_t i = 0; i < batch.vehicle.size(); ++i) {
    Record& seen = record(batch.vehicle[i]);
    const double position_m = batch.position_m[i];
    if (position_m < seen.position_m) ++totals_.reversals;
    seen.position_m = position_m;
    add_step(seen.fuel, batch.speed_mps[i], batch.acceleration_mps2[i], parameters_.stop_speed_mps);
    if (measured) {
      Sums& group = sums(seen);
      group.acceleration_mps2 += std::abs(batch.acceleration_mps2[i]);
      ++group.driven_steps;
    }
    if (i > 0 && batch.lane[i - 1] == batch.lane[i]) {
      const double distance_m = batch.position_m[i - 1] - position_m;
      if (!totals_.min_head_distance_m || distance_m < *totals_.min_head_distance_m) {
        totals_.min_head_distance_m = distance_m;
      }
      const bool overlapping = distance_m < parameters_.vehicle_length_m;
      if (overlapping && !seen.overlapping) ++totals_.collisions;
      seen.overlapping = overlapping;
    }
    if (batch.state[i] == kExit) continue;
    const double speed_mps = batch.speed_mps[i];
    LaneTotals& lane = lanes_[batch.lane[i]];
    if (speed_mps < parameters_.stop_speed_mps) {
      if (seen.armed) begin_stop(batch, i, seen);
      ++seen.car.standing_steps;
      ++seen.stop->standing_steps;
      ++lane.standing_steps;
      ++lane.standing_now;
      Sums& group = sums(seen);
      ++group.standing;
      ++group.standing_steps_ever;
      if (measured) ++group.queued_steps;
    } else if (speed_mps > parameters_.stop_rearm_mps) {
      seen.armed = true;
      if (seen.stop) end_stop(seen);
    }
  }
}

void RunMeasures::begin_stop(const TrafficBatch& batch, std::size_t car, Record& seen) {
  const bool behind = car > 0 && batch.lane[car - 1] == batch.lane[car] && batch.state[car - 1] != kExit;
  const StopFacts facts{.guidance = static_cast<GuidanceState>(batch.guidance[car]),
                        .bound_by = static_cast<BoundBy>(batch.bound_by[car]),
                        .ahead_stands = behind && batch.speed_mps[car - 1] < parameters_.stop_speed_mps,
                        .missed = batch.missed[car],
                        .rsus_silent = std::ranges::all_of(batch.heard_epoch, [](auto epoch) { return epoch == 0; })};
  const StopCause cause = stop_cause(facts);
  const bool missed = facts.missed != kNothingMissed;
  seen.stop = FinishedStop{.ended = step_,
                           .vehicle = seen.car.vehicle,
                           .lane = seen.car.lane,
                           .equipped = seen.car.equipped,
                           .began = step_,
                           .distance_m = parameters_.road.approach_m - batch.position_m[car],
                           .standing_steps = 0,
                           .cause = name(cause),
                           .guidance = name(facts.guidance),
                           .missed = missed ? name(static_cast<AdviceFate>(facts.missed)) : std::string_view()};
  seen.armed = false;
  ++seen.car.stops;
  ++sums(seen).stops_ever;
  ++lanes_[batch.lane[car]].stops;
  ++totals_.stops_total;
  ++totals_.stops_by_cause[static_cast<std::size_t>(cause)];
}

void RunMeasures::end_stop(Record& seen) {
  seen.stop->ended = step_;
  finished_stops_.push_back(*seen.stop);
  seen.stop.reset();
}

std::vector<FinishedStop> RunMeasures::lasting_stops() const {
  std::vector<FinishedStop> lasting;
  for (const Records& records : records_) {
    for (const Record& seen : records.cars) {
      if (!seen.stop) continue;
      lasting.push_back(*seen.stop);
      lasting.back().ended = step_;
    }
  }
  return lasting;
}

void RunMeasures::add_crossings(const TrafficBatch& batch) {
  for (std::size_t i = 0; i < batch.crossed_vehicle.size(); ++i) {
    Record& crossing = record(batch.crossed_vehicle[i]);
    if (crossing.stop) end_stop(crossing);
    FinishedCar& car = crossing.car;
    car.act_time_s = batch.crossed_time_s[i] - car.entered_s;
    car.delta_s = car.act_time_s - car.theoretical_time_s;
    ++lanes_[index(car.lane)].crossed;
    if (batch.crossed_aspect[i] == static_cast<std::uint8_t>(Aspect::kRed)) ++totals_.red_crossings;
    Sums& group = sums(crossing);
    ++(car.equipped ? equipped_crossings_
                    : unequipped_crossings_)[static_cast<std::size_t>(step_) % equipped_crossings_.size()];
    ++group.crossed_last_minute;
    if (batch.crossed_time_s[i] >= parameters_.warmup_s) ++group.crossed_after_warmup;
    if (!crossing.counts) continue;
    ++group.crossed;
    group.delta_s += car.delta_s;
    group.standing_steps += car.standing_steps;
    group.stops += car.stops;
  }
}

void RunMeasures::add_departures(const TrafficBatch& batch) {
  for (std::size_t i = 0; i < batch.left_vehicle.size(); ++i) {
    Record& leaving = record(batch.left_vehicle[i]);
    FinishedCar& car = leaving.car;
    car.left_s = batch.left_time_s[i];
    car.delay_s = car.left_s - car.entered_s - leaving.free_time_s;
    car.fuel_ml = leaving.fuel.fuel_ml;
    car.fuel_standing_ml = leaving.fuel.standing_ml;
    leaving.left = true;
    finished_.push_back(car);
    Sums& group = sums(leaving);
    ++group.left_ever;
    group.delay_ever_s += car.delay_s;
    group.burnt += leaving.fuel;
    if (leaving.arrival_counts) group.after_arrival += {1, leaving.waited_s, leaving.waited_s + car.delay_s};
    if (!leaving.counts) continue;
    ++group.left;
    group.delay_s += car.delay_s;
    group.fuel_ml += car.fuel_ml;
    group.fuel_standing_ml += car.fuel_standing_ml;
  }
  std::ranges::stable_sort(finished_, {}, &FinishedCar::left_s);
  for (Records& records : records_) {
    while (!records.cars.empty() && records.cars.front().left) {
      records.cars.pop_front();
      ++records.first;
    }
  }
}

void RunMeasures::add_fates(const TrafficBatch& batch) {
  totals_.advice_sent += batch.answers_malformed;
  totals_.advice_by_fate[static_cast<std::size_t>(AdviceFate::kMalformed)] += batch.answers_malformed;
  for (std::size_t i = 0; i < batch.fate.size(); ++i) {
    LUKOU_EXPECT(batch.fate[i] < kAdviceFates && batch.fate_kind[i] < kAdviceKinds);
    if (batch.fate_again[i] != 0) {
      --totals_.advice_by_fate[static_cast<std::size_t>(AdviceFate::kApplied)];
    } else if (batch.fate[i] != static_cast<std::uint8_t>(AdviceFate::kDuplicate)) {
      ++totals_.advice_sent;  // a duplicate is no advice of its own
      if (batch.fate_issued[i] >= 0) ++totals_.advice_by_kind[batch.fate_kind[i]];
    }
    ++totals_.advice_by_fate[batch.fate[i]];
    if (!reached(static_cast<AdviceFate>(batch.fate[i]))) continue;
    Record* advised = record_if_known(batch.fate_vehicle[i]);
    if (advised != nullptr) advised->newest_advice = std::max(advised->newest_advice, batch.fate_issued[i]);
  }
}

RunMeasures::Sums& RunMeasures::Sums::operator+=(const Sums& other) {
  arrived += other.arrived;
  waiting += other.waiting;
  entered += other.entered;
  left_ever += other.left_ever;
  crossed_after_warmup += other.crossed_after_warmup;
  stops_ever += other.stops_ever;
  standing_steps_ever += other.standing_steps_ever;
  delay_ever_s += other.delay_ever_s;
  standing += other.standing;
  crossed_last_minute += other.crossed_last_minute;
  crossed += other.crossed;
  left += other.left;
  delta_s += other.delta_s;
  delay_s += other.delay_s;
  standing_steps += other.standing_steps;
  stops += other.stops;
  queued_steps += other.queued_steps;
  acceleration_mps2 += other.acceleration_mps2;
  driven_steps += other.driven_steps;
  fuel_ml += other.fuel_ml;
  fuel_standing_ml += other.fuel_standing_ml;
  burnt += other.burnt;
  after_arrival += other.after_arrival;
  return *this;
}

}  // namespace lukou
