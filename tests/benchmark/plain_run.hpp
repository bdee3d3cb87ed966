#pragma once

#include "common/intersection/signal_plan.hpp"
#include "common/measures/run_measures.hpp"
#include "services/traffic_engine/model/engine.hpp"

namespace lukou::test {

/// The paper's intersection with `flow_veh_per_h` on every approach and no car with an on-board unit.
traffic::EngineParameters plain_parameters(double flow_veh_per_h, int seed);

/// The traffic engine and the measures alone, without guidance, step by step; at step 0 after construction.
class PlainRun {
 public:
  PlainRun(const traffic::EngineParameters& parameters, SignalPlan plan, double warmup_s);

  void step();
  void run_to(double end_s);
  [[nodiscard]] const TrafficBatch& batch() const { return batch_; }
  [[nodiscard]] const RunMeasures& measures() const { return measures_; }

 private:
  traffic::Engine engine_;
  SignalPlan plan_;
  RunMeasures measures_;
  TrafficBatch batch_;
  Step next_ = 0;
};

}  // namespace lukou::test
