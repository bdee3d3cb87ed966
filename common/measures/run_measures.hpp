#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <vector>

#include "common/bus/batches.hpp"
#include "common/intersection/geometry.hpp"
#include "common/intersection/lane.hpp"
#include "common/intersection/signal_plan.hpp"
#include "common/measures/entry_queue.hpp"
#include "common/measures/free_motion.hpp"
#include "common/measures/fuel.hpp"
#include "common/measures/rows.hpp"
#include "common/measures/stop_cause.hpp"

namespace lukou {

struct MeasureParameters {
  double warmup_s = 2000.0;  ///< the summary speaks of cars that entered at or after this
  RoadLengths road;
  double speed_limit_mps = 60.0 / 3.6;
  double acceleration_max_mps2 = 3.0;
  double speed_relaxation_s = 1.0;
  double stop_speed_mps = 5.0 / 3.6;  ///< slower is standing
  double stop_rearm_mps = 8.0 / 3.6;  ///< a car has to be faster than this before it can stop once more
  double vehicle_length_m = 4.5;
};

/// Totals of one lane since step 0, and what stands there now.
struct LaneTotals {
  std::uint64_t stops = 0;
  std::uint64_t crossed = 0;
  std::uint64_t standing_steps = 0;  ///< of all cars, before the stop line
  std::uint32_t standing_now = 0;    ///< cars

  [[nodiscard]] double stop_time_s() const { return static_cast<double>(standing_steps) / 10.0; }
};

/// Figures of a group of cars. Means are over those that entered at or after the end of the warm-up and crossed their
/// stop line by now; empty while there are none.
struct GroupFigures {
  std::uint64_t vehicles_arrived = 0;  ///< since step 0, as the next three
  std::uint64_t vehicles_entered = 0;
  std::uint64_t vehicles_left = 0;
  std::uint64_t vehicles_waiting = 0;
  std::optional<double> throughput_veh_per_h;  ///< crossings after the warm-up, mean per approach
  std::optional<double> throughput_intersection_veh_per_h;
  std::uint64_t cars = 0;  ///< that the means are over
  std::optional<double> mean_delta_s;
  std::optional<double> mean_delay_s;  ///< over those that have also left the exit
  std::optional<double> mean_stop_time_s;
  std::optional<double> stops_per_vehicle;
  std::optional<double> mean_queue_veh;              ///< standing cars per lane, over the steps after the warm-up
  std::optional<double> mean_abs_acceleration_mps2;  ///< over all cars on the road and the steps after the warm-up
  FuelTotals fuel;                                   ///< of all cars since step 0
  std::optional<double> mean_fuel_ml;                ///< as mean_delay_s, and the next
  std::optional<double> mean_fuel_standing_ml;
  // Over every car that arrived at or after the end of the warm-up, also those still on the road or before the
  // entrance.
  std::uint64_t cars_arrived = 0;
  std::optional<double> mean_delay_all_s;   ///< from the arrival on: waiting before the entrance counts
  std::optional<double> mean_entry_wait_s;  ///< of that before the entrance
};

/// A group of cars as it stands now. Everything counts from step 0 on, warm-up included; stops and standing before the
/// stop line. Means over cars that came onto the road, of the delay over those that have left the exit; empty while
/// there are none.
struct GroupNow {
  std::uint64_t arrived = 0;
  std::uint64_t waiting = 0;
  std::uint64_t in_system = 0;
  std::uint64_t left = 0;
  std::uint64_t standing = 0;
  std::uint64_t stops = 0;
  std::uint64_t standing_steps = 0;
  double throughput_veh_per_h = 0.0;  ///< crossings of the last minute, or of the time so far while that is shorter
  std::optional<double> stops_per_vehicle;
  std::optional<double> mean_stop_time_s;
  std::optional<double> mean_delay_s;
};
struct RunNow {
  GroupNow all;
  GroupNow equipped;
  GroupNow unequipped;
};

/// What is known of a car on the road.
struct CarNow {
  std::uint32_t standing_steps = 0;  ///< before the stop line
  Step newest_advice = -1;           ///< when the newest advice that reached it was issued; -1: none has
};

/// Every figure of a run up to the newest step.
struct RunFigures {
  GroupFigures all;
  GroupFigures equipped;
  GroupFigures unequipped;
  std::uint64_t advice_sent = 0;  ///< advice whose fate is known
  std::array<std::uint64_t, kAdviceFates>
      advice_by_fate{};  ///< by AdviceFate; each advice once, by its last fate; duplicates on top
  std::array<std::uint64_t, kAdviceKinds> advice_by_kind{};  ///< of those sent whose kind is known, by AdviceKind
  [[nodiscard]] std::uint64_t advice(AdviceFate fate) const { return advice_by_fate[static_cast<std::size_t>(fate)]; }
  std::uint64_t stops_total = 0;                            ///< of all cars, since step 0
  std::array<std::uint64_t, kStopCauses> stops_by_cause{};  ///< by StopCause
  std::uint64_t guard_interventions = 0;
  std::uint64_t collisions = 0;     ///< a car came closer to the one ahead than a vehicle's length, head to head
  std::uint64_t reversals = 0;      ///< steps in which a car moved backwards
  std::uint64_t red_crossings = 0;  ///< of all cars, also of those that could not stop any more
  std::optional<double> min_head_distance_m;
};

/// Computes every figure from the truth, once. Memory grows with the cars on the road, not with the length of the run.
class RunMeasures {
 public:
  explicit RunMeasures(const MeasureParameters& parameters);

