#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "common/intersection/actuation.hpp"
#include "common/intersection/lane_set.hpp"
#include "common/messages/binding.hpp"
#include "services/rsu/sdk/rsu_view.hpp"

namespace lukou {

/// An acceleration for a car, from now on until the lifetime ends or a newer advice comes.
struct Advice {
  double acceleration_mps2 = 0.0;  ///< [-20, 20]; goes over the air in units of 0.01
  Step lifetime = 0;               ///< steps, [1, 6553]
  Binding binding = Binding::kGuard;
};

/// The lanes that are to be green, and no others, from now on until the lifetime ends or a newer request comes. The
/// controller keeps its minimum green, clearances and maximum wait (RsuView::actuation) and refuses whole what would
/// let crossing streams go together; docs/sdk.md.
struct SignalRequest {
  LaneSet green;
  Step lifetime = 0;  ///< steps, [1, kLongestRequest]

  friend bool operator==(const SignalRequest&, const SignalRequest&) = default;
};

/// A stretch of time with one acceleration.
struct AccelerationSegment {
  Step duration = 0;               ///< steps, at least 1
  double acceleration_mps2 = 0.0;  ///< [-20, 20]; goes over the air in units of 0.01
};

/// Accelerations for a car one after the other, from now on. Its life ends with the last of them. A car that hears it
/// late begins with the one that is due then.
struct AccelerationProfile {
  std::vector<AccelerationSegment> segments;  ///< 1 to 32, together at most 6553 steps
  Binding binding = Binding::kGuard;
};

/// A speed for a car: its own unit turns it into an acceleration in every step, as vehicles.on_board_unit says.
struct SpeedAdvice {
  double speed_mps = 0.0;  ///< [0, 163.8]; goes over the air in units of 0.02
  Step lifetime = 0;       ///< steps, [1, 6553]
  Binding binding = Binding::kGuard;
};

/// A speed for everybody on a lane, before its stop line: cars that hear it do not wish to drive faster as long as they
/// drive on their own. Advice to the car itself goes before it.
struct LaneSpeedAdvice {
  Lane lane{};
  double speed_mps = 0.0;  ///< [0, 163.8]; goes over the air in units of 0.02
  Step lifetime = 0;       ///< steps, [1, 6553]
};

/// What an algorithm asks for in one step. The RSU sends it in the order of the calls, lanes after cars; a car uses the
/// newest it hears, whatever its kind. An advice that no message can carry is refused and counted, never bent.
class RsuAnswer {
 public:
  /// A word for one car: one of the three kinds of advice, or none of them = release.
  struct Item {
    TemporaryId car{};
    std::optional<Advice> advice;
    std::optional<AccelerationProfile> profile;
    std::optional<SpeedAdvice> speed;

    [[nodiscard]] bool is_release() const { return !advice && !profile && !speed; }
  };

  void advise(TemporaryId car, const Advice& advice) { items_.push_back({.car = car, .advice = advice}); }
  void advise_profile(TemporaryId car, AccelerationProfile profile) {
    items_.push_back({.car = car, .profile = std::move(profile)});
  }
  void advise_speed(TemporaryId car, const SpeedAdvice& speed) { items_.push_back({.car = car, .speed = speed}); }
  /// The car drives on its own at once, without waiting for the end of an earlier advice.
  void release(TemporaryId car) { items_.push_back({.car = car}); }
  void lane_speed(Lane lane, double speed_mps, Step lifetime) { lanes_.push_back({lane, speed_mps, lifetime}); }

  /// Asks the signal controller for these greens. Of several requests in one step the last one counts.
  void request_green(LaneSet lanes, Step lifetime) { request_ = SignalRequest{lanes, lifetime}; }

  [[nodiscard]] const std::vector<Item>& items() const { return items_; }
  [[nodiscard]] const std::vector<LaneSpeedAdvice>& lanes() const { return lanes_; }
  [[nodiscard]] const std::optional<SignalRequest>& request() const { return request_; }
  void clear() {
    items_.clear();
    lanes_.clear();
    request_.reset();
  }

 private:
  std::vector<Item> items_;
  std::vector<LaneSpeedAdvice> lanes_;
  std::optional<SignalRequest> request_;
};

}  // namespace lukou
