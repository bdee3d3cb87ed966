#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "common/core/step.hpp"
#include "common/intersection/actuation.hpp"
#include "common/intersection/lane.hpp"
#include "common/intersection/signal_plan.hpp"

namespace lukou {

/// The id that a car gives itself in its messages; says nothing about the car.
enum class TemporaryId : std::uint64_t {};

/// A car on an approach, as its newest BSM tells and as the RSU's map matching places it.
struct HeardCar {
  TemporaryId id{};
  Lane lane{};
  double distance_m = 0.0;  ///< of its front to the stop line, > 0
  double speed_mps = 0.0;
  double acceleration_mps2 = 0.0;
  Step age = 0;                      ///< steps since the message was made, by the car's clock; 0 = it tells of now
  std::optional<double> accuracy_m;  ///< of its position as its unit tells, one standard deviation; empty: it does not
};

/// A car on an approach as a roadside sensor tells of it and as the RSU's map matching places it. It may have a unit or
/// not, so the same car may stand among the heard ones, too; two sensors that see it give two of these.
struct SensedCar {
  std::uint32_t sensor = 0;  ///< index in this RSU's list of the scenario
  std::uint32_t track = 0;   ///< the same as long as this sensor follows this car; says nothing else
  Lane lane{};
  double distance_m = 0.0;  ///< of its front to the stop line, > 0
  double speed_mps = 0.0;
  Step age = 0;  ///< steps since it was seen; 0 = it tells of now
};

/// A change of a signal head to come.
struct SignalChange {
  Aspect aspect = Aspect::kRed;
  Step step = 0;  ///< the first step of the new aspect

  friend bool operator==(const SignalChange&, const SignalChange&) = default;
};

/// What the RSU knows of one approach lane.
struct LaneView {
  std::span<const HeardCar> cars;         ///< front to back; cars without an on-board unit are never among them
  std::span<const SensedCar> sensed;      ///< front to back; what sensors delivered for this step, nothing is kept
  std::optional<double> last_crossing_s;  ///< when a heard car last crossed the stop line
  Aspect aspect = Aspect::kRed;           ///< what the head shows from now on
  Step aspect_since = 0;                  ///< the step at which it began; as far as the RSU has seen
  std::span<const SignalChange> changes;  ///< in the order of time; what lies beyond the last one is not known
};

/// The RSU's map of its intersection.
struct MapView {
  double speed_limit_mps = 0.0;
  double approach_length_m = 0.0;  ///< from the entrance to the stop line
};

/// All that an RSU knows at the instant of a step. Nothing in it comes from anywhere but its radio, its signal
/// controller and its map.
struct RsuView {
  Step step = 0;
  double time_s = 0.0;
  MapView map;
  /// What the controller keeps whatever an RSU asks for. Empty: it runs a fixed plan and refuses every request.
  std::optional<Actuation> actuation;
  Step promised_to = 0;  ///< the last step whose heads are known for certain
  /// The first step whose heads a request of this step can change: step + 1 + run.signal_promise_steps. What they show
  /// between promised_to and then follows from earlier requests.
  Step request_acts = 0;
  std::array<LaneView, kLanes> lanes;  ///< WL WC WR SL SC SR EL EC ER NL NC NR
};

}  // namespace lukou
