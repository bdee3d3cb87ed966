#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "common/process/environment.hpp"
#include "common/run_log/run_log.hpp"
#include "services/lukou/report/car_story.hpp"
#include "services/lukou/report/why.hpp"
#include "services/lukou/scenario_arguments.hpp"
#include "services/lukou/verbs.hpp"

namespace lukou {
namespace {

/// The life of one car, in the order of time.
int tell(const report::WhyQuestion& question) {
  const auto story = report::car_story(question.folder, *question.vehicle);
  if (!story) return report_errors(story.error());
  nlohmann::ordered_json json = {{"vehicle", *question.vehicle}, {"story", nlohmann::ordered_json::array()}};
  for (const report::StoryLine& line : story.value()) {
    if (question.json) {
      json["story"].push_back(
          {{"from_s", time_s(line.from)}, {"to_s", time_s(line.to)}, {"kind", line.kind}, {"text", line.text}});
    } else if (line.from == line.to) {
      std::printf("%8.1f            s  %-8s %s\n", time_s(line.from), line.kind.c_str(), line.text.c_str());
    } else {
      std::printf("%8.1f - %8.1f s  %-8s %s\n", time_s(line.from), time_s(line.to), line.kind.c_str(),
                  line.text.c_str());
    }
  }
  if (question.json) std::printf("%s\n", json.dump().c_str());
  return process::kExitDone;
}

int why(const report::WhyQuestion& question, bool story) {
  if (story && std::filesystem::exists(question.folder / run_log::kRunLog)) return tell(question);
  if (auto done = report::answer_why(question); !done) return report_errors(done.error());
  return process::kExitDone;
}

}  // namespace

Action add_why(CLI::App& app) {
  CLI::App* verb = app.add_subcommand(
      "why", "why cars stopped, and what became of advice: totals, or every case; or the life of a car");
  auto question = std::make_shared<report::WhyQuestion>();
  auto vehicle = std::make_shared<std::uint32_t>();
  verb->add_option("result", question->folder, "result folder")->required();
  CLI::Option* stops = verb->add_flag("--stops", question->list, "every stop with its cause, then the totals by cause");
  CLI::Option* guidance =
      verb->add_flag("--guidance", question->guidance, "fates of advice instead; needs record.guidance")
          ->excludes(stops);
  CLI::Option* cause = verb->add_option("--cause", question->cause, "only this cause, with --guidance only this fate");
  CLI::Option* number = verb->add_option(
      "--vehicle", *vehicle,
      "only this vehicle; with a run.mcap, and without the options above, all that it did, sent and was told");
  verb->add_flag("--json", question->json, "one JSON object on standard output");
  return [question, vehicle, number, stops, guidance, cause] {
    if (number->count() > 0) question->vehicle = *vehicle;
    const bool story = question->vehicle && stops->count() + guidance->count() + cause->count() == 0;
    return why(*question, story);
  };
}

}  // namespace lukou
