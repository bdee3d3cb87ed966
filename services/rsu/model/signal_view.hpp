#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "common/core/expected.hpp"
#include "common/intersection/signal_promise.hpp"
#include "services/rsu/sdk/rsu_view.hpp"

namespace lukou {

/// What the controller tells of its heads; the arrays of the forecast have the same length.
struct SignalNews {
  Step first = 0;                             ///< first step that `heads` speaks of
  std::span<const std::uint8_t> heads;        ///< (steps x 12) row-major, values of Aspect: a promise
  std::span<const std::uint8_t> change_lane;  ///< forecast under the running plan, by lane, then by time
  std::span<const std::uint8_t> change_aspect;
  std::span<const Step> change_step;
};

/// The heads of the RSU's own intersection: what they show, since when, and what they will show. The promise stands
/// above the forecast.
class SignalView {
 public:
  /// Refuses, and changes nothing, if the heads leave a gap in the promise, the arrays differ in length, or a value is
  /// no lane or no aspect.
  Expected<Done> take(const SignalNews& news);
  [[nodiscard]] bool covers(Step step) const { return promise_.covers(step); }
  /// The last step whose heads are promised.
  [[nodiscard]] Step promised_to() const { return promise_.end() - 1; }
  /// Goes on to a step. Requires that the promise covers it, and that steps do not go back.
  void advance(Step now);

  [[nodiscard]] Aspect aspect(Lane lane) const { return lanes_[index(lane)].aspect; }
  /// First step at which the RSU has seen the aspect without a break.
  [[nodiscard]] Step since(Lane lane) const { return lanes_[index(lane)].since; }
  /// Changes after the step, in the order of time.
  [[nodiscard]] std::span<const SignalChange> changes(Lane lane) const { return lanes_[index(lane)].changes; }

 private:
  struct LaneState {
    Aspect aspect = Aspect::kRed;
    Step since = -1;  ///< -1 = no step seen yet
    std::vector<SignalChange> forecast;
    std::vector<SignalChange> changes;
  };

  void collect_changes(std::size_t lane, Step now);

  SignalPromise promise_;
  std::array<LaneState, kLanes> lanes_;
};

}  // namespace lukou
