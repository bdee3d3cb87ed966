#include <sched.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <set>

#include "common/process/environment.hpp"
#include "common/process/log.hpp"
#include "common/process/run_client.hpp"
#include "common/scenario/scenario_steps.hpp"
#include "services/lukou/launch/child.hpp"
#include "services/lukou/launch/console_process.hpp"
#include "services/lukou/launch/domain_claim.hpp"
#include "services/lukou/launch/result_of_run.hpp"
#include "services/lukou/launch/rsu_child.hpp"
#include "services/lukou/launch/run_request.hpp"

namespace lukou::launch {
namespace {

namespace fs = std::filesystem;

constexpr double kPoll_s = 0.05;
constexpr double kLeave_s = 3.0;  ///< after the clock has left, until SIGTERM
constexpr double kKill_s = 1.5;   ///< after SIGTERM, until SIGKILL
/// It speaks ten times a second; a crowded core has kept one from it for 5 s.
constexpr double kClockSilent_s = 15.0;

/// Programs lie beside this one.
fs::path program(const std::string& name) { return fs::read_symlink("/proc/self/exe").parent_path() / name; }

/// Lockstep has no parallelism to lose: all processes of a run share one core, the next run takes the next one.
std::optional<int> core_for(const RunRequest& request, int domain) {
  if (request.core) return request.core;
  cpu_set_t ours;
  if (sched_getaffinity(0, sizeof ours, &ours) != 0) return std::nullopt;
  std::vector<int> cores;
  for (int core = 0; core < CPU_SETSIZE; ++core)
    if (CPU_ISSET(static_cast<unsigned>(core), &ours)) cores.push_back(core);
  if (cores.empty()) return std::nullopt;
  return cores[static_cast<std::size_t>(domain) % cores.size()];
}

/// One run of processes, from the first fork to the last exit.
class Session {
 public:
  Session(const RunRequest& request, const Listener& listener, fs::path folder, DomainClaim claim, bus::Address address,
          Incarnation clock)
      : request_(request),
        listener_(listener),
        folder_(std::move(folder)),
        claim_(std::move(claim)),
        address_(std::move(address)),
        clock_(clock),
        protocol_(scenario::protocol(request.scenario)) {}

  RunReport run() {
    begun_s_ = process::wall_s();
    if (auto started = start_all(); !started) return failed(process::kExitInternal, started.error());
    auto client = process::RunClient::attach(address_, request_.observe, self_);
    if (!client) return failed(process::kExitAborted, client.error());
    client_ = std::move(client).value();
    client_->on_control([this](const Control& said) {
      if (said.kind == Control::Kind::kFence) fenced_.insert(rsu_role(said.rsu));
    });
    if (request_.console != nullptr) request_.console->show(address_);
    while (!children_.empty()) {
      client_->poll(kPoll_s);
      follow_signals();
      follow_console();
      for (const ChildExit& ended : children_.reap()) on_exit(ended);
      follow_state();
      watch_clock();
      end_stragglers();
    }
    return report();
  }

