#include "common/scenario/actuation.hpp"

#include "scenario.pb.h"

namespace lukou::scenario {

std::optional<lukou::Actuation> actuation(const Scenario& scenario) {
  if (!scenario.signals().has_actuation()) return std::nullopt;
  const Actuation& said = scenario.signals().actuation();
  return lukou::Actuation{.min_green = step_at_or_after(said.min_green_s()),
                          .yellow = step_at_or_after(said.yellow_s()),
                          .all_red = step_at_or_after(said.all_red_s()),
                          .max_wait = step_at_or_after(said.max_wait_s())};
}

}  // namespace lukou::scenario
