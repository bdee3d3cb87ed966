#pragma once

#include "common/bus/batches.hpp"
#include "common/intersection/plan_schedule.hpp"

namespace lukou {

/// The signal controller's step function. Step k decides the heads of step k + promise (step 0: of steps 0 ...
/// promise); what has been decided is published every stride-th step (common/lockstep/edge.hpp).
class SignalControllerNode {
 public:
  SignalControllerNode(SignalPlan plan, Step promise);

  /// The plan of the scenario after the directives of step k. A new one runs from the first start of a cycle at or
  /// after step k + promise.
  void use_plan(const SignalPlan& plan, Step k);
  /// Executes step k. Returns true if `batch` was filled and is to be published.
  bool step(Step k, SignalBatch& batch);

 private:
  void add_forecast(SignalBatch& batch) const;

  SignalPlan latest_;
  PlanSchedule schedule_;
  Step promise_;
  Step stride_;
  Step decided_ = -1;  ///< last step published
};

}  // namespace lukou
