#pragma once

#include <string>

#include "common/measures/run_measures.hpp"

namespace lukou {

/// summary.json: every figure of docs/results.md; a mean over no car is null.
std::string summary_json(const RunFigures& figures, Step complete_to, double warmup_s);

}  // namespace lukou
