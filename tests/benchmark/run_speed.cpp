// Speed and memory of the paper's scenario (1800 veh/h on every approach, equipped ratio 0.5, `arrive_on_green`, four
// tables), beside floors, goals and SUMO. All figures of one turn are measured one after the other, and turns repeat,
// so that a disturbance of the machine meets all of them; ratios are of figures of one turn.
//   run_speed [--repeats N] [--duration S] [--long S] [--enforce]
// --duration: simulated time of a run. --long: of the run whose memory has to stay flat; 0 leaves it out.
// Exit code 1 below a floor only with --enforce. Progress goes to standard error.

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

#include "services/lukou/launch/cores.hpp"
#include "tests/benchmark/figures.hpp"
#include "tests/benchmark/speed_runs.hpp"
#include "tests/benchmark/speed_table.hpp"
#include "tests/benchmark/sumo_runs.hpp"

namespace {

using namespace lukou::test;
using Values = std::vector<double>;

/// The processor's name, how many there are, how busy they were, and the peer; a figure means little without it.
void print_machine(double duration_s) {
  std::ifstream processors("/proc/cpuinfo");
  std::string name = "unknown processor";
  for (std::string line; std::getline(processors, line);)
    if (line.rfind("model name", 0) == 0) name = line.substr(line.find(':') + 2);
  std::array<double, 1> load{};
  if (getloadavg(load.data(), 1) != 1) load[0] = -1.0;
  std::printf("%s, %zu cores, load at the start %.2f; runs of %.0f s simulated\n", name.c_str(),
              lukou::launch::usable_cores().size(), load[0], duration_s);
}

/// What is measured in turns.
struct Measured {
  Values processes, start_up_ms, memory_mb;
  Values in_process, updates_m;
  Values two_instances, secured, pc5, python;
  Values traci, against_traci, libsumo, against_libsumo, against_sumo_alone, left_apart;
  Values commands, peer_commands;
  std::string largest;  ///< the process that needed most memory
};

class Turns {
 public:
  explicit Turns(double duration_s) : duration_s_(duration_s) {
    const std::string make =
        "cd " + (folder_ / "").string() + " && $0 keys init keys && $0 new rsu python_rsu --lang python";
    Program made({"-c", make, LUKOU_PROGRAM}, {}, "/bin/sh");
    if (made.wait() != 0) {
      std::fprintf(stderr, "run_speed: cannot make keys and a Python RSU\n%s", made.err().c_str());
      std::exit(1);
    }
    missing_peer_ = SumoPeer::missing();
    if (missing_peer_.empty()) peer_.emplace(duration_s);
  }

  void turn() {
    const Timed open = run_on_bus("processes", {});
    m_.processes.push_back(open.steps_per_s);
    m_.start_up_ms.push_back(1000.0 * open.start_up_s);
    m_.commands.push_back(open.advice_per_step);
    note_memory(open.peaks);
    if (cores_.size() > 1) {
      say("two instances");
      m_.two_instances.push_back(
          two_runs_steps_per_s(speed_arguments("processes", duration_s_), core_, cores_.front()) / open.steps_per_s);
    }
    m_.secured.push_back(run_on_bus("secured processes", {"--secure", keys_}).steps_per_s / open.steps_per_s);
    m_.pc5.push_back(run_on_bus("PC5_MODE4", {"--set", "radio.preset=PC5_MODE4"}).steps_per_s / open.steps_per_s);
    m_.python.push_back(
        run_on_bus("Python RSU", {"--rsu", "/usr/bin/python3 " + python_rsu_ + "/python_rsu.py"}).steps_per_s);
    say("in-process");
    const Timed alone = timed_run(speed_arguments("in-process", duration_s_), core_);
    m_.in_process.push_back(alone.steps_per_s);
    note_memory(alone.peaks);
    say("engine alone");
    const double updates_per_s = engine_updates_per_s(9.0 * duration_s_);
    m_.updates_m.push_back(updates_per_s / 1e6);
    if (peer_) beside_peer(open, alone, updates_per_s);
  }

  [[nodiscard]] const Measured& measured() const { return m_; }
  [[nodiscard]] const std::string& missing_peer() const { return missing_peer_; }
  [[nodiscard]] int core() const { return core_; }
  [[nodiscard]] std::size_t cores() const { return cores_.size(); }

 private:
  void beside_peer(const Timed& open, const Timed& alone, double updates_per_s) {
    say("SUMO over TraCI");
    const SumoPeer::Guided traci = peer_->over_traci(core_);
    m_.traci.push_back(traci.steps_per_s);
    m_.against_traci.push_back(open.steps_per_s / traci.steps_per_s);
    m_.peer_commands.push_back(traci.commands_per_step);
    m_.left_apart.push_back(100.0 * std::abs(traci.arrived / open.vehicles_left - 1.0));
    say("libsumo");
    const SumoPeer::Guided libsumo = peer_->in_process(core_);
    m_.libsumo.push_back(libsumo.steps_per_s);
    m_.against_libsumo.push_back(alone.steps_per_s / libsumo.steps_per_s);
    say("SUMO alone");
    m_.against_sumo_alone.push_back(updates_per_s / peer_->alone(core_).updates_per_s);
  }

  Timed run_on_bus(const std::string& what, const std::vector<std::string>& more) {
    say(what);
    return timed_run(speed_arguments("processes", duration_s_, more), core_);
  }

  void note_memory(const Peaks& peaks) {
    for (const auto& [name, kb] : peaks) {
      if (!m_.memory_mb.empty() && m_.memory_mb.front() >= kb / 1000.0) continue;
      m_.memory_mb = {kb / 1000.0};
      m_.largest = name;
    }
  }

