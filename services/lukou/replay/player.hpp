#pragma once

#include <limits>
#include <optional>
#include <string>

#include "common/core/expected.hpp"
#include "common/core/step.hpp"
#include "common/lockstep/messages.hpp"

namespace lukou::replay {

/// Which step of a recording is due, and what its viewers ask for: play, pause, pace, single steps, other places. Pure:
/// the wall time is an argument.
class Player {
 public:
  /// A recording that goes to step `last` and plays from step 0 on, at the pace of real time.
  Player(Step last, double now_s) : last_(last), from_s_(now_s) {}

  /// Takes a viewer's request, as a run's clock does: "pause", "pause at 300", "resume", "step 5", "pace 10", "stop";
  /// and "seek SECONDS". Errors: anything else.
  Expected<std::string> request(double now_s, const std::string& text);

  /// The step to go to now.
  [[nodiscard]] Step due(double now_s) const;
  /// The recording stands at this step now.
  void reached(double now_s, Step step);
  /// Whether what lies before the due step is passed over, not shown.
  [[nodiscard]] bool seeking() const { return seek_.has_value(); }
  /// Somebody has ended the replay.
  [[nodiscard]] bool stopped() const { return stopped_; }
  [[nodiscard]] RunState state(const std::string& run) const;

 private:
  Expected<std::string> seek(double now_s, const std::string& argument);
  void play_from(double now_s, Step step);

  Step last_;
  Step at_ = 0;
  Step hold_at_ = kForever;   ///< plays no further
  std::optional<Step> seek_;  ///< not reached yet
  double pace_ = 1.0;         ///< simulated seconds per second; 0 = as fast as possible
  Step from_ = 0;             ///< where it was at from_s_
  double from_s_;
  bool stopped_ = false;

  static constexpr Step kForever = std::numeric_limits<Step>::max();
};

}  // namespace lukou::replay
