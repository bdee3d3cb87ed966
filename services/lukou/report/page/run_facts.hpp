#pragma once

#include <string>

#include "services/lukou/report/result.hpp"

namespace lukou::report {

/// The sections of a run's report that are words and numbers, as HTML in both languages.

/// What was run: scenario, seed, version, hashes, how it ended.
std::string facts_section(const Result& result);
/// What a reader should know before believing a figure: how the run ended, anomalies, warnings of the scenario. Empty:
/// nothing.
std::string warnings_section(const Result& result);
/// The figures of all, equipped and unequipped cars; causes of stops.
std::string summary_section(const Result& result);
/// Files with their hashes, the operator's changes, the scenario, and how to have it again.
std::string record_section(const Result& result);

}  // namespace lukou::report
