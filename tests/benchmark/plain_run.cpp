#include "tests/benchmark/plain_run.hpp"

#include <utility>

#include "services/traffic_engine/traffic_report.hpp"

namespace lukou::test {
namespace {

MeasureParameters measure_parameters(const traffic::EngineParameters& parameters, double warmup_s) {
  MeasureParameters measure;
  measure.warmup_s = warmup_s;
  measure.road = parameters.road;
  return measure;
}

}  // namespace

traffic::EngineParameters plain_parameters(double flow_veh_per_h, int seed) {
  traffic::EngineParameters engine;
  engine.seed = static_cast<std::uint64_t>(seed);
  engine.equipped_ratio = 0.0;
  for (auto& demand : engine.demand) demand.flows = {{.from_s = 0.0, .flow_veh_per_h = flow_veh_per_h}};
  return engine;
}

PlainRun::PlainRun(const traffic::EngineParameters& parameters, SignalPlan plan, double warmup_s)
    : engine_(parameters), plan_(std::move(plan)), measures_(measure_parameters(parameters, warmup_s)) {
  step();
}

void PlainRun::step() {
  Heads heads{};
  for (int i = 0; i < kLanes; ++i) heads[index(Lane(i))] = aspect_at(plan_, Lane(i), next_ - 1);
  engine_.step(next_, heads, {});
  report(engine_, next_, batch_);
  measures_.add(batch_);
  ++next_;
}

void PlainRun::run_to(double end_s) {
  while (next_ <= step_at_or_after(end_s)) step();
}

}  // namespace lukou::test
