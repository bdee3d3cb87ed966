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
  std::vector<std::string> rsu_algorithms;    ///< "NAME" for RSU 0, or "N=NAME"
  std::vector<std::string> rsu_times;         ///< "free" and so on for all RSUs, or "N=free"
  std::vector<std::uint32_t> rsus_of_a_user;  ///< that get a program of their own
};

void add_scenario_arguments(CLI::App& verb, ScenarioArguments& arguments);

/// The file, then --set in order, then the short forms --duration, --seed, --rsu-algorithm and --rsu-time; checked as
/// far as a run needs it (the RSUs' algorithms too). An RSU with a program of its own that the scenario does not have
/// is added if its number is the next one.
Expected<scenario::Resolved> load(const ScenarioArguments& arguments);

/// Whether there are the algorithms that the RSUs are to run, and their parameters are good.
Expected<Done> check_algorithms(const scenario::Resolved& scenario);

/// Prints the errors, one a line, and returns the exit code for a usage or scenario error.
int report_errors(const Error& error);
/// The same for output that could not be written.
int report_output_error(const Error& error);

}  // namespace lukou
