#include <sched.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <thread>

#include "common/core/hash.hpp"
#include "common/core/keyed_random.hpp"
#include "common/process/environment.hpp"
#include "common/process/run_client.hpp"
#include "common/process/run_list.hpp"
#include "common/results/inspection.hpp"
#include "common/results/result_folder.hpp"
#include "common/scenario/scenario_steps.hpp"
#include "services/lukou/launch/child.hpp"
#include "services/lukou/launch/domain_claim.hpp"
#include "services/lukou/scenario_arguments.hpp"
#include "services/lukou/verbs.hpp"

namespace lukou {
namespace {

namespace fs = std::filesystem;

/// One way to compute the run.
struct Way {
  std::string name;                    ///< for people
  std::vector<std::string> arguments;  ///< of `lukou run`
  int instances = 1;
  bool spinners = false;  ///< every core kept busy meanwhile
  bool pauses = false;    ///< paused at random moments
  int observers = 0;      ///< observers that come, look and go
};

std::vector<Way> ways() {
  return {{.name = "in-process", .arguments = {"--mode", "in-process"}},
          {.name = "processes, full speed"},
          {.name = "processes, 100x with pauses", .arguments = {"--pace", "100"}, .pauses = true},
          {.name = "two instances at once", .instances = 2},
          {.name = "all cores kept busy", .spinners = true},
          {.name = "with three observers", .observers = 3}};
}

/// Every result file of a folder with its content's hash, one line each; "" if the folder is not sound.
std::string fingerprint(const fs::path& folder) {
  const auto inspection = results::inspect(folder);
  if (!inspection || !inspection.value().sound()) return "";
  const auto files = results::result_files(folder);
  if (!files) return "";
  std::string text;
  for (const auto& file : files.value()) text += file.name + " " + file.sha256 + "\n";
  return text;
}

/// Waits until the run is listed; nothing if it ended before.
std::optional<bus::Address> address_of(const std::string& run, const std::atomic<bool>& over) {
  while (!over) {
    for (const process::ListedRun& listed : process::list_runs())
      if (listed.run == run) return bus::Address{.domain = listed.domain, .run = run};
    process::sleep_s(0.01);
  }
  return std::nullopt;
}

/// Pauses and resumes a run again and again until it is over.
void disturb(const std::string& run, const std::atomic<bool>& over) {
  const auto address = address_of(run, over);
  if (!address) return;
  auto client = process::RunClient::attach(*address, false);
  if (!client) return;
  const DrawKey key{.run_seed = process::new_incarnation(), .purpose = Purpose::kTest};
  for (std::uint64_t i = 0; !over; ++i) {
    const double run_s = 0.3 + 2.0 * uniform01({key.run_seed, key.purpose, 0, i});
    const double hold_s = 0.05 + 0.2 * uniform01({key.run_seed, key.purpose, 1, i});
    for (double slept_s = 0.0; slept_s < run_s && !over; slept_s += 0.05) process::sleep_s(0.05);
    static_cast<void>(client.value()->request("pause", 1.0));
    process::sleep_s(hold_s);
    static_cast<void>(client.value()->request("resume", 1.0));
  }
}

/// Attaches, looks for a while, leaves, and comes again.
void observe(const std::string& run, const std::atomic<bool>& over) {
  const auto address = address_of(run, over);
  while (address && !over) {
    auto client = process::RunClient::attach(*address, true);
    if (!client) return;
    for (int i = 0; i < 10 && !over; ++i) client.value()->poll(0.1);
  }
}

class Verification {
 public:
  Verification(fs::path folder, fs::path scenario) : folder_(std::move(folder)), scenario_(std::move(scenario)) {}

  /// Returns false if this way's bytes are not those of the first.
  bool check(const Way& way, int number) {
    const double begin_s = process::wall_s();
    const auto folders = compute(way, number);
    bool same = true;
    for (const fs::path& folder : folders) {
      const std::string found = fingerprint(folder);
      if (reference_.empty()) reference_ = found;
      same = same && !found.empty() && found == reference_;
    }
    std::printf("%-5s %-30s %6.1f s  %s\n", same ? "same" : "DIFF", way.name.c_str(), process::wall_s() - begin_s,
                sha256_hex(fingerprint(folders.back())).substr(0, 16).c_str());
    std::fflush(stdout);
    if (!same) {
      for (const fs::path& folder : folders) std::printf("      look at %s\n", folder.c_str());
    }
    return same;
  }

