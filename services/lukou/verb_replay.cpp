#include <cctype>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>

#include "common/process/environment.hpp"
#include "common/process/log.hpp"
#include "common/run_log/run_log.hpp"
#include "services/lukou/launch/console_process.hpp"
#include "services/lukou/launch/domain_claim.hpp"
#include "services/lukou/replay/again.hpp"
#include "services/lukou/replay/replay_on_bus.hpp"
#include "services/lukou/scenario_arguments.hpp"
#include "services/lukou/verbs.hpp"

namespace lukou {
namespace {

namespace fs = std::filesystem;

struct ReplayArguments {
  std::string result;
  int console = 0;  ///< port; 0 = no console
  bool recompute = false;
};

/// "replay-20261122-093015-max", as `lukou ctl list` names it.
std::string run_name(const fs::path& folder) {
  std::string name = fs::weakly_canonical(folder).filename().string();
  std::erase_if(name, [](unsigned char c) { return std::isalnum(c) == 0 && c != '_' && c != '-'; });
  return ("replay-" + name).substr(0, 40);
}

int show_again(const ReplayArguments& arguments) {
  process::catch_stop_signals();
  std::optional<replay::ComputedAgain> again;
  fs::path folder = arguments.result;
  std::error_code code;
  if (!fs::is_directory(folder, code)) return report_errors({arguments.result, "is no result folder"});
  if (arguments.recompute) {
    auto computed = replay::ComputedAgain::compute(folder);
    if (!computed) {
      report_errors(computed.error());
      return process::kExitInternal;
    }
    again.emplace(std::move(computed).value());
    folder = again->folder();
  }
  auto recording = replay::Recording::open(folder);
  if (!recording) {
    report_errors(recording.error());
    std::fprintf(stderr, "`lukou replay %s --recompute` computes the run again, bit by bit, and replays that\n",
                 arguments.result.c_str());
    return process::kExitUsage;
  }
  const std::string run = run_name(arguments.result);
  auto claim = launch::DomainClaim::lowest_free({.run = run});
  if (!claim) {
    report_errors(claim.error());
    return process::kExitAborted;
  }
  std::optional<launch::ConsoleProcess> console;
  if (arguments.console != 0) {
    auto started = launch::ConsoleProcess::start(static_cast<std::uint16_t>(arguments.console), {});
    if (!started) return report_errors(started.error());
    console.emplace(std::move(started).value());
  } else {
    std::fprintf(stderr, "replays as %s until Ctrl-C; look at it with `lukou-console --attach %s`\n", run.c_str(),
                 run.c_str());
  }
  const auto done = replay::replay_on_bus(std::move(recording).value(), {.domain = claim.value().domain(), .run = run},
                                          console ? &*console : nullptr);
  if (console) console->end();
  if (done) return process::kExitDone;
  report_errors(done.error());
  return process::kExitIo;
}

}  // namespace

Action add_replay(CLI::App& app) {
  CLI::App* verb = app.add_subcommand("replay", "show a recorded run again, from its run.mcap");
  auto arguments = std::make_shared<ReplayArguments>();
  verb->add_option("result", arguments->result, "result folder of a run with record.log=FULL")->required();
  verb->add_flag("--console{8080}", arguments->console,
                 "show it in a browser; --console=PORT listens there, or at the next port that is free")
      ->check(CLI::Range(1, 65535));
  verb->add_flag("--recompute", arguments->recompute,
                 "compute the run again with its whole log, make sure that it is the same, and replay that");
  return [arguments] { return show_again(*arguments); };
}

}  // namespace lukou
