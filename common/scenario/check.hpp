#pragma once

// Inside this room only.

#include <vector>

#include "common/scenario/field_check.hpp"

namespace lukou::scenario {

/// Everything that is wrong, field by field, with a scenario whose defaults have been filled in; crossing streams that
/// are green together and the contents of traces included.
std::vector<Finding> check(const Scenario& scenario);

}  // namespace lukou::scenario
