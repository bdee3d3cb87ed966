#include <memory>

#include "common/process/environment.hpp"
#include "services/lukou/report/why.hpp"
#include "services/lukou/scenario_arguments.hpp"
#include "services/lukou/verbs.hpp"

namespace lukou {
namespace {

int why(const report::WhyQuestion& question) {
  if (auto done = report::answer_why(question); !done) return report_errors(done.error());
  return process::kExitDone;
}

}  // namespace

Action add_why(CLI::App& app) {
  CLI::App* verb = app.add_subcommand("why", "why cars stopped, and what became of advice: totals, or every case");
  auto question = std::make_shared<report::WhyQuestion>();
  auto vehicle = std::make_shared<std::uint32_t>();
  verb->add_option("result", question->folder, "result folder")->required();
  CLI::Option* stops = verb->add_flag("--stops", question->list, "every stop with its cause, then the totals by cause");
  verb->add_flag("--guidance", question->guidance, "fates of advice instead; needs record.guidance")->excludes(stops);
  verb->add_option("--cause", question->cause, "only this cause, with --guidance only this fate");
  CLI::Option* number = verb->add_option("--vehicle", *vehicle, "only this vehicle");
  verb->add_flag("--json", question->json, "one JSON object on standard output");
  return [question, vehicle, number] {
    if (number->count() > 0) question->vehicle = *vehicle;
    return why(*question);
  };
}

}  // namespace lukou