 private:
  Expected<Done> start_all() {
    const auto member = [&](const std::string& role, const std::string& name, std::vector<std::string> more) {
      // Who writes all down has more to do than anybody in the lockstep, and nobody waits for it.
      const bool apart = role == kRecorderRole && scenario::logs_everything(request_.scenario) && !request_.core;
      ChildSpec spec{.role = role,
                     .command = {program(name).string()},
                     .environment = environment(role),
                     .core = apart ? std::nullopt : core_for(request_, address_.domain),
                     .log = folder_ / "operator.log"};
      if (!request_.watchdog) more.emplace_back("--no-watchdog");
      spec.command.insert(spec.command.end(), more.begin(), more.end());
      return start(std::move(spec));
    };
    std::vector<std::string> clock = {"--scenario",    (folder_ / "scenario.textproto").string(),
                                      "--pace",        request_.pace,
                                      "--incarnation", bus::text_of(clock_),
                                      "--launcher",    bus::text_of(self_)};
    if (request_.start_paused) clock.emplace_back("--wait");
    if (!request_.stall_limit_s.empty()) clock.insert(clock.end(), {"--stall-limit", request_.stall_limit_s});
    if (!request_.replay.empty()) clock.insert(clock.end(), {"--replay-directives", request_.replay.string()});
    if (waits_for_somebody()) clock.insert(clock.end(), {"--forming-limit", "1000000"});
    if (auto done = member(std::string(kClockRole), "lukou-clock", clock); !done) return done;
    std::vector<std::string> engine;
    if (!request_.replay.empty()) engine = {"--replay-directives", request_.replay.string()};
    if (auto done = member(std::string(kEngineRole), "lukou-traffic-engine", engine); !done) return done;
    if (auto done = member(std::string(kControllerRole), "lukou-signal-controller", {}); !done) return done;
    if (auto done = member(std::string(kRecorderRole), "lukou-recorder", {"--out", folder_.string()}); !done)
      return done;
    for (std::uint32_t rsu = 0; rsu < protocol_.rsus; ++rsu) {
      const std::string index = std::to_string(rsu);
      const std::string& started = rsu_program(request_, rsu);
      if (started == "wait") {
        process::log_warning("start " + rsu_role(rsu) + " by hand: " + by_hand(rsu));
      } else if (started.empty()) {
        if (auto done = member(rsu_role(rsu), "lukou-rsu", {"--index", index}); !done) return done;
      } else {
        if (auto done = start(rsu_child(rsu, started, environment(rsu_role(rsu)))); !done) return done;
      }
    }
    return Done{};
  }

  [[nodiscard]] std::vector<std::string> environment(const std::string& role) const {
    std::vector<std::string> variables = request_.reach.environment(role);
    variables.push_back("LUKOU_RUN=" + address_.run);
    variables.push_back("LUKOU_DOMAIN=" + std::to_string(address_.domain));
    return variables;
  }

  Expected<Done> start(ChildSpec spec) {
    const auto prefix = request_.reach.prefix_of.find(spec.role);
    if (prefix != request_.reach.prefix_of.end()) spec = behind(prefix->second, program("lukou"), std::move(spec));
    return children_.start(spec);
  }

  /// The command that a user types for an RSU that nobody starts.
  [[nodiscard]] std::string by_hand(std::uint32_t rsu) const {
    std::string command;
    for (const std::string& variable : environment(rsu_role(rsu)))
      if (!variable.ends_with('=')) command += variable + " ";
    return command + "LUKOU_RSU=" + std::to_string(rsu) + " " + program("lukou-rsu").string() +
           (request_.watchdog ? "" : " --no-watchdog");
  }

  [[nodiscard]] bool waits_for_somebody() const {
    for (std::uint32_t rsu = 0; rsu < protocol_.rsus; ++rsu)
      if (rsu_program(request_, rsu) == "wait") return true;
    return false;
  }

  void on_exit(const ChildExit& ended) {
    const double now_s = process::wall_s();
    if (ended.role == kClockRole) {
      // Its last word may still be under way.
      for (int i = 0; i < 5 && !ended.signalled && !over(); ++i) client_->poll(kPoll_s);
      follow_state();
      clock_gone_s_ = now_s;
      clock_exit_ = ended;
      // Nobody ends the others any more: they close what they have.
      if (!over()) {
        children_.signal_all(process::clock_died_signal());
        terminated_s_ = now_s;
      }
      return;
    }
    if (ended.role == kRecorderRole && ended.code == process::kExitIo && !ended.signalled) io_failed_ = true;
    // One that the run goes on without leaves late; by then another may have its role.
    if (fenced_.contains(ended.role)) return;
    if (!over() && culprit_.empty()) {
      lost_.push_back(ended);
      client_->report_lost(ended.role, ended.text());
    }
  }

