#include <cstdio>
#include <memory>

#include "common/process/environment.hpp"
#include "common/process/log.hpp"
#include "services/lukou/scenario_arguments.hpp"
#include "services/lukou/verbs.hpp"

namespace lukou {
namespace {

struct ValidateArguments {
  ScenarioArguments scenario;
  bool print = false;
};

int validate(const ValidateArguments& arguments) {
  const auto scenario = load(arguments.scenario);
  if (!scenario) return report_errors(scenario.error());
  for (const std::string& warning : scenario::warnings(scenario.value())) process::log_warning(warning);
  if (arguments.print) std::fputs(scenario::text(scenario.value()).c_str(), stdout);
  std::fprintf(stderr, "%s is valid, hash %s\n", arguments.scenario.scenario.c_str(),
               scenario::hash(scenario.value()).c_str());
  return process::kExitDone;
}

}  // namespace

Action add_validate(CLI::App& app) {
  CLI::App* verb = app.add_subcommand("validate", "check a scenario without running it");
  auto arguments = std::make_shared<ValidateArguments>();
  add_scenario_arguments(*verb, arguments->scenario);
  verb->add_flag("--print", arguments->print, "print the resolved scenario: every field with its value");
  return [arguments] { return validate(*arguments); };
}

}  // namespace lukou
