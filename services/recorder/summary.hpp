#pragma once

#include <string>

#include "common/measures/run_measures.hpp"

namespace lukou {

/// summary.json: every figure of docs/results.md; a mean over no car is null. `radio_modelled`: with what the radio did
/// to advice.
std::string summary_json(const RunFigures& figures, Step complete_to, double warmup_s, bool radio_modelled);

}  // namespace lukou