 private:
  std::vector<fs::path> compute(const Way& way, int number) {
    launch::Children spinners;
    launch::Children runs;
    cpu_set_t ours;
    sched_getaffinity(0, sizeof ours, &ours);
    for (int core = 0; way.spinners && core < CPU_SETSIZE; ++core) {
      if (!CPU_ISSET(static_cast<unsigned>(core), &ours)) continue;
      static_cast<void>(
          spinners.start({.role = "spinner", .command = {"/bin/sh", "-c", "while :; do :; done"}, .core = core}));
    }
    std::atomic<bool> over = false;
    std::vector<std::jthread> others;
    std::vector<fs::path> folders;
    const std::string self = fs::read_symlink("/proc/self/exe").string();
    for (int i = 0; i < way.instances; ++i) {
      const std::string run =
          "verify-" + std::to_string(getpid()) + "-" + std::to_string(number) + "-" + std::to_string(i);
      folders.push_back(folder_ / (std::to_string(number) + "-" + std::to_string(i)));
      launch::ChildSpec spec{
          .role = run,
          .command = {self, "run", scenario_.string(), "--quiet", "--run-id", run, "--out", folders.back().string()}};
      spec.command.insert(spec.command.end(), way.arguments.begin(), way.arguments.end());
      spec.log = folder_ / "output.txt";
      static_cast<void>(runs.start(spec));
      if (way.pauses) others.emplace_back([run, &over] { disturb(run, over); });
      for (int n = 0; n < way.observers; ++n) others.emplace_back([run, &over] { observe(run, over); });
    }
    while (!runs.empty()) {
      runs.reap();
      if (process::stop_signal() != 0) runs.signal_all(SIGTERM);
      process::sleep_s(0.02);
    }
    over = true;
    spinners.signal_all(SIGKILL);
    return folders;
  }

  fs::path folder_;
  fs::path scenario_;
  std::string reference_;
};

struct VerifyArguments {
  ScenarioArguments scenario;
  bool keep = false;
};

int verify(const VerifyArguments& arguments) {
  const auto scenario = load(arguments.scenario);
  if (!scenario) return report_errors(scenario.error());
  if (scenario::protocol(scenario.value()).measures_time()) {
    return report_errors(
        {"rsus[].computing.mode",
         "is REAL: results depend on how fast this computer is, so two runs differ; verify with FREE or "
         "DECLARED (--rsu-time declared:20ms), or replay a run with --replay-directives"});
  }
  std::string pattern = (fs::temp_directory_path() / "lukou-verify-XXXXXX").string();
  if (mkdtemp(pattern.data()) == nullptr) return report_errors({pattern, "cannot be made"});
  const fs::path folder = pattern;
  const fs::path resolved = folder / "scenario.textproto";
  if (auto done = results::write_file(resolved, scenario::text(scenario.value())); !done) {
    std::fprintf(stderr, "%s\n", done.error().text().c_str());
    return process::kExitIo;
  }
  process::catch_stop_signals();
  Verification verification(folder, resolved);
  bool same = true;
  int number = 0;
  for (const Way& way : ways()) {
    if (process::stop_signal() != 0) return process::kExitInterrupted;
    same = verification.check(way, number++) && same;
  }
  std::printf("%s\n", same ? "every way gave the same bytes" : "the bytes depend on how they were computed");
  if (same && !arguments.keep) fs::remove_all(folder);
  return same ? process::kExitDone : process::kExitInternal;
}

}  // namespace

Action add_verify(CLI::App& app) {
  CLI::App* verb =
      app.add_subcommand("verify", "run a scenario in every way and compare all result files byte for byte");
  auto arguments = std::make_shared<VerifyArguments>();
  add_scenario_arguments(*verb, arguments->scenario);
  verb->add_flag("--keep", arguments->keep, "keep the results");
  return [arguments] { return verify(*arguments); };
}

}  // namespace lukou
