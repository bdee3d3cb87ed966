#pragma once

#include <filesystem>
#include <string>

#include "services/lukou/launch/run_request.hpp"

namespace lukou::report {

/// A run's figures for people: all cars, equipped, unequipped side by side, advice, safety, where the results lie.
std::string summary_text(const launch::RunReport& report);

/// The same for machines: one JSON object with how the run ended, the folder, timing and summary.
std::string summary_json(const launch::RunReport& report);

}  // namespace lukou::report
