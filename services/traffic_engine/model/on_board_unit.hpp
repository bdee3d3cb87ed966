#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <tuple>
#include <vector>

#include "common/core/step.hpp"

namespace lukou::traffic {

/// How an advice binds the car: see the design's third promise.
enum class AdviceBinding : std::uint8_t {
  kGuard,      ///< the commanded acceleration is used; limits and guard alone may change it
  kFollowing,  ///< the smaller of the command and the following law is used
};

/// What became of an advice. The values are those of AdviceFate on the bus.
enum class AdviceOutcome : std::uint8_t {
  kApplied = 0,
  kChangedLimit = 1,
  kChangedGuard = 2,
  kChangedFollowing = 3,
  kChangedRed = 4,
  kPastStopLine = 5,
  kExpired = 6,
  kSuperseded = 7,
  kUnknownVehicle = 8,
  kMalformed = 9,
  kOutOfLimit = 10,
  kStale = 14,
  kNotComplied = 20,
  kChangedDriver = 21,
  kLate = 22,
};

/// Where a car stands with guidance. The values are those of GuidanceState on the bus, without its first.
enum class Guidance : std::uint8_t {
  kNeverAdvised = 1,
  kInForce = 2,
  kReleased = 3,
  kExpired = 4,
  kRsuUnheard = 5,
  kNotComplied = 6,
  kPastStopLine = 7,
  kReacting = 8,
};

/// What an advice asks for. The values are those of AdviceKind on the bus.
enum class AdviceKind : std::uint8_t {
  kAcceleration = 0,
  kProfile = 1,    ///< accelerations one after the other
  kSpeed = 2,      ///< a speed that the unit makes for
  kLaneSpeed = 3,  ///< a speed not to wish to exceed, for everybody on the lane
};

/// Another acceleration from the step issued + 1 + after on.
struct LaterCommand {
  Step after = 0;
  double acceleration_mps2 = 0.0;
};

inline constexpr double kNoSpeed = std::numeric_limits<double>::quiet_NaN();

/// An advice as the radio delivered it. It may be used in the steps issued + 1 ... issued + lifetime.
struct Advice {
  std::uint64_t target = 0;  ///< temporary id
  double acceleration_mps2 = 0.0;
  AdviceBinding binding = AdviceBinding::kGuard;
  bool release = false;  ///< cancels what is in force; commands nothing and gets no outcome
  Step issued = 0;
  Step lifetime = 0;           ///< steps
  std::uint32_t rsu = 0;       ///< index in the scenario's list
  std::uint32_t sequence = 0;  ///< of the frame, per RSU
  AdviceKind kind = AdviceKind::kAcceleration;
  double speed_mps = kNoSpeed;      ///< of the two kinds that ask for one; then `acceleration_mps2` is no number
  std::vector<LaterCommand> later;  ///< of a profile, ascending; the first command is `acceleration_mps2`
};

inline constexpr std::uint32_t kNoVehicle = 4294967295U;

/// An outcome that became known. `again`: the advice had been applied in an earlier step.
struct OutcomeEvent {
  std::uint32_t vehicle = kNoVehicle;
  std::uint32_t rsu = 0;
  std::uint32_t sequence = 0;
  AdviceOutcome outcome = AdviceOutcome::kApplied;
  bool again = false;
  Step issued = 0;
  double command_mps2 = 0.0;  ///< the one that was due; no number if a speed never became one
  AdviceKind kind = AdviceKind::kAcceleration;
  double speed_mps = kNoSpeed;
};

/// What became of an advice that no unit holds.
OutcomeEvent outcome_of(const Advice& advice, AdviceOutcome outcome, std::uint32_t vehicle);

/// Where a word stands among the others: what was issued last is the newest; at equal times the higher RSU, then the
/// higher frame.
struct WordOrder {
  Step issued = -1;
  std::uint32_t rsu = 0;
  std::uint32_t sequence = 0;

