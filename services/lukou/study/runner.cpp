#include "services/lukou/study/runner.hpp"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <fstream>

#include "common/process/environment.hpp"
#include "common/results/result_folder.hpp"
#include "services/lukou/launch/child.hpp"
#include "services/lukou/launch/cores.hpp"

namespace lukou::studies {
namespace {

namespace fs = std::filesystem;

constexpr double kPoll_s = 0.01;
constexpr double kLookEvery_s = 1.0;  ///< for progress of a run
constexpr double kTellEvery_s = 0.2;
constexpr double kLeave_s = 5.0;  ///< after SIGTERM, until SIGKILL
constexpr int kAttemptsMax = 2;
constexpr int kUsageError = process::kExitUsage;

/// Bytes in a run's folder: they grow as long as the run does something.
std::uintmax_t bytes_in(const fs::path& folder) {
  std::uintmax_t bytes = 0;
  std::error_code code;
  for (const auto& entry : fs::recursive_directory_iterator(folder, code)) {
    if (entry.is_regular_file(code)) bytes += entry.file_size(code);
  }
  return bytes;
}

std::string host_name() {
  std::array<char, 256> name{};
  return gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "";
}

/// The last line of a log that says something.
std::string last_line(const fs::path& log) {
  std::ifstream stream(log);
  std::string last;
  for (std::string line; std::getline(stream, line);)
    if (!line.empty()) last = line;
  return last;
}

/// A run at work.
struct Job {
  RunKey run;
  int attempt = 1;
  double begun_s = 0.0;  ///< of the first attempt
  double moved_s = 0.0;  ///< when it last did something
  double looked_s = 0.0;
  std::uintmax_t bytes = 0;
  bool hung = false;
};

class Runner {
 public:
  Runner(const StudyFolder& folder, const std::vector<RunKey>& runs, const RunnerOptions& options,
         const SweepListener& listener)
      : folder_(folder), runs_(runs), listener_(listener), cores_(launch::usable_cores()), jobs_(options.jobs) {
    if (!options.pin) cores_.clear();
    news_.total = runs.size();
    begun_s_ = process::wall_s();
  }

  Expected<int> run() {
    slots_.resize(static_cast<std::size_t>(jobs_));
    while (next_ < runs_.size() || !children_.empty()) {
      if (const int signal = process::stop_signal(); signal != 0) return stop(signal);
      for (std::size_t slot = 0; slot < slots_.size() && next_ < runs_.size(); ++slot) {
        if (slots_[slot]) continue;
        const double now_s = process::wall_s();
        slots_[slot] = Job{.run = runs_[next_++], .begun_s = now_s};
        if (auto done = start(slot); !done) return done.error();
      }
      process::sleep_s(kPoll_s);
      for (const launch::ChildExit& ended : children_.reap())
        if (auto done = take(std::stoul(ended.role), ended); !done) return done.error();
      look_for_progress();
      tell(false);
    }
    tell(true);
    return 0;
  }

 private:
  Expected<Done> start(std::size_t slot) {
    Job& job = *slots_[slot];
    const auto first_log = job.attempt > 1 ? scenario::read_file(folder_.log(job.run)) : Expected<std::string>("");
    const auto scenario = folder_.prepare(job.run);
    if (!scenario) return scenario.error();
    if (job.attempt > 1 && first_log) {
      const fs::path kept = folder_.run(job.run) / "log-of-first-attempt.txt";
      if (auto done = results::write_file(kept, first_log.value()); !done) return done;
    }
    job.moved_s = job.looked_s = process::wall_s();
    job.bytes = 0;
    job.hung = false;
    launch::ChildSpec spec{.role = std::to_string(slot),
                           .command = {fs::read_symlink("/proc/self/exe").string(), "run", scenario.value().string(),
                                       "--quiet", "--out", folder_.result(job.run).string()},
                           .log = folder_.log(job.run)};
    if (!folder_.study().processes) spec.command.insert(spec.command.end(), {"--mode", "in-process"});
    if (!cores_.empty()) spec.core = cores_[slot % cores_.size()];
    return children_.start(spec);
  }

  /// What became of a child: the run is over, or is tried again.
  Expected<Done> take(std::size_t slot, const launch::ChildExit& ended) {
    constexpr int kSignalled = 128;
    Job& job = *slots_[slot];
    RunMarker marker{.exit_code = ended.signalled ? kSignalled + ended.code : ended.code,
                     .attempts = job.attempt,
                     .wall_s = process::wall_s() - job.begun_s,
                     .host = host_name(),
                     .what = {}};
    if (marker.failed() && marker.exit_code != kUsageError && job.attempt < kAttemptsMax) {
      ++job.attempt;
      return start(slot);
    }
    if (marker.failed()) {
      marker.what = job.hung ? "wrote nothing for " + std::to_string(static_cast<int>(folder_.study().stall_limit_s)) +
                                   " s and was killed"
                             : ended.text();
      if (const std::string said = last_line(folder_.log(job.run)); !said.empty()) marker.what += ": " + said;
      ++news_.failed;
    } else if (auto reduced = folder_.reduce(job.run); !reduced) {
      return reduced;
    }
    if (marker.exit_code == process::kExitAnomaly) ++news_.anomalies;
    ++news_.done;
    const RunKey run = job.run;
    slots_[slot].reset();
    return folder_.mark(run, marker);
  }

  /// Kills runs that have not moved for too long.
  void look_for_progress() {
    const double now_s = process::wall_s();
    for (std::size_t slot = 0; slot < slots_.size(); ++slot) {
      if (!slots_[slot] || now_s - slots_[slot]->looked_s < kLookEvery_s) continue;
      Job& job = *slots_[slot];
      job.looked_s = now_s;
      const std::uintmax_t bytes = bytes_in(folder_.run(job.run));
      if (bytes != job.bytes) job.moved_s = now_s;
      job.bytes = bytes;
      if (now_s - job.moved_s < folder_.study().stall_limit_s) continue;
      job.hung = true;
      children_.signal(std::to_string(slot), SIGKILL);
    }
  }

  int stop(int signal) {
    children_.signal_all(SIGTERM);
    for (double waited_s = 0.0; !children_.empty() && waited_s < kLeave_s; waited_s += kPoll_s) {
      process::sleep_s(kPoll_s);
      children_.reap();
    }
    tell(true);
    return signal;  // whoever is left is killed with `children_`
  }

  void tell(bool last) {
    const double now_s = process::wall_s();
    if (!listener_ || (!last && now_s - told_s_ < kTellEvery_s)) return;
    told_s_ = now_s;
    news_.wall_s = now_s - begun_s_;
    if (news_.done > 0) {
      news_.left_s = news_.wall_s / static_cast<double>(news_.done) * static_cast<double>(news_.total - news_.done);
    }
    listener_(news_);
  }

  const StudyFolder& folder_;
  const std::vector<RunKey>& runs_;
  const SweepListener& listener_;
  std::vector<int> cores_;
  int jobs_;
  SweepNews news_;
  double begun_s_ = 0.0;
  double told_s_ = 0.0;
  std::size_t next_ = 0;
  std::vector<std::optional<Job>> slots_;
  launch::Children children_;
};

}  // namespace

Expected<int> run_all(const StudyFolder& folder, const std::vector<RunKey>& runs, const RunnerOptions& options,
                      const SweepListener& listener) {
  return Runner(folder, runs, options, listener).run();
}

}  // namespace lukou::studies
