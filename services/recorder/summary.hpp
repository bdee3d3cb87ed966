#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "common/measures/request_ledger.hpp"
#include "common/measures/run_measures.hpp"
#include "common/measures/safety_measures.hpp"

namespace lukou {

/// What summary.json holds only in some runs.
struct SummaryExtras {
  std::optional<RequestFigures> requests;        ///< if the controller hears requests for greens, or anybody asked
  std::optional<std::uint64_t> deadline_misses;  ///< steps that took an RSU longer than a step, if one is measured
  std::optional<SafetyFigures> safety;           ///< if it is recorded
};

/// summary.json: every figure of docs/results.md; a mean over no car is null. `radio_modelled`: with what the radio did
/// to advice.
std::string summary_json(const RunFigures& figures, Step complete_to, double warmup_s, bool radio_modelled,
                         const SummaryExtras& extras);

}  // namespace lukou
