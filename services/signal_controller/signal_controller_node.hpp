#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "common/bus/batches.hpp"
#include "common/intersection/plan_schedule.hpp"
#include "services/signal_controller/model/actuated_heads.hpp"
#include "services/signal_controller/model/request_desk.hpp"

namespace lukou {

/// The signal controller's step function. Step k decides the heads of step k + promise (step 0: of steps 0 ...
/// promise); what has been decided is published every stride-th step (common/lockstep/edge.hpp). A plan runs as it
/// stands, or, with an actuation, RSUs may ask for greens and the plan is what stands in for a request.
class SignalControllerNode {
 public:
  SignalControllerNode(SignalPlan plan, Step promise, const std::optional<Actuation>& actuation = std::nullopt);

  /// The plan of the scenario after the directives of step k. A new one runs from the first start of a cycle at or
  /// after step k + promise.
  void use_plan(const SignalPlan& plan, Step k);
  /// What an RSU asked for in its step k - 1, before step(k); the RSUs in the order of their indices. Of several
  /// requests the last one counts. Requires an actuation, and columns of one length (flaw_of).
  void hear(Step k, const RequestBatch& requests);
  /// Executes step k. Returns true if `batch` was filled and is to be published.
  bool step(Step k, SignalBatch& batch);

 private:
  struct Actuated {
    ActuatedHeads heads;
    RequestDesk desk;
    std::vector<Heads> unpublished;  ///< decided since the last batch
  };

  void decide(Step k);
  void add_forecast(SignalBatch& batch) const;
  void add_certain_changes(SignalBatch& batch) const;
  void add_request_news(SignalBatch& batch);

  SignalPlan latest_;
  PlanSchedule schedule_;
  Step promise_;
  Step stride_;
  Step decided_ = -1;  ///< last step published
  std::optional<Actuated> actuated_;
};

}  // namespace lukou
