#pragma once

// Inside this room only.

#include "common/scenario/schema.hpp"

namespace lukou::scenario {

/// Fills in the radio's preset, gives every absent field that has one its fallback, and adds the one default RSU to a
/// scenario without RSUs. A demand that names a series or a trace gets no flow, signals with a plan get no preset.
void fill_defaults(Scenario& scenario);

}  // namespace lukou::scenario