  /// The clock watches everybody, its launcher watches it: one that does not run any more is ended, and is the culprit.
  void watch_clock() {
    const double now_s = process::wall_s();
    // What stops this process makes the clock look silent: Ctrl-Z, a suspended machine.
    if (now_s - watched_s_ > 1.0) awake_s_ = now_s;
    watched_s_ = now_s;
    if (!request_.watchdog || over() || clock_gone_s_ != 0.0 || clock_stands_) return;
    const double silent_s = std::min(client_->clock_silent_s(), now_s - awake_s_);
    if (silent_s < kClockSilent_s) return;
    clock_stands_ = true;
    children_.signal(std::string(kClockRole), SIGKILL);
  }

  [[nodiscard]] bool over() const {
    const auto& state = client_->state();
    return state && (state->phase == RunPhase::kEnded || state->phase == RunPhase::kAborted);
  }

  void follow_state() {
    const auto& state = client_->state();
    if (!state) return;
    const double now_s = process::wall_s();
    if (state->phase != RunPhase::kForming && running_s_ == 0.0) running_s_ = now_s;
    if (over() && over_s_ == 0.0) {
      over_s_ = now_s;
      culprit_ = state->culprit;
      text_ = state->text;
    }
    // A loss may have been said before the clock listened.
    if (!over() && now_s - said_s_ > 0.5) {
      said_s_ = now_s;
      for (const ChildExit& lost : lost_)
        if (state->phase == RunPhase::kForming) client_->report_lost(lost.role, lost.text());
    }
    if (!listener_) return;
    RunNews news{.run = address_.run,
                 .phase = std::string(name(state->phase)),
                 .step = std::max<Step>(state->recorded, 0),
                 .end = state->end,
                 .wall_s = running_s_ == 0.0 ? 0.0 : now_s - running_s_,
                 .pace = state->pace};
    if (client_->view()) {
      news.step = std::max<long long>(news.step, client_->view()->step);
      news.cars_in_system = client_->view()->figures.in_system.front();
    }
    if (state->phase == RunPhase::kForming && !state->text.empty()) news.phase += " (missing: " + state->text + ")";
    listener_(news);
  }

  void follow_signals() {
    if (process::stop_signal() == 0 || interrupted_ != 0) return;
    interrupted_ = process::stop_signal();
    interrupted_s_ = process::wall_s();
    client_->ask("interrupt");
  }

  /// A restart ends this run as an operator would; the launcher begins the next.
  void follow_console() {
    if (request_.console == nullptr) return;
    request_.console->poll();
    const auto seed = request_.console->take_restart();
    if (!seed) return;
    restart_ = seed;
    if (!over()) client_->ask("stop");
  }

  void end_stragglers() {
    const double now_s = process::wall_s();
    const bool forming = !client_->state() || client_->state()->phase == RunPhase::kForming;
    // An interrupted run ends by itself within a window; one that cannot is ended.
    if (interrupted_ != 0 && clock_gone_s_ == 0.0 && terminated_s_ == 0.0 &&
        now_s - interrupted_s_ > (forming ? 0.2 : 5.0)) {
      children_.signal_all(SIGTERM);
      terminated_s_ = now_s;
    }
    if (clock_gone_s_ != 0.0 && terminated_s_ == 0.0 && now_s - clock_gone_s_ > kLeave_s) {
      children_.signal_all(SIGTERM);
      terminated_s_ = now_s;
    }
    if (terminated_s_ != 0.0 && now_s - terminated_s_ > kKill_s) children_.signal_all(SIGKILL);
  }

