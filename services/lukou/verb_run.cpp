#include <cstdio>
#include <filesystem>
#include <memory>

#include "common/lockstep/clock_core.hpp"
#include "common/process/environment.hpp"
#include "common/process/log.hpp"
#include "common/scenario/directive_log.hpp"
#include "common/scenario/scenario_steps.hpp"
#include "services/lukou/launch/run_request.hpp"
#include "services/lukou/report/progress.hpp"
#include "services/lukou/report/summary_text.hpp"
#include "services/lukou/rsu_option.hpp"
#include "services/lukou/scenario_arguments.hpp"
#include "services/lukou/verbs.hpp"

namespace lukou {
namespace {

struct RunArguments {
  ScenarioArguments scenario;
  std::string mode = "processes";
  std::string pace = "max";
  std::string out;
  std::vector<std::string> rsus;  ///< "COMMAND" for all RSUs, or "N=COMMAND"
  std::string replay;
  std::string stall_limit;
  std::string run_id;
  bool wait = false;
  bool no_watchdog = false;
  bool json = false;
  bool quiet = false;
};

/// A session can be replayed if its changes fit the scenario and the mode can reproduce its losses.
Expected<Done> check_replay(const RunArguments& arguments, scenario::Resolved scenario) {
  const auto log = scenario::load_directives(arguments.replay);
  if (!log) return log.error();
  if (!log.value().hearings.empty() && arguments.mode != "in-process") {
    return Error{arguments.replay, "an RSU was lost in this session; only --mode in-process replays that"};
  }
  const auto measured = scenario::protocol(scenario).rsu_measured;
  for (const ComputingDelay& delay : log.value().computed) {
    if (delay.rsu < measured.size() && measured[delay.rsu]) continue;
    return Error{arguments.replay, "holds measured computing times of RSU " + std::to_string(delay.rsu) +
                                       "; replay it with --rsu-time real for that RSU"};
  }
  for (const Directive& directive : log.value().sets) {
    const auto changed = scenario::change(scenario, directive.set);
    if (!changed) return Error{arguments.replay + ": step " + std::to_string(directive.step), changed.error().text()};
  }
  return Done{};
}

int run(const RunArguments& arguments) {
  const auto rsus = rsu_options("--rsu", arguments.rsus);
  if (!rsus) return report_errors(rsus.error());
  ScenarioArguments asked = arguments.scenario;
  for (const auto& [rsu, command] : rsus.value().of) asked.rsus_of_a_user.push_back(rsu);
  auto scenario = load(asked);
  if (!scenario) return report_errors(scenario.error());
  if (const auto pace = pace_of(arguments.pace); !pace) return report_errors(pace.error());
  if (!arguments.replay.empty()) {
    if (auto fits = check_replay(arguments, scenario.value()); !fits) return report_errors(fits.error());
  }
  if (!arguments.quiet)
    for (const std::string& warning : scenario::warnings(scenario.value())) process::log_warning(warning);
  launch::RunRequest request{.scenario = std::move(scenario).value(),
                             .name = std::filesystem::path(arguments.scenario.scenario).stem().string(),
                             .run_id = arguments.run_id,
                             .in_process = arguments.mode == "in-process",
                             .pace = arguments.pace,
                             .out = arguments.out,
                             .rsu = rsus.value().all,
                             .rsu_of = rsus.value().of,
                             .start_paused = arguments.wait,
                             .watchdog = !arguments.no_watchdog,
                             .stall_limit_s = arguments.stall_limit,
                             .replay = arguments.replay.empty() ? "" : std::filesystem::absolute(arguments.replay),
                             .observe = !arguments.quiet};
  if (request.in_process && (!arguments.rsus.empty() || request.start_paused)) {
    return report_errors({"--mode in-process", "takes neither --rsu nor --wait: there are no processes to talk to"});
  }
  process::catch_stop_signals();
  report::Progress progress;
  const launch::Listener listener =
      arguments.quiet ? launch::Listener() : [&progress](const launch::RunNews& news) { progress.show(news); };
  const launch::RunReport report =
      request.in_process ? launch::run_in_process(request, listener) : launch::run_processes(request, listener);
  if (!arguments.quiet) progress.finish();
  if (arguments.json) {
    std::fputs(report::summary_json(report).c_str(), stdout);
  } else if (!report.folder.empty()) {
    std::fputs(report::summary_text(report).c_str(), stderr);
  }
  const bool failed = report.exit_code == process::kExitInternal || report.exit_code == process::kExitAborted ||
                      report.exit_code == process::kExitIo;
  if (failed && !report.folder.empty()) std::fputs(report::last_words(report).c_str(), stderr);
  return report.exit_code;
}

}  // namespace

Action add_run(CLI::App& app) {
  CLI::App* verb = app.add_subcommand("run", "run a scenario and write its results");
  auto arguments = std::make_shared<RunArguments>();
  add_scenario_arguments(*verb, arguments->scenario);
  verb->add_option("--mode", arguments->mode, "processes on the bus, or everything in this one")
      ->check(CLI::IsMember({"processes", "in-process"}))
      ->capture_default_str();
  verb->add_option("--pace", arguments->pace, "max, very-slow, slow, medium, fast, or simulated seconds per second")
      ->capture_default_str();
  verb->add_option("--out", arguments->out, "result folder: must not exist, or be empty [result/<time>-<pace>]");
  // One word each, as --set.
  verb->add_option("--rsu", arguments->rsus,
                   "command that is the RSU, or `wait`: started by hand; of all RSUs, or of RSU N; may be repeated")
      ->type_size(1)
      ->allow_extra_args(false)
      ->type_name("[N=]COMMAND");
  verb->add_option("--replay-directives", arguments->replay, "directives.textproto of an earlier run");
  verb->add_option("--stall-limit", arguments->stall_limit, "wall seconds without progress that abort the run [30]")
      ->check(CLI::PositiveNumber);
  verb->add_option("--run-id", arguments->run_id, "name of the run for `lukou ctl` [made from scenario and seed]")
      ->check([](const std::string& id) {
        const bool plain = !id.empty() && id.size() <= 40 &&
                           id.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-") ==
                               std::string::npos;
        return plain ? std::string() : "must be 1 to 40 letters, digits, `_` or `-`";
      });
  verb->add_flag("--wait", arguments->wait, "hold the run at step 0 until `lukou ctl RUN resume`");
  verb->add_flag("--no-watchdog", arguments->no_watchdog, "no deadlines: for a process under a debugger");
  verb->add_flag("--json", arguments->json, "one JSON object on standard output");
  verb->add_flag("--quiet", arguments->quiet, "no progress, no warnings");
  return [arguments] { return run(*arguments); };
}

}  // namespace lukou
