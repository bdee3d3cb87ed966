#include <cstdio>
#include <memory>
#include <set>

#include "common/process/environment.hpp"
#include "common/process/log.hpp"
#include "services/lukou/scenario_arguments.hpp"
#include "services/lukou/study/plan.hpp"
#include "services/lukou/verbs.hpp"

namespace lukou {
namespace {

struct ValidateArguments {
  ScenarioArguments scenario;
  bool print = false;
  bool fields = false;
};

/// A cell of a Markdown table: a bar would end it.
std::string cell(const std::string& text) {
  std::string escaped;
  for (const char c : text) escaped += c == '|' ? std::string("\\|") : std::string(1, c);
  return escaped;
}

/// Every field as the schema documents it, as a Markdown table.
void print_fields(const std::vector<scenario::FieldDoc>& docs) {
  std::printf("| field | takes | unit | range | default | live | source |\n|---|---|---|---|---|---|---|\n");
  for (const scenario::FieldDoc& doc : docs) {
    char range[64] = "";
    if (doc.min && doc.max) std::snprintf(range, sizeof range, "[%.10g, %.10g]", *doc.min, *doc.max);
    const std::string takes = doc.type + (doc.on_step_grid ? ", a multiple of 0.1" : "");
    std::printf("| `%s` | %s | %s | %s | %s | %s | %s |\n", doc.path.c_str(), cell(takes).c_str(), doc.unit.c_str(),
                range, doc.fallback.empty() ? "" : ("`" + doc.fallback + "`").c_str(), doc.live ? "yes" : "",
                cell(doc.source).c_str());
  }
}

/// Warnings of a study's scenarios, each once.
void warn(const studies::Study& study, const studies::Plan& plan) {
  std::set<std::string> said;
  for (const studies::Point& point : plan.points) {
    const auto scenario = studies::scenario_of(study, point, study.first_seed);
    if (!scenario) continue;
    for (const std::string& warning : scenario::warnings(scenario.value())) {
      if (said.insert(warning).second) process::log_warning(studies::text(study, point) + ": " + warning);
    }
  }
}

int validate_study(const ValidateArguments& arguments) {
  const ScenarioArguments& given = arguments.scenario;
  if (!given.duration.empty() || !given.seed.empty() || !given.rsu_algorithms.empty() || !given.rsu_times.empty()) {
    return report_errors({given.scenario, "is a study: of the options of a scenario it takes --set alone"});
  }
  const auto loaded = studies::load(given.scenario, {.sets = given.sets, .seeds = {}});
  if (!loaded) return report_errors(loaded.error());
  const studies::Study& study = loaded.value();
  const studies::Plan plan = studies::plan_of(study);
  warn(study, plan);
  if (arguments.fields) print_fields(studies::field_docs());
  if (arguments.print) std::fputs(study.text.c_str(), stdout);
  std::fprintf(stderr, "%s is valid: %zu cells, %zu arms, %zu points, %zu runs%s, hash %s\n", given.scenario.c_str(),
               plan.cells.size(), study.arms.size(), plan.points.size(), plan.points.size() * study.seeds,
               study.precision ? " in the first round" : "", studies::hash(study).c_str());
  return process::kExitDone;
}

int validate(const ValidateArguments& arguments) {
  if (studies::is_study(arguments.scenario.scenario)) return validate_study(arguments);
  const auto scenario = load(arguments.scenario);
  if (!scenario) return report_errors(scenario.error());
  for (const std::string& warning : scenario::warnings(scenario.value())) process::log_warning(warning);
  for (const std::string& line : scenario::sensor_lines(scenario.value())) std::fprintf(stderr, "%s\n", line.c_str());
  if (arguments.fields) print_fields(scenario::field_docs());
  if (arguments.print) std::fputs(scenario::text(scenario.value()).c_str(), stdout);
  std::fprintf(stderr, "%s is valid, hash %s\n", arguments.scenario.scenario.c_str(),
               scenario::hash(scenario.value()).c_str());
  return process::kExitDone;
}

}  // namespace

Action add_validate(CLI::App& app) {
  CLI::App* verb = app.add_subcommand("validate", "check a scenario or a study without running it");
  auto arguments = std::make_shared<ValidateArguments>();
  add_scenario_arguments(*verb, arguments->scenario);
  verb->add_flag("--print", arguments->print, "print it resolved: every field with its value");
  verb->add_flag("--fields", arguments->fields,
                 "print every field that it may have: type, unit, range, default, source");
  return [arguments] { return validate(*arguments); };
}

}  // namespace lukou