  static void say(const std::string& what) { std::fprintf(stderr, "run_speed: %s\n", what.c_str()); }

  double duration_s_;
  std::vector<int> cores_ = lukou::launch::usable_cores();
  int core_ = cores_.back();
  TemporaryFolder folder_;
  std::string keys_ = folder_ / "keys";
  std::string python_rsu_ = folder_ / "python_rsu";
  std::string missing_peer_;
  std::optional<SumoPeer> peer_;
  Measured m_;
};

/// Microseconds per step over the vehicles on the road, in one process: four flows on long roads, 20 to 2000 vehicles.
Line cost_of_vehicles(double duration_s, int core) {
  Values vehicles;
  Values step_us;
  for (const double flow : {22.0, 540.0, 1080.0, 2160.0}) {
    std::vector<std::string> more = {"--set", "vehicles.speed_limit_kmh=40"};
    more.insert(more.end(), {"--set", "traffic.approach_length_m=5000", "--set", "traffic.exit_length_m=5000"});
    const Timed run = timed_run(speed_arguments("in-process", duration_s, more, flow), core);
    vehicles.push_back(run.mean_vehicles);
    step_us.push_back(1e6 / run.steps_per_s);
    std::fprintf(stderr, "run_speed: %.0f vehicles, %.1f us a step\n", vehicles.back(), step_us.back());
  }
  return fitted_line(vehicles, step_us);
}

Spread single(double value) { return {value, value, value}; }

void print_own(SpeedTable& table, const Measured& m) {
  table.row("processes on one core, steps/s", spread(m.processes), {7000, 10000});
  if (m.two_instances.empty())
    table.gap("two instances on two cores, times one", {1.8, 1.95}, "this machine has one core", 2);
  else
    table.row("two instances on two cores, times one", spread(m.two_instances), {1.8, 1.95}, 2);
  table.row("in-process, steps/s", spread(m.in_process), {20000, 40000});
  table.row("engine alone, million vehicle updates/s", spread(m.updates_m), {20, 40}, 1);
  table.row("PC5_MODE4 against the ideal radio", spread(m.pc5), {0.7, 0.85}, 2);
  table.row("Python RSU on the bus, steps/s", spread(m.python), {1000, 2500});
  table.row("secured processes against open ones", spread(m.secured), {}, 2);
  table.row("start-up of the processes, ms", spread(m.start_up_ms), {1000, 300, true});
  table.row("most memory of a process (" + m.largest + "), MB", spread(m.memory_mb), {40, 25, true}, 1);
}

void print_beside_peer(SpeedTable& table, const Measured& m, const std::string& missing) {
  const Aim traci{12, 20};
  const Aim libsumo{9, 18};
  const Aim alone{{}, 70};
  if (!missing.empty()) {
    table.gap("processes against SUMO over TraCI, times", traci, missing);
    table.gap("in-process against libsumo, times", libsumo, missing);
    table.gap("engine alone against SUMO alone, times", alone, missing);
    return;
  }
  table.row("SUMO over TraCI, steps/s", spread(m.traci), {});
  table.row("processes against SUMO over TraCI, times", spread(m.against_traci), traci, 1);
  table.row("libsumo, steps/s", spread(m.libsumo), {});
  table.row("in-process against libsumo, times", spread(m.against_libsumo), libsumo, 1);
  table.row("engine alone against SUMO alone, times the updates/s", spread(m.against_sumo_alone), alone, 1);
  table.row("cars that left by the end, apart, %", spread(m.left_apart), {2, {}, true}, 2);
  table.row("commands per step, Lukou", spread(m.commands), {}, 1);
  table.row("commands per step, SUMO", spread(m.peer_commands), {}, 1);
}

}  // namespace

int main(int argc, char** argv) {
  const int repeats = static_cast<int>(number_argument(argc, argv, "repeats", 3.0));
  const double duration_s = number_argument(argc, argv, "duration", 1200.0);
  const double long_s = number_argument(argc, argv, "long", 36000.0);
  if (repeats < 1 || duration_s < 100.0 || long_s < 0.0) {
    std::fprintf(stderr, "run_speed: --repeats needs at least 1, --duration at least 100, --long at least 0\n");
    return 2;
  }
  print_machine(duration_s);
  Turns turns(duration_s);
  // Not to disturb what it measures on another core.
  if (turns.cores() > 1) lukou::launch::stay_on(lukou::launch::usable_cores().front());
  for (int i = 0; i < repeats; ++i) turns.turn();
  const Line line = cost_of_vehicles(3.0 * duration_s, turns.core());
  SpeedTable table(repeats);
  print_own(table, turns.measured());
  print_beside_peer(table, turns.measured(), turns.missing_peer());
  table.row("in-process, us a step: a of a + b x vehicles", single(line.a), {}, 1);
  table.row("b of it, us per vehicle", single(line.b), {{}, 0.15, true}, 3);
  table.row("R2 of it", single(line.r2), {0.99, {}}, 4);
  const std::string growth = "memory growth in " + std::to_string(static_cast<long>(long_s)) + " s, MB";
  const Aim flat{{}, 1.0, true};
  if (long_s > 0.0) {
    const Timed run = timed_run(speed_arguments("processes", long_s), turns.core());
    table.row(growth, single(run.memory_growth_kb / 1000.0), flat, 2);
  } else {
    table.gap(growth, flat, "--long 0", 2);
  }
  table.print_verdict();
  return table.floors_met() || !flag_argument(argc, argv, "enforce") ? 0 : 1;
}