  friend auto operator<=>(const WordOrder&, const WordOrder&) = default;
};
inline WordOrder order_of(const Advice& advice) { return {advice.issued, advice.rsu, advice.sequence}; }

/// How the driver of a car takes advice.
struct AdvisedDriver {
  enum class Kind : std::uint8_t {
    kAutomated,  ///< exactly
    kHuman,      ///< late and imperfectly
    kIgnoring,   ///< not at all
  };
  Kind kind = Kind::kAutomated;
  double gain = 1.0;  ///< of a human, >= 0: does this times the command
};

/// What holds for the units of all cars in a step.
struct UnitRules {
  Step fallback = 10;                    ///< steps; 0 = at once
  Step rsu_lost_after = 20;              ///< steps, at least 1
  Step reaction = 10;                    ///< steps, of humans
  double threshold_mps2 = 0.1;           ///< of humans
  double speed_gain_time_s = 2.0;        ///< an advised speed becomes the acceleration (wanted - own) / this ...
  double speed_acceleration_mps2 = 2.0;  ///< ... at most this
  double speed_deceleration_mps2 = 1.5;  ///< ... and at least minus this
  std::span<const Step> everybody;       ///< by RSU: the newest step at whose instant every unit heard it; -1 = never
};

/// The part of a car that hears advice, and the driver's way to take it: holds the newest word, and says once what
/// became of each.
class OnBoardUnit {
 public:
  OnBoardUnit() = default;
  explicit OnBoardUnit(const AdvisedDriver& driver) : driver_(driver) {}

  /// Takes an advice that is a number and within the limits; used from `step` on, so heard at the instant before.
  void take(const Advice& advice, Step step, std::uint32_t vehicle, std::vector<OutcomeEvent>& outcomes);
  /// Another frame of this RSU reached the unit at the instant of `heard`.
  void hear(std::uint32_t rsu, Step heard);
  /// Before the car moves in `step`: ends what has come to its end, lets a human act on what has been shown long
  /// enough, and works out the command of this step, at the car's present speed.
  void advance(Step step, double speed_mps, const UnitRules& rules, std::uint32_t vehicle,
               std::vector<OutcomeEvent>& outcomes) {
    if (shown_) look(step, rules, vehicle, outcomes);
    if (acting_.kind != AdviceKind::kAcceleration && in_force()) work_out(step, speed_mps, rules);
    if (lane_word_.lives) look_at_lane(step, rules, vehicle, outcomes);
  }
  /// The car has crossed its stop line.
  void forget(std::uint32_t vehicle, std::vector<OutcomeEvent>& outcomes);
  /// Says what a step made of the advice in force. Requires in_force().
  void used(AdviceOutcome outcome, std::uint32_t vehicle, std::vector<OutcomeEvent>& outcomes);

  /// Whether the driver acts on an advice.
  [[nodiscard]] bool in_force() const { return state_ == Guidance::kInForce; }
  /// The speed that the driver does not wish to exceed when no advice is in force; infinite without one.
  [[nodiscard]] double lane_speed_mps() const {
    return lane_word_.lives ? lane_word_.speed_mps : std::numeric_limits<double>::infinity();
  }
  /// Says that a step kept to the lane's speed. Requires that there is one.
  void kept_to_lane_speed(std::uint32_t vehicle, std::vector<OutcomeEvent>& outcomes);
  /// As it was commanded for the step. Requires in_force().
  [[nodiscard]] double command_mps2() const { return acting_.command_mps2; }
  /// As the driver takes it: the command itself, but for humans. Requires in_force().
  [[nodiscard]] double acted_mps2() const { return acting_.acted_mps2; }
  [[nodiscard]] AdviceBinding binding() const { return acting_.binding; }
  [[nodiscard]] Guidance state() const { return state_; }
  /// The newest word that it took, a release included.
  [[nodiscard]] const WordOrder& newest() const { return newest_; }
  [[nodiscard]] const AdvisedDriver& driver() const { return driver_; }

