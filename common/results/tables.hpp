#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "common/core/expected.hpp"
#include "common/core/step.hpp"
#include "common/intersection/lane.hpp"
#include "common/measures/rows.hpp"
#include "common/results/manifest.hpp"
#include "common/results/table.hpp"

namespace lukou::results {

/// State after a step: stops.
struct StopRow {
  std::array<std::uint64_t, kLanes> stops{};  ///< since step 0
  std::uint64_t system_total = 0;
  double mean_per_vehicle = 0.0;  ///< not a number: no vehicle yet
  std::uint64_t standing_now = 0;
};

/// State after a step: cars that crossed the stop line.
struct RoadRow {
  std::array<std::uint64_t, kLanes> crossed{};  ///< since step 0
  std::uint64_t left_lanes_total = 0;
  double mean_per_lane = 0.0;
  std::uint64_t left_system_total = 0;
};

/// State after a step: time stood.
struct StopTimeRow {
  std::array<std::int64_t, kLanes> stood_steps{};  ///< of all cars of a lane since step 0
  std::int64_t system_total_steps = 0;
  double mean_per_vehicle_s = 0.0;  ///< not a number: no vehicle yet
};

/// Header lines, as docs/results.md explains them.
std::string car_columns();
std::string stop_columns();
std::string road_columns();
std::string stop_time_columns();

/// Names of the four tables.
inline constexpr const char* kCarTable = "car.csv";
inline constexpr const char* kStopTable = "stop.csv";
inline constexpr const char* kRoadTable = "road.csv";
inline constexpr const char* kStopTimeTable = "stop_time.csv";

/// The four tables that every run writes. Rows of steps come for 1, 2, 3, ... without a gap.
class RunTables {
 public:
  static Expected<RunTables> create(const std::filesystem::path& folder);

  /// A car that left in the step whose rows come next.
  void add_car(const FinishedCar& row);
  /// Requires that `step` is the one after the last.
  void add_step(Step step, const StopRow& stop, const RoadRow& road, const StopTimeRow& stop_time);

  /// Writes whole rows; cars first, so that on disk no step is without its cars.
  Expected<Done> flush();
  Expected<Done> sync();

  [[nodiscard]] std::size_t buffered_bytes() const;
  [[nodiscard]] Step last_step() const { return last_step_; }
  /// Name, hash and rows of each table as flushed, for the manifest; sorted by name.
  [[nodiscard]] std::vector<FileEntry> entries() const;

 private:
  RunTables(TableWriter car, TableWriter stop, TableWriter road, TableWriter stop_time);

  TableWriter car_;
  TableWriter stop_;
  TableWriter road_;
  TableWriter stop_time_;
  Step last_step_ = 0;
};

}  // namespace lukou::results
