#pragma once

#include <filesystem>
#include <string>

#include "services/lukou/launch/run_request.hpp"

namespace lukou::report {

/// A run's figures for people: all cars, equipped, unequipped side by side, advice, safety, where the results lie.
std::string summary_text(const launch::RunReport& report);

/// The last lines that the run's processes said, for a run that did not end well; "" if there are none.
std::string last_words(const launch::RunReport& report);

/// The figures for machines: one JSON object with how the run ended, the folder, timing and summary.
std::string summary_json(const launch::RunReport& report);

}  // namespace lukou::report
