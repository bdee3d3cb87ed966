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
  bool fields = false;
};

/// A cell of a Markdown table: a bar would end it.
std::string cell(const std::string& text) {
  std::string escaped;
  for (const char c : text) escaped += c == '|' ? std::string("\\|") : std::string(1, c);
  return escaped;
}

/// Every field of a scenario as the schema documents it, as a Markdown table.
void print_fields() {
  std::printf("| field | takes | unit | range | default | live | source |\n|---|---|---|---|---|---|---|\n");
  for (const scenario::FieldDoc& doc : scenario::field_docs()) {
    char range[64] = "";
    if (doc.min && doc.max) std::snprintf(range, sizeof range, "[%.10g, %.10g]", *doc.min, *doc.max);
    const std::string takes = doc.type + (doc.on_step_grid ? ", a multiple of 0.1" : "");
    std::printf("| `%s` | %s | %s | %s | %s | %s | %s |\n", doc.path.c_str(), cell(takes).c_str(), doc.unit.c_str(),
                range, doc.fallback.empty() ? "" : ("`" + doc.fallback + "`").c_str(), doc.live ? "yes" : "",
                cell(doc.source).c_str());
  }
}

int validate(const ValidateArguments& arguments) {
  const auto scenario = load(arguments.scenario);
  if (!scenario) return report_errors(scenario.error());
  for (const std::string& warning : scenario::warnings(scenario.value())) process::log_warning(warning);
  for (const std::string& line : scenario::sensor_lines(scenario.value())) std::fprintf(stderr, "%s\n", line.c_str());
  if (arguments.fields) print_fields();
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
  verb->add_flag("--fields", arguments->fields, "print every field of a scenario: type, unit, range, default, source");
  return [arguments] { return validate(*arguments); };
}

}  // namespace lukou
