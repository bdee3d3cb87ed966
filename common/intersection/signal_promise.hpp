#pragma once

#include <cstdint>
#include <deque>
#include <span>

#include "common/intersection/signal_plan.hpp"

namespace lukou {

/// The heads that the signal controller has promised so far, as its batches brought them.
class SignalPromise {
 public:
  /// Adds the heads of the steps first, first + 1, ... ((steps x 12) row-major, values of Aspect).
  /// Returns false, and changes nothing, if they leave a gap or hold an unknown aspect. Steps already known stay.
  /// The first batch may begin at any step: an RSU that joins late never saw the earlier ones.
  bool extend(Step first, std::span<const std::uint8_t> heads);
  /// Requires that `step` is promised and not forgotten.
  [[nodiscard]] const Heads& at(Step step) const;
  [[nodiscard]] bool covers(Step step) const {
    return step >= first_ && step < first_ + static_cast<Step>(heads_.size());
  }
  /// The step after the last promised one; 0 before the first batch.
  [[nodiscard]] Step end() const { return first_ + static_cast<Step>(heads_.size()); }
  /// Forgets what lies before `step`.
  void forget_before(Step step);

 private:
  Step first_ = 0;
  std::deque<Heads> heads_;
};

}  // namespace lukou
