#include "common/scenario/scenario_steps.hpp"

#include "scenario.pb.h"

namespace lukou::scenario {

Protocol protocol(const Resolved& scenario) {
  const Run& run = scenario.message().run();
  return {.seed = run.seed(),
          .end = step_at_or_after(run.duration_s()),
          .signal_promise = run.signal_promise_steps(),
          .rsus = static_cast<std::uint32_t>(scenario.message().rsus_size()),
          .on_rsu_loss = RsuLoss::Policy_Name(run.on_rsu_loss())};
}

}  // namespace lukou::scenario
