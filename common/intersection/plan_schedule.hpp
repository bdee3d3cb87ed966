#pragma once

#include <deque>
#include <vector>

#include "common/intersection/signal_plan.hpp"

namespace lukou {

/// A change of one lane's head.
struct HeadChange {
  Step at = 0;
  Aspect to = Aspect::kRed;
};

/// Which plan runs when: the running one and the one that takes over at the next start of a cycle.
class PlanSchedule {
 public:
  /// Requires a validated plan.
  explicit PlanSchedule(SignalPlan first);

  /// `next` takes over at the running plan's first cycle start at or after `earliest`; its own cycles then start there
  /// (plus its offset). A change that has not taken effect by `earliest` is replaced.
  void change(SignalPlan next, Step earliest);

  /// A plan with the step from which it runs; the first one always has.
  struct Running {
    Step from = 0;
    Step offset = 0;  ///< as it was set; that of `plan` counts from step 0
    SignalPlan plan;
  };
  [[nodiscard]] const Running& running_at(Step step) const;
  [[nodiscard]] Heads heads(Step step) const;
  /// Changes of a lane's head in (from, to], in order.
  [[nodiscard]] std::vector<HeadChange> changes(Lane lane, Step from, Step to) const;
  [[nodiscard]] Step cycle_at(Step step) const { return running_at(step).plan.cycle; }
  /// Plans that ended before `step` are not needed any more.
  void forget_before(Step step);

 private:
  std::deque<Running> plans_;  ///< by `from`, never empty
};

}  // namespace lukou
