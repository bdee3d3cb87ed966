#pragma once

#include <optional>

#include "common/intersection/actuation.hpp"

namespace lukou::scenario {

class Scenario;  // idl/scenario.proto

/// What the signal controller keeps when RSUs ask for greens; empty if it runs the plan of a resolved scenario as it
/// stands.
std::optional<lukou::Actuation> actuation(const Scenario& scenario);

}  // namespace lukou::scenario
