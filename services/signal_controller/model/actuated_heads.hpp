#pragma once

#include <array>

#include "common/intersection/actuation.hpp"
#include "common/intersection/lane_set.hpp"
#include "common/intersection/signal_plan.hpp"

namespace lukou {

/// The heads of the twelve lanes on their way to the greens that somebody wants. Whatever is wanted: a green lasts for
/// at least the minimum, then comes the yellow, then red; a lane goes green when every lane that crosses it has been
/// red for the all-red, and when it has itself.
///
/// A lane that has been red for the maximum wait comes first: until it has had its minimum green, lanes that cross it
/// are not wanted. Of several such lanes the one that waits longest is served first, and with it those that cross
/// nothing that waits longer. So no red lasts longer than longest_red().
class ActuatedHeads {
 public:
  explicit ActuatedHeads(const Actuation& actuation);

  /// Decides the heads of the next step, from 0 on; with step 0 what is wanted is green at once. Returns kAccepted,
  /// kMinGreen or kMaxWait: what keeps the heads from going to `wanted`, clearances excepted.
  /// Requires steps one after the other, and no two crossing lanes in `wanted`.
  RequestOutcome decide(Step at, LaneSet wanted);

  [[nodiscard]] const Heads& heads() const { return heads_; }
  /// The step with which a yellow ends; -1 if the lane's head is not yellow.
  [[nodiscard]] Step yellow_end(Lane lane) const;

 private:
  /// The lanes that are to be green: those that have waited too long before those that are wanted.
  LaneSet target(Step at, LaneSet wanted);
  void show(Lane lane, Aspect aspect, Step at);
  [[nodiscard]] bool is_clear_for(Lane lane, Step at) const;

  Actuation actuation_;
  Step next_ = 0;
  Heads heads_{};
  std::array<Step, kLanes> since_{};  ///< first step of what the head shows
  LaneSet served_;                    ///< waited too long, and have not yet had their minimum green
};

/// Steps that no red exceeds. When a lane is overdue at most eleven others are served before it, one after the other.
/// For each, a green that crosses it ends, min_green + yellow + all_red at most, then it has its own minimum green.
constexpr Step longest_red(const Actuation& actuation) {
  const Step until_green = actuation.min_green + actuation.yellow + actuation.all_red;
  return actuation.max_wait + (kLanes - 1) * (until_green + actuation.min_green) + until_green;
}

}  // namespace lukou
