#include "services/lukou/scenario_arguments.hpp"

#include <cstdio>

#include "common/process/environment.hpp"
#include "common/scenario/scenario_steps.hpp"
#include "services/rsu/rsu_config.hpp"

namespace lukou {

void add_scenario_arguments(CLI::App& verb, ScenarioArguments& arguments) {
  verb.add_option("scenario", arguments.scenario, "a scenario file, or the name of a shipped one (paper)")->required();
  // One word each: `--set a=1 paper` must not swallow the scenario.
  verb.add_option("--set", arguments.sets, "PATH=VALUE, any field of the scenario; may be repeated")
      ->type_size(1)
      ->allow_extra_args(false)
      ->type_name("PATH=VALUE");
  verb.add_option("--duration", arguments.duration, "simulated seconds: --set run.duration_s=...");
  verb.add_option("--seed", arguments.seed, "--set run.seed=...");
  verb.add_option("--rsu-algorithm", arguments.rsu_algorithm, "--set rsus[0].algorithm=...");
}

Expected<scenario::Resolved> load(const ScenarioArguments& arguments) {
  std::vector<std::string> sets = arguments.sets;
  if (!arguments.duration.empty()) sets.push_back("run.duration_s=" + arguments.duration);
  if (!arguments.seed.empty()) sets.push_back("run.seed=" + arguments.seed);
  if (!arguments.rsu_algorithm.empty()) sets.push_back("rsus[0].algorithm=" + arguments.rsu_algorithm);
  auto scenario = scenario::load(arguments.scenario, sets);
  if (!scenario) return scenario;
  for (std::uint32_t rsu = 0; rsu < scenario::protocol(scenario.value()).rsus; ++rsu) {
    const auto config = rsu_config(scenario.value().message(), rsu);
    if (!config) return config.error();
    const auto algorithm = make_algorithm(config.value().algorithm, config.value().parameters);
    if (!algorithm) return Error{"rsus[" + std::to_string(rsu) + "].algorithm", algorithm.error().what};
  }
  return scenario;
}

int report_errors(const Error& error) {
  std::fprintf(stderr, "%s\n", error.text().c_str());
  return process::kExitUsage;
}

}  // namespace lukou
