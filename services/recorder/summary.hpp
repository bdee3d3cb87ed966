#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "common/measures/request_ledger.hpp"
#include "common/measures/run_measures.hpp"
#include "common/measures/safety_measures.hpp"

namespace lukou {

/// summary.json: every figure of docs/results.md; a mean over no car is null. `radio_modelled`: with what the radio did
/// to advice. `requests`: how requests for greens fared, if the controller hears them or anybody asked.
/// `deadline_misses`: steps that took an RSU longer than a step; empty if none is measured. `safety`: empty if it is
/// not recorded.
std::string summary_json(const RunFigures& figures, Step complete_to, double warmup_s, bool radio_modelled,
                         const std::optional<RequestFigures>& requests,
                         std::optional<std::uint64_t> deadline_misses = {},
                         const std::optional<SafetyFigures>& safety = {});

}  // namespace lukou
