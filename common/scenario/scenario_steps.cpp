#include "common/scenario/scenario_steps.hpp"

#include <utility>

#include "scenario.pb.h"

namespace lukou::scenario {

Protocol protocol(const Resolved& scenario) {
  const Run& run = scenario.message().run();
  std::vector<bool> measured;
  for (const Rsu& rsu : scenario.message().rsus()) measured.push_back(rsu.computing().mode() == Computing::REAL);
  return {.seed = run.seed(),
          .end = step_at_or_after(run.duration_s()),
          .signal_promise = run.signal_promise_steps(),
          .rsus = static_cast<std::uint32_t>(scenario.message().rsus_size()),
          .on_rsu_loss = RsuLoss::Policy_Name(run.on_rsu_loss()),
          .rsu_measured = std::move(measured)};
}

bool is_actuated(const Resolved& scenario) { return scenario.message().signals().has_actuation(); }

bool logs_everything(const Resolved& scenario) { return scenario.message().record().log() == Record::FULL; }

}  // namespace lukou::scenario
