#include <cstdio>
#include <filesystem>
#include <memory>

#include "common/lockstep/clock_core.hpp"
#include "common/process/environment.hpp"
#include "common/process/log.hpp"
#include "common/scenario/directive_log.hpp"
#include "common/scenario/scenario_steps.hpp"
#include "services/lukou/keys/key_folder.hpp"
#include "services/lukou/launch/console_process.hpp"
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
  std::string keys;  ///< folder of `lukou keys`; "" = an unsecured run
  std::vector<std::string> peers;
  std::vector<std::string> prefixes;  ///< "ROLE=COMMAND"
  int console = 0;                    ///< port; 0 = no console
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

/// Hosts and keys, checked. Says which keys expire soon.
Expected<launch::Reach> reach_of(const RunArguments& arguments, const scenario::Resolved& scenario,
                                 const RsuOptions& rsu_options) {
  const std::uint32_t rsus = scenario::protocol(scenario).rsus;
  launch::Reach reach{.peers = arguments.peers};
  auto prefixes = launch::prefixes(arguments.prefixes, rsus);
  if (!prefixes) return prefixes.error();
  reach.prefix_of = std::move(prefixes).value();
  for (std::uint32_t rsu = 0; rsu < rsus; ++rsu) {
    const auto own = rsu_options.of.find(rsu);
    const bool waits = (own == rsu_options.of.end() ? rsu_options.all : own->second) == "wait";
    if (waits && reach.prefix_of.contains(rsu_role(rsu))) {
      return Error{"--prefix " + rsu_role(rsu), "nobody starts this RSU: --rsu wait"};
    }
  }
  if (arguments.keys.empty()) return reach;
  reach.keys = std::filesystem::absolute(arguments.keys);
  const auto warnings = keys::check(reach.keys, rsus);
  if (!warnings) return warnings.error();
  for (const std::string& warning : warnings.value()) process::log_warning(warning);
  return reach;
}

/// One run as the arguments ask for it. `console`: shows it; may be null.
launch::RunReport run_once(const RunArguments& arguments, scenario::Resolved scenario, const RsuOptions& rsus,
                           const launch::Reach& reach, launch::ConsoleProcess* console) {
  const launch::RunRequest request{
      .scenario = std::move(scenario),
      .name = std::filesystem::path(arguments.scenario.scenario).stem().string(),
      .run_id = arguments.run_id,
      .in_process = arguments.mode == "in-process",
      .pace = arguments.pace,
      .out = arguments.out,
      .rsu = rsus.all,
      .rsu_of = rsus.of,
      .start_paused = arguments.wait,
      .watchdog = !arguments.no_watchdog,
      .stall_limit_s = arguments.stall_limit,
      .replay = arguments.replay.empty() ? "" : std::filesystem::absolute(arguments.replay),
      .observe = !arguments.quiet,
      .console = console,
      .reach = reach};
  report::Progress progress;
  const launch::Listener listener =
      arguments.quiet ? launch::Listener() : [&progress](const launch::RunNews& news) { progress.show(news); };
  launch::RunReport report =
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
  return report;
}

/// Keeps the last picture on show until nobody looks any more. Returns the seed if a viewer wants another run.
std::optional<std::uint64_t> linger(launch::ConsoleProcess& console) {
  constexpr double kAlone_s = 10.0;
  std::fprintf(stderr, "console: shows the end until nobody has looked for 10 s, or Ctrl-C\n");
  double looked_s = process::wall_s();
  while (process::stop_signal() == 0 && console.alive() && process::wall_s() - looked_s < kAlone_s) {
    process::sleep_s(0.05);
    console.poll();
    if (const auto seed = console.take_restart()) return seed;
    if (console.viewers() > 0) looked_s = process::wall_s();
  }
  return std::nullopt;
}

/// Runs under a console: again with another seed and a result folder of its own as often as a viewer asks.
int run_with_console(RunArguments arguments, scenario::Resolved scenario, const RsuOptions& rsus,
                     const launch::Reach& reach) {
  auto started = launch::ConsoleProcess::start(static_cast<std::uint16_t>(arguments.console),
                                               reach.environment(std::string(kObserverRole)));
  if (!started) return report_errors(started.error());
  launch::ConsoleProcess& console = started.value();
  const std::string out = arguments.out;
  for (int runs = 1;; ++runs) {
    const launch::RunReport report = run_once(arguments, scenario, rsus, reach, &console);
    auto seed = report.restart;
    if (!seed) seed = linger(console);
    if (!seed || process::stop_signal() != 0) {
      console.end();
      return report.exit_code;
    }
    arguments.scenario.seed = std::to_string(*seed);
    arguments.replay.clear();
    if (!out.empty()) arguments.out = out + "-" + std::to_string(runs + 1);
    auto again = load(arguments.scenario);
    if (!again) return report_errors(again.error());
    scenario = std::move(again).value();
  }
}

int run(RunArguments arguments) {
  const auto rsus = rsu_options("--rsu", arguments.rsus);
  if (!rsus) return report_errors(rsus.error());
  for (const auto& [rsu, command] : rsus.value().of) arguments.scenario.rsus_of_a_user.push_back(rsu);
  auto scenario = load(arguments.scenario);
  if (!scenario) return report_errors(scenario.error());
  if (const auto pace = pace_of(arguments.pace); !pace) return report_errors(pace.error());
  if (!arguments.replay.empty()) {
    if (auto fits = check_replay(arguments, scenario.value()); !fits) return report_errors(fits.error());
  }
  if (!arguments.quiet)
    for (const std::string& warning : scenario::warnings(scenario.value())) process::log_warning(warning);
  const bool alone = arguments.rsus.empty() && arguments.keys.empty() && arguments.peers.empty() &&
                     arguments.prefixes.empty() && !arguments.wait && arguments.console == 0;
  if (arguments.mode == "in-process" && !alone) {
    return report_errors({"--mode in-process",
                          "takes neither --rsu nor --wait, --console, --secure, --peers or --prefix: there are no "
                          "processes to talk to"});
  }
  const auto reach = reach_of(arguments, scenario.value(), rsus.value());
  if (!reach) return report_errors(reach.error());
  process::catch_stop_signals();
  if (arguments.console != 0) {
    return run_with_console(arguments, std::move(scenario).value(), rsus.value(), reach.value());
  }
  return run_once(arguments, std::move(scenario).value(), rsus.value(), reach.value(), nullptr).exit_code;
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
  verb->add_flag("--wait", arguments->wait,
                 "hold the run at step 0 until `lukou ctl RUN resume` or the console starts it");
  verb->add_flag("--console{8080}", arguments->console,
                 "show the run in a browser; --console=PORT listens there, or at the next port that is free")
      ->check(CLI::Range(1, 65535));
  verb->add_option("--secure", arguments->keys, "folder of `lukou keys init`: authenticated and encrypted")
      ->type_name("DIR");
  verb->add_option("--peers", arguments->peers, "addresses of the hosts of a run that is spread over several")
      ->delimiter(',')
      ->allow_extra_args(false);
  verb->add_option("--prefix", arguments->prefixes,
                   "start a role behind a command, as `ssh host` or `ip netns exec b`; may be repeated")
      ->type_size(1)
      ->allow_extra_args(false)
      ->type_name("ROLE=COMMAND");
  verb->add_flag("--no-watchdog", arguments->no_watchdog, "no deadlines: for a process under a debugger");
  verb->add_flag("--json", arguments->json, "one JSON object on standard output");
  verb->add_flag("--quiet", arguments->quiet, "no progress, no warnings");
  return [arguments] { return run(*arguments); };
}

}  // namespace lukou
