// Speed and memory of the paper's scenario (1800 veh/h on every approach, equipped ratio 0.5, `arrive_on_green`, four
// tables): as processes on the bus, which share one core, open and secured, and in one process; and of the traffic
// engine alone. Measured in turns, so that a disturbance of the machine meets all of them. Prints measured beside
// floor.
//   run_speed [--enforce] [--repeats N] [--duration S]      exit code 1 below a floor only with --enforce

#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <vector>

#include "tests/benchmark/figures.hpp"
#include "tests/benchmark/plain_run.hpp"
#include "tests/benchmark/product_run.hpp"

namespace {

using namespace lukou::test;
using lukou::Step;

constexpr double kFloorProcesses = 4000.0;   // steps/s
constexpr double kFloorInProcess = 12000.0;  // steps/s
constexpr double kFloorUpdates = 12e6;       // vehicle updates/s
constexpr double kCeilingMemory_kb = 40e3;
constexpr std::size_t kProcesses = 5;  // clock, traffic engine, signal controller, RSU, recorder

using Peaks = std::map<std::string, double>;  // by program, kB

struct Timed {
  double steps_per_s = 0.0;
  double start_up_s = 0.0;
};

/// A run from its start to its end; notes the peak memory of its processes. `keys`: secured by them; "" = open.
Timed timed_run(const std::string& mode, double duration_s, Peaks& peaks, const std::string& keys = "") {
  const TemporaryFolder folder;
  const std::string run = fresh_run_id();
  auto arguments = paper_arguments(mode, 1800.0, 0.5, duration_s, 1);
  arguments.insert(arguments.end(), {"--out", folder / "result", "--run-id", run});
  if (!keys.empty()) arguments.insert(arguments.end(), {"--secure", keys});
  Program program(arguments);
  const bool alone = mode == "in-process";
  std::map<std::string, pid_t> processes;
  while (program.running()) {
    // Looking up the processes costs more than reading their memory: only until all are there.
    if (!alone && processes.size() < kProcesses) processes = processes_of(run);
    for (const auto& [name, process] : processes) peaks[name] = std::max(peaks[name], memory_kb(process, "VmHWM"));
    const std::string name = alone ? "lukou (in-process)" : "lukou (launcher)";
    peaks[name] = std::max(peaks[name], memory_kb(program.pid(), "VmHWM"));
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  const nlohmann::json timing = report_of(program, program.wait())["timing"];
  return {timing["steps_per_s"].get<double>(), timing["start_up_s"].get<double>()};
}

/// Vehicle updates per second of the engine alone, one thread, 1800 veh/h, with noise, three hours.
double updates_per_s() {
  using namespace lukou;
  constexpr Step kCycle = 900;
  traffic::Engine engine(plain_parameters(1800.0, 1));
  const SignalPlan plan = paper_plan();
  std::array<Heads, kCycle> cycle{};
  for (Step k = 0; k < kCycle; ++k)
    for (int i = 0; i < kLanes; ++i) cycle[static_cast<std::size_t>(k)][index(Lane(i))] = aspect_at(plan, Lane(i), k);
  double updates = 0.0;
  const auto start = std::chrono::steady_clock::now();
  for (Step k = 0; k <= 108000; ++k) {
    engine.step(k, cycle[static_cast<std::size_t>((k + kCycle - 1) % kCycle)], {});
    for (int i = 0; i < kLanes; ++i) updates += static_cast<double>(engine.lane(Lane(i)).cars().size());
  }
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
  return updates / took.count();
}

/// The processor's name, how many there are, and how busy they were; a figure means little without it.
void print_machine() {
  std::ifstream processors("/proc/cpuinfo");
  std::string name = "unknown processor";
  for (std::string line; std::getline(processors, line);)
    if (line.rfind("model name", 0) == 0) name = line.substr(line.find(':') + 2);
  std::array<double, 1> load{};
  if (getloadavg(load.data(), 1) != 1) load[0] = -1.0;
  std::printf("%s, %u cores, load at the start %.2f\n", name.c_str(), std::thread::hardware_concurrency(), load[0]);
}

class Floors {
 public:
  void at_least(const std::string& what, const Spread& measured, double floor) {
    const bool met = measured.median >= floor;
    all_met_ = all_met_ && met;
    std::printf("%-38s %12.0f [%.0f - %.0f]   floor %.0f  %s\n", what.c_str(), measured.median, measured.least,
                measured.most, floor, met ? "ok" : "BELOW");
  }
  void at_most(const std::string& what, double measured, double ceiling) {
    const bool met = measured <= ceiling;
    all_met_ = all_met_ && met;
    std::printf("%-38s %12.0f   at most %.0f  %s\n", what.c_str(), measured, ceiling, met ? "ok" : "ABOVE");
  }
  [[nodiscard]] bool all_met() const { return all_met_; }

 private:
  bool all_met_ = true;
};

}  // namespace

int main(int argc, char** argv) {
  const int repeats = static_cast<int>(number_argument(argc, argv, "repeats", 3.0));
  const double duration_s = number_argument(argc, argv, "duration", 3600.0);
  if (repeats < 1 || duration_s <= 0.0) {
    std::fprintf(stderr, "--repeats and --duration: need more than 0\n");
    return 2;
  }
  print_machine();
  Peaks peaks;
  std::vector<double> processes;
  std::vector<double> alone;
  std::vector<double> updates;
  std::vector<double> start_up_s;
  std::vector<double> secured;
  std::vector<double> secured_start_up_s;
  const TemporaryFolder folder;
  const std::string keys = folder / "keys";
  if (lukou::test::lukou({"keys", "init", keys}).code != 0) return 1;
  for (int i = 0; i < repeats; ++i) {
    const Timed on_bus = timed_run("processes", duration_s, peaks);
    processes.push_back(on_bus.steps_per_s);
    start_up_s.push_back(on_bus.start_up_s);
    Peaks of_secured;
    const Timed behind_keys = timed_run("processes", duration_s, of_secured, keys);
    secured.push_back(behind_keys.steps_per_s);
    secured_start_up_s.push_back(behind_keys.start_up_s);
    alone.push_back(timed_run("in-process", duration_s, peaks).steps_per_s);
    updates.push_back(updates_per_s());
  }
  std::printf("median [least - most] of %d\n", repeats);
  Floors floors;
  floors.at_least("processes on one core, steps/s", spread(processes), kFloorProcesses);
  floors.at_least("in-process, steps/s", spread(alone), kFloorInProcess);
  floors.at_least("engine alone, vehicle updates/s", spread(updates), kFloorUpdates);
  for (const auto& [name, kb] : peaks) floors.at_most("peak memory of " + name + ", kB", kb, kCeilingMemory_kb);
  std::printf("in-process against processes: %.2f times as fast\n", spread(alone).median / spread(processes).median);
  std::printf("start-up of the processes: %.2f s\n", spread(start_up_s).median);
  const Spread behind_keys = spread(secured);
  std::printf("secured processes, steps/s: %.0f [%.0f - %.0f], %.2f of the speed of open ones; start-up %.2f s\n",
              behind_keys.median, behind_keys.least, behind_keys.most, behind_keys.median / spread(processes).median,
              spread(secured_start_up_s).median);
  std::printf(floors.all_met() ? "all floors met\n" : "some floor is NOT met\n");
  return floors.all_met() || !flag_argument(argc, argv, "enforce") ? 0 : 1;
}
