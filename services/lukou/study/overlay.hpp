#pragma once

#include <optional>
#include <string>

#include "services/lukou/study/study.hpp"

namespace lukou::studies {

std::string name(Overlay overlay);

/// What a formula says of the mean delay [s] over all lanes of a scenario, weighted by their flows: with the saturation
/// flow of this model, the displayed green of the plan, and the run's length as the time that is analysed. None where
/// the formula has no value, and for demand that is no constant flow.
std::optional<double> formula_delay_s(const scenario::Resolved& scenario, Overlay overlay);

}  // namespace lukou::studies
