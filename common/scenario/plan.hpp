#pragma once

// Inside this room only.

#include <vector>

#include "common/intersection/signal_plan.hpp"
#include "common/scenario/check.hpp"

namespace lukou::scenario {

/// What is wrong with the signal plan, preset or user's: lanes unknown, twice or missing, durations that do not add up,
/// crossing streams green together.
std::vector<Finding> plan_findings(const Scenario& scenario);

/// The plan of a scenario without plan_findings().
lukou::SignalPlan plan_of(const Scenario& scenario);

}  // namespace lukou::scenario
