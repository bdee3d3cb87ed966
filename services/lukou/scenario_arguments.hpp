#pragma once

#include <CLI/CLI.hpp>

#include <optional>
#include <string>
#include <vector>

#include "common/core/expected.hpp"
#include "common/scenario/scenario.hpp"

namespace lukou {

/// What every verb that takes a scenario accepts.
struct ScenarioArguments {
  std::string scenario;
  std::vector<std::string> sets;
  std::string duration;
  std::string seed;
  std::string rsu_algorithm;
};

void add_scenario_arguments(CLI::App& verb, ScenarioArguments& arguments);

/// The file, then --set in order, then the short forms --duration, --seed and --rsu-algorithm; checked as far as a run
/// needs it (the RSUs' algorithms too).
Expected<scenario::Resolved> load(const ScenarioArguments& arguments);

/// Prints the errors, one a line, and returns the exit code for a usage or scenario error.
int report_errors(const Error& error);

}  // namespace lukou
