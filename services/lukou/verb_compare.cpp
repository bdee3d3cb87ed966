#include <algorithm>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "common/process/environment.hpp"
#include "common/scenario/wording.hpp"
#include "services/lukou/compare/comparison_text.hpp"
#include "services/lukou/scenario_arguments.hpp"
#include "services/lukou/study/measure.hpp"
#include "services/lukou/verbs.hpp"

namespace lukou {
namespace {

struct CompareArguments {
  std::string a;
  std::string b;
  std::vector<std::string> measures;  ///< empty: what A is about
  double confidence = 0.95;
  bool json = false;
};

Expected<Done> check_measures(const std::vector<std::string>& measures) {
  const std::vector<std::string> known = studies::known_measures();
  for (const std::string& measure : measures) {
    if (std::ranges::find(known, measure) != known.end()) continue;
    const auto meant = scenario::nearest(measure, known);
    return Error{"--measure " + measure, "is no number of summary.json" + (meant ? "; " + *meant + "?" : "")};
  }
  return Done{};
}

int compare_sides(const CompareArguments& arguments) {
  if (auto known = check_measures(arguments.measures); !known) return report_errors(known.error());
  auto a = compare::open_side(arguments.a);
  if (!a) return report_errors(a.error());
  auto b = compare::open_side(arguments.b);
  if (!b) return report_errors(b.error());
  const auto& measures = arguments.measures.empty() ? a.value().measures : arguments.measures;
  for (compare::Side* side : {&a.value(), &b.value()})
    if (auto read = compare::read_values(*side, measures); !read) return report_errors(read.error());
  const auto found = compare::compare(a.value(), b.value(), measures, arguments.confidence);
  if (!found) return report_errors(found.error());

  const int exit_code = found.value().differs() ? process::kExitInternal : process::kExitDone;
  if (arguments.json) {
    nlohmann::ordered_json json = {
        {"exit_code", exit_code}, {"a", a.value().name}, {"b", b.value().name}, {"confidence", arguments.confidence}};
    json.update(compare::json(found.value()));
    std::printf("%s\n", json.dump().c_str());
    return exit_code;
  }
  std::printf("A: %s\nB: %s\n\n%s", a.value().name.c_str(), b.value().name.c_str(),
              compare::text(found.value()).c_str());
  for (const std::string& warning : found.value().warnings) std::fprintf(stderr, "note: %s\n", warning.c_str());
  return exit_code;
}

}  // namespace

Action add_compare(CLI::App& app) {
  CLI::App* verb = app.add_subcommand(
      "compare", "two results, or two arms of studies: differences on the same arrivals, with confidence intervals");
  auto arguments = std::make_shared<CompareArguments>();
  verb->add_option("a", arguments->a, "result folder, folder of result folders (one a seed), or STUDY:ARM")->required();
  verb->add_option("b", arguments->b, "the same; differences are A less B")->required();
  verb->add_option("--measure", arguments->measures,
                   "a number of summary.json, as `equipped.mean_delay_s`; may be repeated [those of the study]")
      ->type_size(1)
      ->allow_extra_args(false);
  verb->add_option("--confidence", arguments->confidence, "of the intervals [0.95]")->check(CLI::Range(0.5, 0.9999));
  verb->add_flag("--json", arguments->json, "one JSON object on standard output");
  verb->footer("Exit code 0: no difference can be told; 1: some measure differs.");
  return [arguments] { return compare_sides(*arguments); };
}

}  // namespace lukou
