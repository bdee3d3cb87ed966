#include "tests/benchmark/speed_runs.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <future>
#include <nlohmann/json.hpp>
#include <optional>
#include <thread>
#include <utility>

#include "common/core/step.hpp"
#include "tests/benchmark/plain_run.hpp"
#include "tests/benchmark/product_run.hpp"

namespace lukou::test {
namespace {

constexpr std::size_t kProcesses = 5;  // clock, traffic engine, signal controller, RSU, recorder
constexpr auto kPoll = std::chrono::milliseconds(50);
constexpr double kSettled = 0.1;  // of the wall time; memory grows before that

/// Memory of the processes of a run while it lasts.
class Memory {
 public:
  explicit Memory(std::string run) : run_(std::move(run)) {}

  void look(pid_t launcher, bool alone) {
    // Looking up the processes costs more than reading their memory: only until all are there.
    if (!alone && processes_.size() < kProcesses) processes_ = processes_of(run_);
    for (const auto& [name, process] : processes_) note(name, process);
    note(alone ? "lukou (in-process)" : "lukou (launcher)", launcher);
  }
  [[nodiscard]] const Peaks& peaks() const { return peaks_; }
  [[nodiscard]] double growth_kb() const {
    double most = 0.0;
    for (const auto& [name, course] : courses_) {
      const auto settled = static_cast<std::size_t>(kSettled * static_cast<double>(course.size()));
      most = std::max(most, course.back() - course[settled]);
    }
    return most;
  }

 private:
  void note(const std::string& name, pid_t process) {
    peaks_[name] = std::max(peaks_[name], memory_kb(process, "VmHWM"));
    if (const double now_kb = memory_kb(process, "VmRSS"); now_kb > 0.0) courses_[name].push_back(now_kb);
  }

  std::string run_;
  std::map<std::string, pid_t> processes_;
  Peaks peaks_;
  std::map<std::string, std::vector<double>> courses_;
};

}  // namespace

std::vector<std::string> speed_arguments(const std::string& mode, double duration_s,
                                         const std::vector<std::string>& more, double flow_veh_per_h) {
  auto arguments = paper_arguments(mode, flow_veh_per_h, 0.5, duration_s, 1);
  arguments.insert(arguments.end(), {"--set", "run.warmup_s=0"});
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

Timed timed_run(const std::vector<std::string>& arguments, int core) {
  const TemporaryFolder folder;
  const std::string run = fresh_run_id();
  std::vector<std::string> words = {"-c", std::to_string(core), LUKOU_PROGRAM};
  words.insert(words.end(), arguments.begin(), arguments.end());
  words.insert(words.end(), {"--out", folder / "result", "--run-id", run});
  const bool alone = std::find(arguments.begin(), arguments.end(), "in-process") != arguments.end();
  Program program(words, {}, "/usr/bin/taskset");
  Memory memory(run);
  while (program.running()) {
    memory.look(program.pid(), alone);
    std::this_thread::sleep_for(kPoll);
  }
  const nlohmann::json report = report_of(program, program.wait());
  const nlohmann::json& timing = report["timing"];
  const nlohmann::json& summary = report["summary"];
  return {.steps_per_s = timing["steps_per_s"].get<double>(),
          .start_up_s = timing["start_up_s"].get<double>(),
          .mean_vehicles = summary["safety"]["driven_s"].get<double>() / summary["simulated_s"].get<double>(),
          .vehicles_left = summary["vehicles_left"].get<double>(),
          .advice_per_step = summary["advice_sent"].get<double>() / timing["steps"].get<double>(),
          .memory_growth_kb = memory.growth_kb(),
          .peaks = memory.peaks()};
}

double two_runs_steps_per_s(const std::vector<std::string>& arguments, int core, int other_core) {
  auto other = std::async(std::launch::async, timed_run, arguments, other_core);
  const double one = timed_run(arguments, core).steps_per_s;
  return one + other.get().steps_per_s;
}

double engine_updates_per_s(double duration_s) {
  constexpr Step kCycle = 900;
  traffic::Engine engine(plain_parameters(1800.0, 1));
  const SignalPlan plan = paper_plan();
  std::array<Heads, kCycle> cycle{};
  for (Step k = 0; k < kCycle; ++k)
    for (int i = 0; i < kLanes; ++i) cycle[static_cast<std::size_t>(k)][index(Lane(i))] = aspect_at(plan, Lane(i), k);
  double updates = 0.0;
  const auto start = std::chrono::steady_clock::now();
  for (Step k = 0; k <= step_at_or_after(duration_s); ++k) {
    engine.step(k, cycle[static_cast<std::size_t>((k + kCycle - 1) % kCycle)], {});
    for (int i = 0; i < kLanes; ++i) updates += static_cast<double>(engine.lane(Lane(i)).cars().size());
  }
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
  return updates / took.count();
}

}  // namespace lukou::test