  /// Takes the next step's batch. Requires the batches in the order of their steps, from step 0.
  void add(const TrafficBatch& batch);

  /// Cars that left in the newest step, in the order in which they left.
  [[nodiscard]] std::span<const FinishedCar> finished() const { return finished_; }
  /// Stops that ended in the newest step: of cars that are fast again, lane after lane, then of cars that crossed.
  [[nodiscard]] std::span<const FinishedStop> finished_stops() const { return finished_stops_; }
  /// Stops that last, as if they ended now; by approach, then by vehicle.
  [[nodiscard]] std::vector<FinishedStop> lasting_stops() const;
  [[nodiscard]] const std::array<LaneTotals, kLanes>& lanes() const { return lanes_; }
  /// Cars since step 0.
  [[nodiscard]] std::uint64_t entered() const { return equipped_.entered + unequipped_.entered; }
  [[nodiscard]] std::uint64_t left() const { return equipped_.left_ever + unequipped_.left_ever; }
  [[nodiscard]] std::uint64_t collisions() const { return totals_.collisions; }
  [[nodiscard]] const std::array<std::uint64_t, kAdviceFates>& advice_by_fate() const { return totals_.advice_by_fate; }
  [[nodiscard]] RunFigures figures() const;
  [[nodiscard]] RunNow now() const;
  /// Requires a car on the road.
  [[nodiscard]] CarNow now(std::uint32_t vehicle) const;

 private:
  /// What is known of a car that is on the road.
  struct Record {
    FinishedCar car;
    std::optional<FinishedStop> stop;  ///< that lasts
    FuelTotals fuel;
    FreeDriver driver;
    double free_time_s = 0.0;  ///< of the whole way
    double waited_s = 0.0;     ///< before the entrance
    double position_m = 0.0;
    Step newest_advice = -1;
    bool armed = true;  ///< would count a stop
    bool overlapping = false;
    bool counts = false;          ///< entered after the warm-up
    bool arrival_counts = false;  ///< arrived after it
    bool left = false;
  };
  /// The records of an approach: vehicle numbers are dense, so the place follows from the number.
  struct Records {
    std::deque<Record> cars;
    std::uint32_t first = 0;  ///< n of cars.front()
  };
  struct Sums {
    // Since step 0.
    std::uint64_t arrived = 0;
    std::uint64_t waiting = 0;
    std::uint64_t entered = 0;
    std::uint64_t left_ever = 0;
    std::uint64_t crossed_after_warmup = 0;
    std::uint64_t stops_ever = 0;
    std::uint64_t standing_steps_ever = 0;
    double delay_ever_s = 0.0;
    // Now.
    std::uint64_t standing = 0;
    std::uint64_t crossed_last_minute = 0;
    // Of the cars that count.
    std::uint64_t crossed = 0;
    std::uint64_t left = 0;
    double delta_s = 0.0;
    double delay_s = 0.0;
    std::uint64_t standing_steps = 0;
    std::uint64_t stops = 0;
    std::uint64_t queued_steps = 0;  ///< cars standing, summed over the steps after the warm-up
    double acceleration_mps2 = 0.0;  ///< without its sign, summed over cars and the steps after the warm-up
    std::uint64_t driven_steps = 0;  ///< terms of that sum
    double fuel_ml = 0.0;            ///< of those that left, as the next
    double fuel_standing_ml = 0.0;
    FuelTotals burnt;           ///< since step 0, by those that left
    DelayTotals after_arrival;  ///< of those that arrived after the warm-up and have left

    Sums& operator+=(const Sums& other);
  };

  /// Crossings of a group in each step of the last minute.
  using LastMinute = std::array<std::uint16_t, 60 * kStepsPerSecond>;

  Record& record(std::uint32_t vehicle);
  /// Null: not on the road, or not any more.
  Record* record_if_known(std::uint32_t vehicle);
  Sums& sums(const Record& record) { return record.car.equipped ? equipped_ : unequipped_; }
  void add_entries(const TrafficBatch& batch);
  void add_motion(const TrafficBatch& batch);
  void begin_stop(const TrafficBatch& batch, std::size_t car, Record& seen);
  void end_stop(Record& seen);
  void add_crossings(const TrafficBatch& batch);
  void add_departures(const TrafficBatch& batch);
  void add_fates(const TrafficBatch& batch);
  /// What the cars of a group have burnt since step 0.
  [[nodiscard]] FuelTotals burnt(bool equipped) const;
  /// What the cars of a group that arrived after the warm-up have lost by now, wherever they are.
  [[nodiscard]] DelayTotals lost(bool equipped) const;
  [[nodiscard]] GroupFigures figures_of(const Sums& sums) const;
  [[nodiscard]] GroupNow now_of(const Sums& sums) const;

  MeasureParameters parameters_;
  Step warmup_step_;
  Step step_ = -1;
  std::array<Records, kApproaches> records_;
  EntryQueue entrance_;
  std::array<LaneTotals, kLanes> lanes_{};
  std::vector<FinishedCar> finished_;
  std::vector<FinishedStop> finished_stops_;
  Sums equipped_;
  Sums unequipped_;
  LastMinute equipped_crossings_{};
  LastMinute unequipped_crossings_{};
  RunFigures totals_;  ///< the counts of it
  std::uint64_t measured_steps_ = 0;
};

}  // namespace lukou