  /// After an advice came to its end: the share of last_acted_mps2() in what the driver wants in `step`, falling
  /// linearly to 0 in `fallback` steps; 0 otherwise.
  [[nodiscard]] double fallback_share(Step step, Step fallback) const {
    const Step passed = step - ended_ + 1;
    return passed < fallback ? 1.0 - static_cast<double>(passed) / static_cast<double>(fallback) : 0.0;
  }
  [[nodiscard]] double last_acted_mps2() const { return acting_.acted_mps2; }
  /// Whether hearing its RSU matters to a unit that has not heard it at the instant before `step`: what it shows would
  /// outlive the silence.
  [[nodiscard]] bool listens(std::uint32_t rsu, Step step, Step rsu_lost_after) const {
    if (shown_ && newest_.rsu == rsu && heard_ < step - 1 && shown_until_ > heard_ + rsu_lost_after) return true;
    return lane_word_.lives && lane_word_.order.rsu == rsu && lane_word_.heard < step - 1 &&
           lane_word_.until > lane_word_.heard + rsu_lost_after;
  }

 private:
  enum class Use : std::uint8_t { kUnused, kApplied, kChanged };
  struct Word {
    WordOrder order;
    double command_mps2 = 0.0;
    double acted_mps2 = 0.0;
    Step heard = 0;
    AdviceBinding binding = AdviceBinding::kGuard;
    Use use = Use::kUnused;
    bool bent = false;  ///< by the driver: late, or not as commanded
    AdviceKind kind = AdviceKind::kAcceleration;
    double speed_mps = kNoSpeed;
    std::vector<LaterCommand> later;
  };
  /// The newest speed for the lane.
  struct LaneWord {
    WordOrder order;
    double speed_mps = 0.0;
    Step until = -1;  ///< the last step of its life
    Step heard = -1;  ///< when its RSU was heard last
    bool lives = false;
    bool used = false;
  };
  static constexpr Step kLongAgo = -1'000'000;

  void take_lane_speed(const Advice& advice, Step step, std::uint32_t vehicle, std::vector<OutcomeEvent>& outcomes);
  void work_out(Step step, double speed_mps, const UnitRules& rules);
  void look_at_lane(Step step, const UnitRules& rules, std::uint32_t vehicle, std::vector<OutcomeEvent>& outcomes);
  void end_lane_word(AdviceOutcome reason, std::uint32_t vehicle, std::vector<OutcomeEvent>& outcomes);
  [[nodiscard]] OutcomeEvent lane_event(AdviceOutcome outcome, std::uint32_t vehicle) const;
  static OutcomeEvent event(const Word& word, AdviceOutcome outcome, std::uint32_t vehicle);
  void look(Step step, const UnitRules& rules, std::uint32_t vehicle, std::vector<OutcomeEvent>& outcomes);
  void react(Step step, const UnitRules& rules, std::uint32_t vehicle, std::vector<OutcomeEvent>& outcomes);
  /// Drops what the driver has not acted on yet.
  void drop_waiting(AdviceOutcome reason, std::uint32_t vehicle, std::vector<OutcomeEvent>& outcomes);

  AdvisedDriver driver_;
  Word acting_;                ///< what the driver acts on, or acted on last
  std::vector<Word> waiting_;  ///< of a human: shown, but not reacted to; oldest first
  WordOrder newest_;           ///< a release included
  LaneWord lane_word_;
  Step shown_until_ = -1;  ///< the last step of the newest word's life
  Step heard_ = -1;        ///< when the RSU of the newest word was heard last
  Step ended_ = kLongAgo;  ///< the first step after an advice that came to its end
  Guidance state_ = Guidance::kNeverAdvised;
  bool shown_ = false;  ///< the newest word is an advice that lives
};

}  // namespace lukou::traffic