  RunReport report() {
    RunEnd end;
    end.interrupted_by = interrupted_;
    end.io_failed = io_failed_;
    end.anomaly = clock_exit_.code == process::kExitAnomaly && !clock_exit_.signalled;
    if (over_s_ == 0.0 && !clock_exit_.well() && interrupted_ == 0) {
      culprit_ = clock_exit_.signalled || lost_.empty() ? std::string(kClockRole) : lost_.front().role;
      text_ = clock_stands_ ? "did not run any more" : clock_exit_.text();
    }
    // What the launcher saw of the culprit says more than that nobody hears it any more.
    const bool guessed = text_.starts_with("is gone") || text_.starts_with("left");
    for (const ChildExit& lost : lost_)
      if (lost.role == culprit_ && (lost.signalled || guessed)) text_ = lost.text();
    end.culprit = culprit_;
    end.text = text_;
    // A short run may be over before the clock is heard here.
    end.wall_s = (over_s_ != 0.0 ? over_s_ : process::wall_s()) - (running_s_ != 0.0 ? running_s_ : begun_s_);
    end.start_up_s = running_s_ != 0.0 ? running_s_ - begun_s_ : 0.0;
    end.foreign_samples = client_->foreign_samples() + (client_->state() ? client_->state()->foreign_samples : 0);
    RunReport report = finish_result(request_, folder_, end);
    report.restart = restart_;
    return report;
  }

  RunReport failed(int exit_code, const Error& error) {
    children_.signal_all(SIGKILL);
    process::log_error(error.text());
    RunReport report;
    report.exit_code = exit_code;
    report.folder = folder_;
    report.ended = error.text();
    return report;
  }

  const RunRequest& request_;
  const Listener& listener_;
  fs::path folder_;
  DomainClaim claim_;
  bus::Address address_;
  Incarnation clock_;
  Incarnation self_ = process::new_incarnation();
  scenario::Protocol protocol_;
  std::unique_ptr<process::RunClient> client_;
  Children children_;
  ChildExit clock_exit_;
  std::vector<ChildExit> lost_;
  std::set<std::string> fenced_;  ///< roles of children without which the run goes on
  std::string culprit_;
  std::string text_;
  bool io_failed_ = false;
  std::optional<std::uint64_t> restart_;
  int interrupted_ = 0;
  double begun_s_ = 0.0;
  double running_s_ = 0.0;
  double over_s_ = 0.0;
  double said_s_ = 0.0;
  double watched_s_ = 0.0;     ///< when the clock was looked after last ...
  double awake_s_ = 0.0;       ///< ... and since when without a gap
  bool clock_stands_ = false;  ///< ended because it had not run any more
  double interrupted_s_ = 0.0;
  double clock_gone_s_ = 0.0;
  double terminated_s_ = 0.0;
};

std::string run_id(const RunRequest& request) {
  static constexpr std::string_view kDigits = "0123456789abcdef";
  std::string id = request.name;
  std::erase_if(id, [](char c) { return std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '_' && c != '-'; });
  if (id.empty()) id = "run";
  id.resize(std::min<std::size_t>(id.size(), 24));
  id += "-" + std::to_string(scenario::protocol(request.scenario).seed) + "-";
  for (Incarnation random = process::new_incarnation(), i = 0; i < 4; ++i, random >>= 4U) id += kDigits[random & 15U];
  return id;
}

}  // namespace

RunReport run_processes(const RunRequest& request, const Listener& listener) {
  RunReport report;
  const auto refuse = [&](int exit_code, const Error& error) {
    process::log_error(error.text());
    report.exit_code = exit_code;
    report.ended = error.text();
    return report;
  };
  auto folder = create_result(request);
  if (!folder) return refuse(process::kExitIo, folder.error());
  const std::string run = request.run_id.empty() ? run_id(request) : request.run_id;
  const Reach& reach = request.reach;
  const Incarnation clock = process::new_incarnation();
  auto claim = DomainClaim::lowest_free(
      {.run = run, .clock = clock, .secured = !reach.keys.empty(), .hosts = !reach.peers.empty()});
  if (!claim) return refuse(process::kExitAborted, claim.error());
  const bus::Address address{.domain = claim.value().domain(),
                             .run = run,
                             .peers = reach.peers,
                             .identity = reach.identity(std::string(kObserverRole))};
  Session session(request, listener, folder.value(), std::move(claim).value(), address, clock);
  return session.run();
}

}  // namespace lukou::launch
