#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <vector>

#include "common/bus/batches.hpp"
#include "common/intersection/geometry.hpp"
#include "common/measures/crossing_watch.hpp"
#include "common/measures/rows.hpp"
#include "common/measures/surrogate_safety.hpp"

namespace lukou {

/// Encounters of a group of cars, each by the car that follows, comes second, brakes or jerks; those of opposed lefts
/// are in none of these.
struct SafetyCounts {
  std::array<std::uint64_t, kSafetyKinds> encounters{};  ///< by SafetyKind
  std::uint64_t ttc_critical = 0;
  std::uint64_t drac_critical = 0;
  std::uint64_t pet_both_inside = 0;
  std::optional<double> ttc_min_s;
  std::uint64_t driven_steps = 0;  ///< of the group's cars: what the counts compare by

  [[nodiscard]] std::uint64_t count(SafetyKind kind) const { return encounters[static_cast<std::size_t>(kind)]; }
  SafetyCounts& operator+=(const SafetyCounts& other);
};

/// Since step 0; what lasts is not counted before close().
struct SafetyFigures {
  SafetyCounts all;
  SafetyCounts equipped;
  SafetyCounts unequipped;
  SafetyCounts guided;  ///< with an advice in force when it was worst
  std::uint64_t opposed_lefts = 0;
  std::uint64_t opposed_lefts_both_inside = 0;
};

/// Finds dangerous encounters in the truth. Memory grows with the cars on the road.
class SafetyMeasures {
 public:
  SafetyMeasures(const RoadLengths& road, double vehicle_length_m);

  /// Takes the next step's batch. Requires the batches in the order of their steps, from step 0.
  void add(const TrafficBatch& batch);
  /// Encounters that were over in the newest step.
  [[nodiscard]] std::span<const Encounter> finished() const { return finished_; }
  /// Ends what lasts with the newest step, and returns it.
  std::vector<Encounter> close();
  [[nodiscard]] SafetyFigures figures() const;

 private:
  /// The kinds that last: all but those of crossings.
  static constexpr std::size_t kLastingKinds = 5;
  struct Car {
    std::uint32_t vehicle = 0;
    bool equipped = false;
    bool left = false;
    bool listed = false;  ///< in open_
    std::uint8_t grid_points = 0;
    Step guided = -1;                   ///< last point of the grid at which an advice was in force; -1: none
    std::size_t next_mark = 0;          ///< of the crossings
    std::array<double, 2> speed_mps{};  ///< at the last two points of the grid of the jerk, the newest first
    std::array<std::optional<Encounter>, kLastingKinds> lasting;
  };
  struct Cars {
    std::deque<Car> cars;
    std::uint32_t first = 0;  ///< n of cars.front()
  };

  Car& car(std::uint32_t vehicle);
  void add_entries(const TrafficBatch& batch);
  void add_following(const TrafficBatch& batch);
  void add_jerks(const TrafficBatch& batch);
  void add_crossings(const TrafficBatch& batch);
  void add_departures(const TrafficBatch& batch);
  /// The car of column `i` is in an encounter of this kind in the newest step.
  void note(const TrafficBatch& batch, std::size_t i, SafetyKind kind, double value);
  void end_stale();
  void finish(Encounter encounter);
  SafetyCounts& group(bool equipped) { return equipped ? equipped_ : unequipped_; }

  double approach_m_;
  double vehicle_length_m_;
  CrossingWatch crossings_;
  Step step_ = -1;
  std::array<Cars, kApproaches> cars_;
  std::vector<std::uint32_t> open_;  ///< cars with an encounter that lasts, in the order of its beginning
  std::vector<Encounter> finished_;
  SafetyCounts equipped_;
  SafetyCounts unequipped_;
  SafetyCounts guided_;
  std::uint64_t opposed_lefts_ = 0;
  std::uint64_t opposed_lefts_both_inside_ = 0;
};

}  // namespace lukou
