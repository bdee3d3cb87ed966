#pragma once

// Inside this room only.

#include <string>

#include "common/core/expected.hpp"
#include "common/scenario/schema.hpp"

namespace lukou::scenario {

/// Sets one field from "path=value", as after --set, and returns its path. The value is in text format; enum names and
/// texts also without quotes; a message as {field: value ...}. On error the scenario stays as it was.
Expected<FieldPath> set_field(Scenario& scenario, const std::string& assignment);

}  // namespace lukou::scenario
