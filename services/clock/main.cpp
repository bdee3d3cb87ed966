#include <algorithm>
#include <cstdlib>
#include <vector>

#include "common/bus/participant.hpp"
#include "common/lockstep/clock_core.hpp"
#include "common/process/options.hpp"
#include "common/process/stepping.hpp"
#include "common/scenario/directive_log.hpp"
#include "common/scenario/scenario_steps.hpp"

using namespace lukou;

namespace {

constexpr double kStateEvery_s = 0.1;
constexpr double kGoodbye_s = 2.0;
constexpr double kLastWords_s = 0.5;
constexpr double kPacedTick_s = 0.02;
constexpr std::size_t kOpenRequests = 16;  ///< of one operator; it asks again until it is answered
constexpr double kIdleTick_s = 0.1;

/// The clock's endpoints and what they carry between the bus and the core.
class ClockOnTheBus {
 public:
  ClockOnTheBus(bus::Participant& participant, ClockCore& core)
      : participant_(participant), core_(core), up_(participant), control_(participant), state_(participant) {}

  void receive() {
    up_.take([this](Up& message, const bus::SampleInfo& info) {
      if (info.alive && message.kind == Up::Kind::kRequest) {
        const auto open = std::ranges::count(requests_, message.incarnation, &Up::incarnation);
        if (open < static_cast<std::ptrdiff_t>(kOpenRequests)) requests_.push_back(message);
      } else if (info.alive && message.kind == Up::Kind::kJoin) {
        // Discovery goes both ways: a welcome before the other side has matched would be lost. It asks again.
        if (control_.matched().contains(message.incarnation)) core_.receive(process::wall_s(), message);
      } else if (info.alive) {
        core_.receive(process::wall_s(), message);
      } else {
        std::erase_if(requests_, [&](const Up& request) { return request.incarnation == info.producer; });
        core_.gone(process::wall_s(), info.producer);
      }
    });
    execute_requests();
    if (core_.roster_version() > seen_ && sees_all()) {
      seen_ = core_.roster_version();
      core_.sees(process::wall_s(), seen_);
    }
  }

  void send() {
    for (const Control& control : core_.take_outbox()) control_.write(control);
    const RunState now = state();
    const double now_s = process::wall_s();
    const bool changed = now.phase != told_.phase || now.text != told_.text;
    if (changed || now_s - told_s_ >= kStateEvery_s) {
      state_.write(now);
      told_ = now;
      told_s_ = now_s;
    }
  }

  /// The last answers and the end of the run may still be under way to operators who came a moment ago.
  void finish() {
    state_.write(state());
    for (const auto& [topic, foreign] : participant_.foreign()) {
      process::log_warning("topic " + topic + ": ignored " + std::to_string(foreign.samples) +
                           " foreign samples, first " + foreign.first);
    }
    control_.finish(kLastWords_s);
    state_.finish(kLastWords_s);
  }

 private:
  [[nodiscard]] RunState state() const {
    RunState state = core_.state();
    state.foreign_samples += participant_.foreign_samples();
    return state;
  }

  /// In their order, as soon as the answer can reach whoever asked: an operator is heard before its reader is matched,
  /// and a run that ends at its request could not answer a second time.
  void execute_requests() {
    if (requests_.empty()) return;
    const auto reached = control_.matched();
    std::erase_if(requests_, [&](const Up& request) {
      if (!reached.contains(request.incarnation)) return false;
      core_.receive(process::wall_s(), request);
      return true;
    });
  }

  [[nodiscard]] bool sees_all() {
    const auto heard = up_.matched();
    const auto reached = control_.matched();
    for (const auto& [incarnation, role] : core_.roster())
      if (!heard.contains(incarnation) || !reached.contains(incarnation)) return false;
    return true;
  }

