#include "tests/faults/plan.hpp"

#include <algorithm>
#include <cstdio>

#include "common/lockstep/roster.hpp"

namespace lukou::faults {
namespace {

/// Draws that are the same with every standard library.
class Draws {
 public:
  explicit Draws(std::uint64_t seed) : state_(seed) {}
  std::uint64_t below(std::uint64_t count) { return mixed(state_++) % count; }
  double between(double from, double to) {
    return from + (to - from) * static_cast<double>(mixed(state_++) >> 11U) / static_cast<double>(1ULL << 53U);
  }
  bool chance(double probability) { return between(0.0, 1.0) < probability; }
  template <class T>
  T one_of(const std::vector<T>& list) {
    return list[below(list.size())];
  }

 private:
  std::uint64_t state_;
};

std::string seconds(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2f s", value);
  return text;
}

std::string name(Action action) {
  switch (action) {
    case Action::kKill:
      return "KILL";
    case Action::kTerminate:
      return "TERM";
    case Action::kInterrupt:
      return "INT";
    case Action::kHangUp:
      return "HUP";
    case Action::kStop:
      return "STOP";
    case Action::kStopFor:
      return "STOP+CONT";
    case Action::kSlow:
      return "SLOW";
  }
  return "";
}

struct Pace {
  std::string name;
  Step steps;  ///< about four seconds of wall time
};

Action action_on(const std::string& victim, Draws& draws) {
  if (victim == "lukou") {
    return draws.one_of<Action>({Action::kKill, Action::kKill, Action::kTerminate, Action::kInterrupt, Action::kHangUp,
                                 Action::kStopFor, Action::kSlow});
  }
  return draws.one_of<Action>({Action::kKill, Action::kKill, Action::kKill, Action::kTerminate, Action::kStop,
                               Action::kStopFor, Action::kStopFor, Action::kSlow, Action::kSlow});
}

Fault fault_of(const Plan& plan, Draws& draws) {
  // Every process is as likely as any other, but for the RSUs: their loss may go three ways.
  std::vector<std::string> victims = {"clock", "traffic-engine", "signal-controller", "recorder", "lukou"};
  for (std::uint32_t rsu = 0; rsu < plan.rsus; ++rsu) victims.insert(victims.end(), 4 / plan.rsus, rsu_role(rsu));
  if (plan.console) victims.insert(victims.end(), 3, "console");
  Fault fault{.victim = draws.one_of(victims)};
  fault.action = action_on(fault.victim, draws);
  if (draws.chance(0.1)) fault.after_s = draws.between(0.0, 0.35);
  // An RSU that shall come back needs the time for it.
  const bool rsu = rsu_index(fault.victim) >= 0;
  const bool returns = rsu && plan.policy != "ABORT";
  const double last = draws.chance(0.05) ? 1.0 : returns ? 0.5 : 0.95;
  fault.at = static_cast<Step>(draws.between(0.0, last) * static_cast<double>(plan.steps));
  if (fault.action == Action::kStopFor) fault.stop_s = draws.between(0.1, fault.victim == "lukou" ? 3.0 : 5.0);
  if (fault.action == Action::kSlow) {
    fault.stop_s = draws.between(0.01, 0.5);
    fault.stops = static_cast<int>(1 + draws.below(static_cast<std::uint64_t>(std::min(20.0, 2.0 / fault.stop_s))));
  }
  const bool gone = fault.action == Action::kKill || fault.action == Action::kTerminate;
  if (gone && fault.victim != "lukou" && draws.chance(returns ? 0.8 : 0.1)) fault.restart_s = draws.between(0.0, 1.0);
  return fault;
}

}  // namespace

std::uint64_t mixed(std::uint64_t state) {
  std::uint64_t z = (state + 1) * 0x9E3779B97F4A7C15ULL;
  z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9ULL;
  z = (z ^ (z >> 27U)) * 0x94D049BB133111EBULL;
  return z ^ (z >> 31U);
}

std::string Fault::text() const {
  std::string text = name(action) + " " + victim;
  if (action == Action::kStopFor) text += " " + seconds(stop_s);
  if (action == Action::kSlow) text += " " + std::to_string(stops) + " x " + seconds(stop_s);
  text += after_s >= 0.0 ? " at " + seconds(after_s) : " @" + std::to_string(at);
  if (restart_s >= 0.0) text += ", again " + seconds(restart_s);
  return text;
}

std::vector<std::string> Plan::arguments() const {
  std::vector<std::string> arguments = {"run",
                                        scenario,
                                        "--duration",
                                        std::to_string(steps / kStepsPerSecond),
                                        "--seed",
                                        std::to_string(1 + seed % 1000),
                                        "--pace",
                                        pace,
                                        "--stall-limit",
                                        "3",
                                        "--quiet",
                                        "--set",
                                        "run.on_rsu_loss=" + policy,
                                        "--set",
                                        "record.guidance=true"};
  if (rsus == 2) arguments.insert(arguments.end(), {"--rsu-algorithm", "1=glosa"});
  if (console) arguments.emplace_back("--console");
  return arguments;
}

Plan draw(std::uint64_t seed) {
  Draws draws(mixed(seed));
  Plan plan{.seed = seed};
  plan.scenario = draws.one_of<std::string>({"paper", "paper", "actuated"});
  plan.policy = draws.one_of<std::string>({"ABORT", "CONTINUE", "CONTINUE", "WAIT"});
  if (plan.scenario == "actuated") plan.policy = "ABORT";  // the only one that a run with signals.actuation takes
  const Pace pace = draws.one_of<Pace>({{"10", 300}, {"20", 600}, {"50", 1500}, {"max", 12000}});
  plan.pace = pace.name;
  plan.steps = pace.steps;
  plan.rsus = draws.chance(0.2) ? 2 : 1;
  plan.console = draws.chance(0.15);
  plan.faults.push_back(fault_of(plan, draws));
  if (draws.chance(0.2)) plan.faults.push_back(fault_of(plan, draws));
  std::ranges::stable_sort(plan.faults, [](const Fault& a, const Fault& b) {
    if ((a.after_s >= 0.0) != (b.after_s >= 0.0)) return a.after_s >= 0.0;
    return a.after_s >= 0.0 ? a.after_s < b.after_s : a.at < b.at;
  });
  return plan;
}

}  // namespace lukou::faults
