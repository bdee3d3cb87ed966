#include "services/lukou/launch/result_of_run.hpp"

#include <csignal>
#include <nlohmann/json.hpp>

#include "common/core/version.hpp"
#include "common/process/environment.hpp"
#include "common/process/log.hpp"
#include "common/results/inspection.hpp"
#include "common/results/json.hpp"
#include "common/results/result_folder.hpp"
#include "common/results/tables.hpp"
#include "common/scenario/scenario_steps.hpp"

namespace lukou::launch {
namespace {

/// What the manifest should say, from what the launcher saw.
std::string ended_by(const RunEnd& end) {
  if (end.io_failed) return "disk";
  if (end.culprit.empty()) return end.interrupted_by != 0 ? "interrupted" : "stopped";
  return (end.text.starts_with("has not finished") ? "stalled:" : "lost:") + end.culprit;
}

int exit_code(const RunEnd& end) {
  if (end.io_failed) return process::kExitIo;
  if (!end.culprit.empty()) return process::kExitAborted;
  if (end.interrupted_by != 0)
    return end.interrupted_by == SIGINT ? process::kExitInterrupted : process::kExitTerminated;
  return end.anomaly ? process::kExitAnomaly : process::kExitDone;
}

std::string for_people(const RunEnd& end, const results::Inspection& inspection) {
  // What the recorder logged may have found no room, either.
  if (end.io_failed) return "the record could not be written: " + (end.text.empty() ? "see operator.log" : end.text);
  if (!end.culprit.empty()) return "aborted: " + end.culprit + " " + end.text;
  if (end.interrupted_by != 0) return "interrupted";
  if (end.anomaly) return "ended by an anomaly: " + end.text;
  return inspection.manifest && inspection.manifest->ended_by == "stopped" ? "stopped by the operator" : "done";
}

}  // namespace

Expected<std::filesystem::path> create_result(const RunRequest& request) {
  auto folder = request.out.empty()
                    ? results::ResultFolder::create_new("result", process::wall_stamp(),
                                                        request.in_process ? "in-process" : request.pace)
                    : results::ResultFolder::create(request.out);
  if (!folder) return folder.error();
  if (auto done = folder.value().write_file("scenario.textproto", scenario::text(request.scenario)); !done) {
    return done.error();
  }
  return std::filesystem::absolute(folder.value().path());
}

RunReport finish_result(const RunRequest& request, const std::filesystem::path& folder, const RunEnd& end) {
  // A recorder that was killed left no manifest, one that was ended before the start not even tables.
  if (!std::filesystem::exists(folder / results::kManifest)) {
    static_cast<void>(results::RunTables::create(folder));
    const scenario::Protocol protocol = scenario::protocol(request.scenario);
    const results::Manifest facts{.lukou_version = std::string(version()),
                                  .scenario_hash = scenario::hash(request.scenario),
                                  .seed = protocol.seed,
                                  .steps_planned = protocol.end,
                                  .ended_by = ended_by(end),
                                  .culprit = end.text};
    if (auto done = results::repair(folder, facts); !done) process::log_error(done.error().text());
  }
  if (end.foreign_samples > 0) {
    process::log_warning(std::to_string(end.foreign_samples) +
                         " samples came from strangers on the bus and were ignored; operator.log names them");
  }
  const auto inspected = results::inspect(folder);
  const results::Inspection inspection = inspected ? inspected.value() : results::Inspection{};
  RunReport report;
  report.exit_code = exit_code(end);
  report.folder = folder;
  report.steps = inspection.complete_to_step;
  report.wall_s = end.wall_s;
  report.start_up_s = end.start_up_s;
  report.ended = for_people(end, inspection);
  const double steps_per_s = report.wall_s > 0.0 ? static_cast<double>(report.steps) / report.wall_s : 0.0;
  const nlohmann::ordered_json timing = {{"mode", request.in_process ? "in-process" : "processes"},
                                         {"pace", request.pace},
                                         {"steps", report.steps},
                                         {"wall_s", report.wall_s},
                                         {"steps_per_s", steps_per_s},
                                         {"real_time_factor", steps_per_s / static_cast<double>(kStepsPerSecond)},
                                         {"start_up_s", report.start_up_s},
                                         {"foreign_samples", end.foreign_samples}};
  if (auto done = results::write_file(folder / "timing.json", results::json_text(timing)); !done) {
    process::log_error(done.error().text());
  }
  return report;
}

}  // namespace lukou::launch
