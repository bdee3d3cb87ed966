#pragma once

#include <functional>
#include <optional>

#include "common/intersection/geometry.hpp"
#include "services/lukou/report/result.hpp"

namespace lukou::report {

/// A car at an instant, as files of trajectories tell it.
struct RecordedCar {
  std::uint32_t vehicle = 0;
  Lane lane{};
  bool equipped = false;
  double past_line_m = 0.0;  ///< of its front; before the stop line negative
  double position_m = 0.0;   ///< of its front, from the entrance
  Pose front;
  double speed_mps = 0.0;
  double acceleration_mps2 = 0.0;
  bool advised = false;  ///< an advice is in force
};

/// What a scenario says of its cars and roads.
struct RoadFacts {
  RoadLengths road;
  double vehicle_length_m = 0.0;
  double vehicle_width_m = 0.0;
};
RoadFacts road_facts(const Result& result);

/// Car `i` of a batch.
RecordedCar recorded_car(const TrafficBatch& batch, std::size_t i, const RoadLengths& road);

/// Steps between two pictures of the cars: `wanted`, or as often as they are recorded. Errors: they are not recorded,
/// or not that often.
Expected<Step> period_of(const Result& result, const std::optional<Step>& wanted);

/// Every instant of the run at which there are cars on record, `period` steps apart, the empty ones too.
using TakeInstant = std::function<Expected<Done>(Step step, const TrafficBatch& batch)>;
Expected<Done> for_each_instant(const Result& result, Step period, const TakeInstant& take);

}  // namespace lukou::report
