#pragma once

#include <optional>
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

/// What an algorithm asks for in one step. The RSU sends it in the order of the calls; a car uses the newest it hears.
/// An advice that no message can carry is refused and counted, never bent.
class RsuAnswer {
 public:
  struct Item {
    TemporaryId car{};
    std::optional<Advice> advice;  ///< empty = release
  };

  void advise(TemporaryId car, const Advice& advice) { items_.push_back({car, advice}); }
  /// The car drives on its own at once, without waiting for the end of an earlier advice.
  void release(TemporaryId car) { items_.push_back({car, std::nullopt}); }

  /// Asks the signal controller for these greens. Of several requests in one step the last one counts.
  void request_green(LaneSet lanes, Step lifetime) { request_ = SignalRequest{lanes, lifetime}; }

  [[nodiscard]] const std::vector<Item>& items() const { return items_; }
  [[nodiscard]] const std::optional<SignalRequest>& request() const { return request_; }
  void clear() {
    items_.clear();
    request_.reset();
  }

 private:
  std::vector<Item> items_;
  std::optional<SignalRequest> request_;
};

}  // namespace lukou
