#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "common/core/step.hpp"
#include "common/scenario/scenario.hpp"

namespace lukou::scenario {

/// What the step protocol needs to know of a scenario.
struct Protocol {
  std::uint64_t seed = 0;
  Step end = 0;             ///< last step
  Step signal_promise = 0;  ///< steps
  std::uint32_t rsus = 0;
  std::string on_rsu_loss;         ///< "ABORT", "CONTINUE" or "WAIT"
  std::vector<bool> rsu_measured;  ///< by RSU: its computing time is measured and acts; two runs may differ then

  [[nodiscard]] bool measures_time() const { return std::ranges::find(rsu_measured, true) != rsu_measured.end(); }
};
Protocol protocol(const Resolved& scenario);
/// Whether the record holds every car in every step, and all that was sent: record.log=FULL.
bool logs_everything(const Resolved& scenario);
/// Whether RSUs may ask for greens.
bool is_actuated(const Resolved& scenario);
inline Step signal_promise(const Resolved& scenario) { return protocol(scenario).signal_promise; }

/// Applies accepted changes ("path=value") in their order; true if there was one. They were checked by the clock, so a
/// failure here is a bug.
template <class Directives>
bool apply(Resolved& scenario, const Directives& directives) {
  for (const auto& directive : directives) {
    const auto done = change(scenario, directive.set);
    LUKOU_EXPECT(done.ok());
  }
  return !directives.empty();
}

}  // namespace lukou::scenario
