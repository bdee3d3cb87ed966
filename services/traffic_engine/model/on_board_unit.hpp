#pragma once

#include <cstdint>
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
};

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
};

inline constexpr std::uint32_t kNoVehicle = 4294967295U;

/// An outcome that became known. `again`: the advice had been applied in an earlier step.
struct OutcomeEvent {
  std::uint32_t vehicle = kNoVehicle;
  std::uint32_t rsu = 0;
  std::uint32_t sequence = 0;
  AdviceOutcome outcome = AdviceOutcome::kApplied;
  bool again = false;
};

/// The part of a car that hears advice: holds the newest, and says once what became of each.
class OnBoardUnit {
 public:
  /// Takes an advice that is a number and within the limits. Newest is what was issued last; at equal times the higher
  /// RSU, then the higher frame, then the later call.
  void take(const Advice& advice, Step step, std::uint32_t vehicle, std::vector<OutcomeEvent>& outcomes);
  /// Forgets an advice whose life has ended before `step`.
  void expire(Step step) {
    if (holds_ && step > last_step_) holds_ = false;
  }
  /// Forgets what is in force, since the car has crossed its stop line.
  void forget() { holds_ = false; }
  /// Says what a step made of the advice in force. Requires in_force().
  void used(AdviceOutcome outcome, std::uint32_t vehicle, std::vector<OutcomeEvent>& outcomes);

  [[nodiscard]] bool in_force() const { return holds_; }
  /// Requires in_force().
  [[nodiscard]] double command_mps2() const { return command_mps2_; }
  [[nodiscard]] AdviceBinding binding() const { return binding_; }

 private:
  enum class Use : std::uint8_t { kUnused, kApplied, kChanged };

  double command_mps2_ = 0.0;
  Step issued_ = -1;     ///< of the newest word, a release included
  Step last_step_ = -1;  ///< the last step in which the advice may be used
  std::uint32_t rsu_ = 0;
  std::uint32_t sequence_ = 0;
  AdviceBinding binding_ = AdviceBinding::kGuard;
  Use use_ = Use::kUnused;
  bool holds_ = false;
};

}  // namespace lukou::traffic
