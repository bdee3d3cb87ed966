#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

#include "common/core/step.hpp"
#include "common/intersection/actuation.hpp"
#include "common/intersection/lane.hpp"
#include "common/intersection/lane_set.hpp"

// What is measured of one car, one stop, one advice: rows of tables. docs/results.md defines each column.

namespace lukou {

/// A row of car.csv: a car that has left the end of its exit.
struct FinishedCar {
  std::uint32_t vehicle = 0;
  Lane lane{};
  bool equipped = false;
  double entered_s = 0.0;
  double initial_speed_mps = 0.0;
  double theoretical_time_s = 0.0;   ///< entrance to stop line
  double act_time_s = 0.0;           ///< entrance to stop line
  double delta_s = 0.0;              ///< act_time - theoretical_time
  double delay_s = 0.0;              ///< entrance to the end of the exit, less the time of the same driver unhindered
  std::uint32_t stops = 0;           ///< before the stop line
  std::uint32_t standing_steps = 0;  ///< before the stop line
  double left_s = 0.0;
  double fuel_ml = 0.0;           ///< entrance to the end of the exit, as the next
  double fuel_standing_ml = 0.0;  ///< of it slower than the stop speed
};

/// A row of stops.csv: a stop that is over, or that the end of the run has cut short.
struct FinishedStop {
  Step ended = 0;  ///< the step in which the car was fast again or crossed its stop line; the last one of the run
  std::uint32_t vehicle = 0;
  Lane lane{};
  bool equipped = false;
  Step began = 0;
  double distance_m = 0.0;           ///< to the stop line when it began
  std::uint32_t standing_steps = 0;  ///< slower than the stop speed
  std::string_view cause;            ///< name of a StopCause; text that lives for ever, as the next two
  std::string_view guidance;         ///< name of the GuidanceState when it began
  std::string_view missed;           ///< name of the fate of the newest word if it was lost or late; or empty
};

/// A row of guidance.csv: an advice whose fate is final.
struct SettledAdvice {
  Step settled = 0;
  std::optional<Step> issued;  ///< empty: not decodable, as the next ones but `fate`
  std::uint32_t rsu = 0;
  std::uint32_t sequence = 0;
  std::optional<std::uint32_t> vehicle;  ///< empty: nobody on the road, as the next
  std::optional<Lane> lane;
  double commanded_mps2 = 0.0;     ///< not a number: not decodable, or a speed that never became one
  std::string_view fate;           ///< name of an AdviceFate; text that lives for ever
  std::optional<Step> first_used;  ///< empty: never, as the next
  std::optional<Step> last_used;
  std::string_view kind = "acceleration";  ///< name of an AdviceKind; text that lives for ever
  std::optional<double> speed_mps;         ///< that it asked for
};

/// A row of requests.csv: what an RSU asks of the signal controller, or what becomes of it, changed.
struct RequestRow {
  Step step = 0;  ///< of the controller
  std::uint32_t rsu = 0;
  LaneSet lanes;
  RequestOutcome outcome = RequestOutcome::kAccepted;
};

/// A row of guidance.csv, too: an RSU computed longer than a step.
struct MissedDeadline {
  Step known = 0;     ///< when the engine heard the answer
  Step answered = 0;  ///< the step that the RSU answered
  std::uint32_t rsu = 0;
  std::uint32_t took_ms = 0;
};
/// Stands in the place of a fate.
inline constexpr std::string_view kDeadlineMissed = "deadline_missed";

/// What is dangerous about an encounter. docs/results.md defines each.
enum class SafetyKind : std::uint8_t {
  kTtc = 0,
  kMttc = 1,
  kDrac = 2,
  kHardBraking = 3,
  kJerk = 4,
  kPet = 5,
  kPetOpposedLeft = 6,
};
inline constexpr std::size_t kSafetyKinds = 7;
inline constexpr std::array<std::string_view, kSafetyKinds> kSafetyKindNames = {
    "ttc", "mttc", "drac", "hard_braking", "jerk", "pet", "pet_opposed_left"};

/// A row of safety.csv: an encounter that is over, or that the end of the run has cut short.
struct Encounter {
  Step ended = 0;  ///< the step in which it was known to be over; the last one of the run
  SafetyKind kind{};
  std::uint32_t vehicle = 0;  ///< that follows, comes second, brakes or jerks
  Lane lane{};
  bool equipped = false;
  std::optional<std::uint32_t>
      other;  ///< the car ahead, or that was there first; empty: concerns no other, as the next two
  std::optional<Lane> other_lane;
  std::optional<bool> other_equipped;
  bool guided = false;  ///< an advice was in force for `vehicle` when it was worst; of crossings up to 10 s before
  Step began = 0;
  Step last = 0;            ///< that met the threshold
  Step worst = 0;           ///< in which `value` is the extreme
  double value = 0.0;       ///< s, m/s2 or m/s3
  double distance_m = 0.0;  ///< of the front to the own stop line when it was worst; negative beyond it
  double speed_mps = 0.0;   ///< then
};

}  // namespace lukou
