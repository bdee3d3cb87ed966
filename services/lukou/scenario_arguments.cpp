#include "services/lukou/scenario_arguments.hpp"

#include <algorithm>
#include <cstdio>

#include "common/process/environment.hpp"
#include "common/scenario/scenario_steps.hpp"
#include "services/lukou/rsu_option.hpp"
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
  const auto one_word = [&](const char* name, std::vector<std::string>& values, const char* help, const char* type) {
    verb.add_option(name, values, help)->type_size(1)->allow_extra_args(false)->type_name(type);
  };
  one_word("--rsu-algorithm", arguments.rsu_algorithms, "--set rsus[0].algorithm=..., or of RSU N; may be repeated",
           "[N=]NAME");
  one_word("--rsu-time", arguments.rsu_times,
           "what an RSU's computing time does: free, declared:20ms or real; of all RSUs, or of RSU N", "[N=]TIME");
}

namespace {

/// The short forms as --set has them, but for those that ask how many RSUs there are.
std::vector<std::string> plain_sets(const ScenarioArguments& arguments) {
  std::vector<std::string> sets = arguments.sets;
  if (!arguments.duration.empty()) sets.push_back("run.duration_s=" + arguments.duration);
  if (!arguments.seed.empty()) sets.push_back("run.seed=" + arguments.seed);
  for (const std::string& text : arguments.rsu_algorithms) {
    const RsuOption option = rsu_option(text);
    sets.push_back("rsus[" + std::to_string(option.rsu.value_or(0)) + "].algorithm=" + option.value);
  }
  return sets;
}

/// Adds the RSUs that a user's programs are for. Returns how many there are then.
Expected<std::uint32_t> add_rsus(std::vector<std::uint32_t> wanted, std::uint32_t rsus,
                                 std::vector<std::string>& sets) {
  std::ranges::sort(wanted);
  for (const std::uint32_t rsu : wanted) {
    if (rsu < rsus) continue;
    if (rsu > rsus) {
      return Error{"--rsu " + std::to_string(rsu) + "=...", "the scenario has " + std::to_string(rsus) +
                                                                (rsus == 1 ? " RSU" : " RSUs") + "; the next one is " +
                                                                std::to_string(rsus)};
    }
    sets.push_back("rsus[" + std::to_string(rsus++) + "].algorithm=none");
  }
  return rsus;
}

Expected<Done> add_times(const std::vector<std::string>& texts, std::uint32_t rsus, std::vector<std::string>& sets) {
  const auto times = rsu_options("--rsu-time", texts);
  if (!times) return times.error();
  const auto set = [&](std::uint32_t rsu, const std::string& text) -> Expected<Done> {
    const auto value = computing_value(text);
    if (!value) return value.error();
    sets.push_back("rsus[" + std::to_string(rsu) + "].computing=" + value.value());
    return Done{};
  };
  for (std::uint32_t rsu = 0; rsu < rsus && !times.value().all.empty(); ++rsu) {
    if (times.value().of.contains(rsu)) continue;
    if (auto done = set(rsu, times.value().all); !done) return done;
  }
  for (const auto& [rsu, text] : times.value().of) {
    if (auto done = set(rsu, text); !done) return done;
  }
  return Done{};
}

}  // namespace

Expected<scenario::Resolved> load(const ScenarioArguments& arguments) {
  std::vector<std::string> sets = plain_sets(arguments);
  auto scenario = scenario::load(arguments.scenario, sets);
  if (!scenario) return scenario;
  if (!arguments.rsus_of_a_user.empty() || !arguments.rsu_times.empty()) {
    const auto rsus = add_rsus(arguments.rsus_of_a_user, scenario::protocol(scenario.value()).rsus, sets);
    if (!rsus) return rsus.error();
    if (auto done = add_times(arguments.rsu_times, rsus.value(), sets); !done) return done.error();
    scenario = scenario::load(arguments.scenario, sets);
    if (!scenario) return scenario;
  }
  if (auto known = check_algorithms(scenario.value()); !known) return known.error();
  return scenario;
}

Expected<Done> check_algorithms(const scenario::Resolved& scenario) {
  for (std::uint32_t rsu = 0; rsu < scenario::protocol(scenario).rsus; ++rsu) {
    const auto config = rsu_config(scenario.message(), rsu);
    if (!config) return config.error();
    const auto algorithm = make_algorithm(config.value().algorithm, config.value().parameters);
    if (!algorithm) return Error{"rsus[" + std::to_string(rsu) + "].algorithm", algorithm.error().what};
  }
  return Done{};
}

int report_errors(const Error& error) {
  std::fprintf(stderr, "%s\n", error.text().c_str());
  return process::kExitUsage;
}

int report_output_error(const Error& error) {
  std::fprintf(stderr, "%s\n", error.text().c_str());
  return process::kExitIo;
}

}  // namespace lukou
