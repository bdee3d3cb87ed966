#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "common/core/step.hpp"
#include "common/intersection/signal_plan.hpp"
#include "services/traffic_engine/model/follow_law.hpp"
#include "services/traffic_engine/model/guard.hpp"
#include "services/traffic_engine/model/on_board_unit.hpp"
#include "services/traffic_engine/model/parameters.hpp"

namespace lukou::traffic {

/// Where a car stands in the life of its lane. The values are those of CarState on the bus.
enum class Stage : std::uint8_t {
  kIn = 0,         ///< drives on the approach
  kBlock = 1,      ///< stands in, or starts with, the block at the stop line
  kCommitted = 2,  ///< could not stop any more when the green ended
  kExit = 3,       ///< has crossed the stop line
};

/// What decided a car's acceleration in a step. The values are those of BoundBy on the bus.
enum class Decider : std::uint8_t {
  kOwnWish = 0,
  kCarAhead = 1,
  kLight = 2,
  kAdvice = 3,
  kLimit = 4,
  kGuard = 5,
  kBlock = 6,
};

/// The newest advice that did not reach its car in time. The record knows of it, the car does not.
struct MissedWord {
  WordOrder order;
  std::uint8_t fate = 0;  ///< as on the bus; of any use only if the order is newer than what the unit took
};

struct Car {
  Motion motion;
  double desired_speed_mps = 0.0;
  double noise_mps2 = 0.0;      ///< of the step that ended
  double commanded_mps2 = 0.0;  ///< of the step that ended, NaN = none
  std::uint64_t temporary_id = 0;
  Step entered = 0;
  std::uint32_t vehicle = 0;
  Stage stage = Stage::kIn;
  Decider decider = Decider::kOwnWish;  ///< of the step that ended
  bool equipped = false;
  MissedWord missed;
  OnBoardUnit unit;
};

struct Crossing {
  std::uint32_t vehicle = 0;
  double time_s = 0.0;  ///< interpolated
  Aspect aspect = Aspect::kGreen;
  bool committed = false;
};

struct Departure {
  std::uint32_t vehicle = 0;
  double time_s = 0.0;  ///< interpolated
};

/// What happened on the lanes in one step.
struct LaneEvents {
  std::vector<Crossing> crossings;
  std::vector<Departure> departures;
  std::vector<OutcomeEvent> outcomes;
  std::uint32_t guard_interventions = 0;

  void clear();
};

/// The cars of one lane, approach and exit, front to back: [exit][committed][block][in].
class LaneTraffic {
 public:
  explicit LaneTraffic(const EngineParameters& parameters);

  /// Moves every car from t_(step-1) to t_step under what the head shows at t_(step-1).
  void advance(Step step, Aspect aspect, const UnitRules& rules, LaneEvents& events);
  /// Puts a car at the entrance. Requires that the lane is safe and the speed capped (entrance.hpp).
  void enter(const Car& car);

  [[nodiscard]] const std::vector<Car>& cars() const { return cars_; }
  [[nodiscard]] std::optional<Motion> last() const;
  /// The car, or nullptr if it is not on this lane.
  Car* find(std::uint32_t vehicle);
  [[nodiscard]] const Car* find(std::uint32_t vehicle) const;

 private:
  /// What a car wants, and what its unit will say of the advice in force.
  struct Wanted {
    double acceleration_mps2 = 0.0;
    AdviceOutcome outcome = AdviceOutcome::kApplied;
    Decider decider = Decider::kOwnWish;
  };
  /// What a car sees in the step that is being computed.
  struct View {
    Step step = 0;
    const Motion* ahead = nullptr;        ///< at t_(step-1), nullptr = nobody
    const Motion* moved_ahead = nullptr;  ///< the same car at t_step
    std::optional<double> stop_target_m;  ///< the light lets this car brake to here
    bool held_by_line = false;            ///< the first car that may not cross
    Step fallback = 0;                    ///< steps, see UnitRules
  };

  void note_light(bool green);
  void let_the_first_join_the_block();
  [[nodiscard]] double block_target_mps(bool green) const;
  [[nodiscard]] bool leaves_block(const Car& car, double block_mps) const;
  /// Moves a car of the block to `block_mps`; the front one may be held back. Returns the speed that it got.
  double move_in_block(Car& car, const View& view, double block_mps, bool front, LaneEvents& events);
  void move_freely(Car& car, std::size_t place, const View& view, LaneEvents& events);
  /// The speed that the driver wishes to drive: at most the lane's, if the driver drives by itself.
  [[nodiscard]] static double wished_mps(Car& car, LaneEvents& events);
  [[nodiscard]] Wanted wanted(Car& car, std::size_t place, const View& view, LaneEvents& events);
  [[nodiscard]] Wanted commanded(const Car& car, const View& view, double following_mps2) const;
  /// What a driver wants while an advice that came to its end fades.
  [[nodiscard]] double faded(const Car& car, double wish_mps, double natural_mps2, double share) const;
  /// The natural acceleration that the driver's reaction time lets act now.
  double delayed(std::size_t place, double natural_mps2);
  [[nodiscard]] double guarded_mps(const Car& car, const View& view, double next_mps) const;
  void note_crossings(Step step, Aspect aspect, LaneEvents& events);

  const EngineParameters& parameters_;
  FollowLaw law_;
  std::vector<Car> cars_;
  std::vector<Motion> before_;        ///< the cars' motion at t_(step-1)
  std::size_t delay_steps_;           ///< reaction time beyond the step itself
  std::vector<double> natural_mps2_;  ///< per car its last `delay_steps_` natural accelerations, oldest first
  double block_speed_mps_ = 0.0;
  bool was_green_ = false;
};

}  // namespace lukou::traffic