  bus::Participant& participant_;
  ClockCore& core_;
  bus::Reader<Up> up_;
  bus::Writer<Control> control_;
  bus::Writer<RunState> state_;
  std::vector<Up> requests_;  ///< not executed yet
  std::uint32_t seen_ = 0;
  RunState told_;
  double told_s_ = -1.0;
};

int exit_code(const RunOutcome& outcome) {
  switch (outcome.kind) {
    case RunOutcome::Kind::kDone:
    case RunOutcome::Kind::kStopped:
      return process::kExitDone;
    case RunOutcome::Kind::kAnomaly:
      return process::kExitAnomaly;
    case RunOutcome::Kind::kLost:
    case RunOutcome::Kind::kStalled:
      return process::kExitAborted;
  }
  return process::kExitInternal;
}

/// 0 if there is none.
Incarnation incarnation_in(const std::string& text) { return std::strtoull(text.c_str(), nullptr, 16); }

RsuLossPolicy policy_of(const std::string& name) {
  if (name == "CONTINUE") return RsuLossPolicy::kContinue;
  return name == "WAIT" ? RsuLossPolicy::kWait : RsuLossPolicy::kAbort;
}

/// Settings from the command line and the scenario; the live checks keep the clock's own copy of the scenario.
Expected<ClockSettings> settings_of(const process::MemberOptions& options, scenario::Resolved& scenario) {
  ClockSettings settings;
  const scenario::Protocol protocol = scenario::protocol(scenario);
  settings.run = options.address.run;
  settings.scenario_text = scenario::text(scenario);
  settings.scenario_hash = scenario::hash(scenario);
  settings.rsus = protocol.rsus;
  settings.end = protocol.end;
  settings.signal_promise = protocol.signal_promise;
  settings.on_rsu_loss = policy_of(protocol.on_rsu_loss);
  settings.start_paused = options.has("--wait");
  settings.watchdog = !options.has("--no-watchdog");
  if (options.has("--pace")) {
    const auto pace = pace_of(options.value("--pace"));
    if (!pace) return pace.error();
    settings.pace = pace.value();
  }
  for (const auto& [name, limit] :
       {std::pair{"--stall-limit", &settings.stall_limit_s}, std::pair{"--forming-limit", &settings.forming_limit_s}}) {
    if (!options.has(name)) continue;
    *limit = std::atof(options.value(name).c_str());
    if (!(*limit > 0.0)) return Error{name, "must be a number of seconds above 0"};
  }
  if (options.has("--replay-directives")) {
    const auto log = scenario::load_directives(options.value("--replay-directives"));
    if (!log) return log.error();
    settings.replay = log.value().sets;
    settings.stop_at = log.value().stop;
  }
  settings.check_change = [&scenario](const std::string& set) { return scenario::change(scenario, set); };
  return settings;
}

int run(int argc, char** argv) {
  const auto options =
      process::member_options(argc, argv, "The simulated time of a run: start, pace, pause, end.",
                              {process::kNoWatchdog,
                               {"--scenario", "resolved scenario file"},
                               {"--pace", "max, very-slow, slow, medium, fast or simulated seconds per second"},
                               {"--wait", "hold the run at step 0", true},
                               {"--replay-directives", "directives.textproto of an earlier run"},
                               {"--stall-limit", "wall seconds without progress after which a run is aborted"},
                               {"--forming-limit", "wall seconds in which everybody must have joined"},
                               {"--incarnation", "its name on the bus, by which others know it; 16 hexadecimal digits"},
                               {"--launcher", "that of the process which may say that another has ended"}});
  if (!options) return std::stoi(options.error().what);
  process::catch_terminate_signal();
  auto scenario = scenario::load(options.value().value("--scenario"));
  if (!scenario) return process::report_start(scenario.error(), process::kExitUsage);
  auto settings = settings_of(options.value(), scenario.value());
  if (!settings) return process::report_start(settings.error(), process::kExitUsage);

  const Incarnation given = incarnation_in(options.value().value("--incarnation"));
  const auto participant =
      bus::Participant::join(options.value().address, kClockRole, given != 0 ? given : process::new_incarnation());
  if (!participant) return process::report_start(participant.error(), process::kExitAborted);
  settings.value().incarnation = participant.value()->self();
  settings.value().launcher = incarnation_in(options.value().value("--launcher"));
  ClockCore core(settings.value());
  ClockOnTheBus clock(*participant.value(), core);
  const bool watchdog = settings.value().watchdog;
  participant.value()->keep_writing_while([] { return process::stop_signal() == 0; });

  double over_s = 0.0;
  while (!core.all_left() && (over_s == 0.0 || process::wall_s() - over_s < kGoodbye_s)) {
    participant.value()->wait(core.state().pace > 0.0 ? kPacedTick_s : kIdleTick_s);
    clock.receive();
    core.tick(process::wall_s());
    clock.send();
    if (core.outcome() && over_s == 0.0) over_s = process::wall_s();
    if (process::stop_signal() == 0) continue;
    // Whoever started the run ends everybody; a signal of somebody else's ends the clock, and the others must know.
    const bool all_ended =
        process::terminated_by_launcher() || process::stop_signal() == process::launcher_died_signal();
    if (all_ended && (watchdog || over_s != 0.0)) return process::kExitTerminated;
    if (!all_ended) core.fail(std::string(kClockRole), "was ended by a signal");
  }
  clock.finish();
  if (!core.outcome()->text.empty()) process::log_error(core.outcome()->culprit + " " + core.outcome()->text);
  return exit_code(*core.outcome());
}

}  // namespace

int main(int argc, char** argv) {
  return process::guarded("clock", [&] { return run(argc, argv); });
}
