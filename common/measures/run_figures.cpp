// What RunMeasures tells of what it has taken.

#include <algorithm>

#include "common/core/contract.hpp"
#include "common/measures/run_measures.hpp"

namespace lukou {
namespace {

constexpr double kSecondsPerHour = 3600.0;

std::optional<double> ratio(double sum, std::uint64_t count) {
  if (count == 0) return std::nullopt;
  return sum / static_cast<double>(count);
}

}  // namespace

GroupFigures RunMeasures::figures_of(const Sums& sums) const {
  GroupFigures group;
  group.vehicles_arrived = sums.arrived;
  group.vehicles_entered = sums.entered;
  group.vehicles_left = sums.left_ever;
  group.vehicles_waiting = sums.waiting;
  const double hours = (time_s(step_) - parameters_.warmup_s) / kSecondsPerHour;
  if (hours > 0.0) {
    group.throughput_intersection_veh_per_h = static_cast<double>(sums.crossed_after_warmup) / hours;
    group.throughput_veh_per_h = *group.throughput_intersection_veh_per_h / kApproaches;
  }
  group.cars = sums.crossed;
  group.mean_delta_s = ratio(sums.delta_s, sums.crossed);
  group.mean_delay_s = ratio(sums.delay_s, sums.left);
  group.mean_stop_time_s =
      ratio(static_cast<double>(sums.standing_steps) / static_cast<double>(kStepsPerSecond), sums.crossed);
  group.stops_per_vehicle = ratio(static_cast<double>(sums.stops), sums.crossed);
  group.mean_queue_veh = ratio(static_cast<double>(sums.queued_steps), measured_steps_ * kLanes);
  group.mean_abs_acceleration_mps2 = ratio(sums.acceleration_mps2, sums.driven_steps);
  group.mean_fuel_ml = ratio(sums.fuel_ml, sums.left);
  group.mean_fuel_standing_ml = ratio(sums.fuel_standing_ml, sums.left);
  return group;
}

FuelTotals RunMeasures::burnt(bool equipped) const {
  FuelTotals fuel = equipped ? equipped_.burnt : unequipped_.burnt;
  for (const Records& records : records_) {
    for (const Record& seen : records.cars) {
      if (seen.car.equipped == equipped && !seen.left) fuel += seen.fuel;
    }
  }
  return fuel;
}

DelayTotals RunMeasures::lost(bool equipped) const {
  DelayTotals totals = equipped ? equipped_.after_arrival : unequipped_.after_arrival;
  for (const Records& records : records_) {
    for (const Record& seen : records.cars) {
      if (seen.car.equipped != equipped || seen.left || !seen.arrival_counts) continue;
      double delay_s = seen.waited_s;
      if (seen.position_m > 0.0) {
        delay_s += time_s(step_) - seen.car.entered_s - free_time_s(seen.driver, seen.position_m);
      }
      totals += {1, seen.waited_s, delay_s};
    }
  }
  totals += entrance_.waiting(equipped, warmup_step_, step_);
  return totals;
}

RunFigures RunMeasures::figures() const {
  RunFigures figures = totals_;
  Sums all = equipped_;
  all += unequipped_;
  figures.all = figures_of(all);
  figures.equipped = figures_of(equipped_);
  figures.unequipped = figures_of(unequipped_);
  figures.equipped.fuel = burnt(true);
  figures.unequipped.fuel = burnt(false);
  const auto tell = [](GroupFigures& group, const DelayTotals& totals) {
    group.cars_arrived = totals.cars;
    group.mean_delay_all_s = ratio(totals.delay_s, totals.cars);
    group.mean_entry_wait_s = ratio(totals.waited_s, totals.cars);
  };
  const DelayTotals lost_equipped = lost(true);
  DelayTotals lost_all = lost(false);
  tell(figures.equipped, lost_equipped);
  tell(figures.unequipped, lost_all);
  tell(figures.all, lost_all += lost_equipped);
  figures.all.fuel = figures.equipped.fuel;
  figures.all.fuel += figures.unequipped.fuel;
  return figures;
}

GroupNow RunMeasures::now_of(const Sums& sums) const {
  GroupNow group;
  group.arrived = sums.arrived;
  group.waiting = sums.waiting;
  group.in_system = sums.entered - sums.left_ever;
  group.left = sums.left_ever;
  group.standing = sums.standing;
  group.stops = sums.stops_ever;
  group.standing_steps = sums.standing_steps_ever;
  const Step counted = std::min<Step>(step_, static_cast<Step>(equipped_crossings_.size()));
  if (counted > 0) {
    group.throughput_veh_per_h = static_cast<double>(sums.crossed_last_minute) * kSecondsPerHour / time_s(counted);
  }
  group.stops_per_vehicle = ratio(static_cast<double>(sums.stops_ever), sums.entered);
  group.mean_stop_time_s =
      ratio(static_cast<double>(sums.standing_steps_ever) / static_cast<double>(kStepsPerSecond), sums.entered);
  group.mean_delay_s = ratio(sums.delay_ever_s, sums.left_ever);
  return group;
}

RunNow RunMeasures::now() const {
  Sums all = equipped_;
  all += unequipped_;
  return {.all = now_of(all), .equipped = now_of(equipped_), .unequipped = now_of(unequipped_)};
}

CarNow RunMeasures::now(std::uint32_t vehicle) const {
  const Records& records = records_[vehicle % kApproaches];
  const std::uint32_t n = vehicle / kApproaches;
  LUKOU_EXPECT(n >= records.first && n - records.first < records.cars.size());
  const Record& seen = records.cars[n - records.first];
  return {.standing_steps = seen.car.standing_steps, .newest_advice = seen.newest_advice};
}

}  // namespace lukou
