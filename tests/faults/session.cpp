#include "tests/faults/session.hpp"

#include <unistd.h>

#include <chrono>
#include <csignal>
#include <memory>
#include <optional>
#include <set>
#include <thread>

#include "common/process/run_client.hpp"
#include "common/process/run_list.hpp"
#include "tests/system/program.hpp"

namespace lukou::faults {
namespace {

namespace fs = std::filesystem;
using test::Program;

constexpr double kEndLimit_s = 60.0;     ///< of a run; it takes 4 s, its end after a fault at most 6 s, a console 12 s
constexpr double kOrphanLimit_s = 6.0;   ///< after the death of `lukou` itself
constexpr double kByHandLimit_s = 15.0;  ///< a process that finds no clock gives up after 10 s
constexpr double kRunWaits_s = 5.0;      ///< how long a run that waits for an RSU is watched

double now_s() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

void pause_s(double seconds) { std::this_thread::sleep_for(std::chrono::duration<double>(seconds)); }

int number_of(Action action) {
  switch (action) {
    case Action::kKill:
      return SIGKILL;
    case Action::kTerminate:
      return SIGTERM;
    case Action::kInterrupt:
      return SIGINT;
    case Action::kHangUp:
      return SIGHUP;
    case Action::kStop:
    case Action::kStopFor:
    case Action::kSlow:
      break;
  }
  return SIGSTOP;
}

/// "rsu1" of {"/.../lukou-rsu", "--index", "1"}.
std::string role_of(const std::vector<std::string>& command) {
  static const std::string kPrefix = "lukou-";
  const std::string program = command.empty() ? "" : fs::path(command.front()).filename().string();
  if (program == "lukou-rsu") return rsu_role(command.size() > 2 ? static_cast<unsigned>(std::stoul(command[2])) : 0);
  return program.starts_with(kPrefix) ? program.substr(kPrefix.size()) : program;
}

class Session {
 public:
  Session(const Plan& plan, fs::path folder)
      : plan_(plan), folder_(std::move(folder)), run_(test::fresh_run_id()), mark_("LUKOU_FAULTS=" + run_) {}

  Observed make() {
    const test::TemporaryFolder temporary;
    fs::create_directory(temporary / "tmp");
    const std::set<std::string> memory_before = shared_memory();
    auto arguments = plan_.arguments();
    arguments.insert(arguments.end(), {"--run-id", run_, "--out", folder_.string()});
    Program lukou(arguments, {mark_, "TMPDIR=" + (temporary / "tmp").string()});
    begun_s_ = now_s();
    lukou_ = lukou.pid();
    observed_.done.resize(plan_.faults.size());
    for (std::size_t i = 0; i < plan_.faults.size(); ++i) {
      wait_for(plan_.faults[i], lukou);
      act(plan_.faults[i], observed_.done[i], lukou);
    }
    end(lukou);
    observed_.err = lukou.err();
    observed_.wall_s = now_s() - begun_s_;
    client_.reset();
    end_programs_by_hand();
    note_what_is_left(lukou, temporary / "tmp", memory_before);
    return std::move(observed_);
  }

 private:
  struct ByHand {
    std::size_t fault;
    std::unique_ptr<Program> program;
  };

  static std::set<std::string> shared_memory() {
    std::set<std::string> names;
    std::error_code none;
    for (const auto& entry : fs::directory_iterator("/dev/shm", none)) names.insert(entry.path().filename());
    return names;
  }

  /// Looks at the run for a moment, as any observer may.
  void look(double timeout_s) {
    if (!client_) {
      const auto run = process::find_run(run_, {.domain = -1});
      if (!run) return pause_s(timeout_s);
      domain_ = run.value().domain;
      auto client = process::RunClient::attach(run.value(), true);
      if (client) client_ = std::move(client).value();
      return;
    }
    client_->poll(timeout_s);
  }

  [[nodiscard]] Step seen() const {
    if (!client_) return -1;
    const Step recorded = client_->state() ? client_->state()->recorded : -1;
    return client_->view() ? std::max(recorded, client_->view()->step) : recorded;
  }

  void wait_for(const Fault& fault, Program& lukou) {
    while (lukou.running()) {
      if (fault.after_s >= 0.0 ? now_s() - begun_s_ >= fault.after_s : seen() >= fault.at) return;
      if (client_ && client_->state() && client_->state()->phase >= RunPhase::kEnded) return;
      start_due();
      look(0.002);
    }
  }

  /// The victim's process; a run that forms is waited for, since it may not have started everybody.
  std::optional<pid_t> process_of(const Fault& fault, Program& lukou) {
    if (fault.victim == "lukou") return lukou.running() ? std::optional(lukou_) : std::nullopt;
    const double begin_s = now_s();
    do {
      for (const test::RunningProcess& process : test::processes_with(mark_)) {
        if (process.pid != lukou_ && role_of(process.command) == fault.victim && !by_hand(process.pid)) {
          return process.pid;
        }
      }
    } while (fault.after_s >= 0.0 && lukou.running() && now_s() - begin_s < 1.0);
    return std::nullopt;
  }

  [[nodiscard]] bool by_hand(pid_t process) const {
    for (const ByHand& started : by_hand_)
      if (started.program->pid() == process) return true;
    return false;
  }

  void act(const Fault& fault, Done& done, Program& lukou) {
    if (client_ && client_->state()) {
      done.forming = client_->state()->phase == RunPhase::kForming;
      done.over = client_->state()->phase >= RunPhase::kEnding;
      done.recorded = client_->state()->recorded;
      done.seen = seen();
    }
    const auto victim = process_of(fault, lukou);
    done.hit = victim.has_value();
    if (!victim) return;
    kill(*victim, number_of(fault.action));
    if (fault.action == Action::kStopFor || fault.action == Action::kSlow) {
      for (int stop = 0; stop < fault.stops; ++stop) {
        if (stop > 0) kill(*victim, SIGSTOP);
        pause_s(fault.stop_s);
        kill(*victim, SIGCONT);
        pause_s(fault.stop_s / 4);
      }
    }
    if (fault.restart_s >= 0.0)
      due_.emplace_back(now_s() + fault.restart_s, static_cast<std::size_t>(&fault - plan_.faults.data()));
  }

  /// Starts what is due by hand, as an operator would in a second terminal.
  void start_due() {
    for (auto it = due_.begin(); it != due_.end();) {
      if (now_s() < it->first || !client_) {
        ++it;
        continue;
      }
      by_hand_.push_back({it->second, start(plan_.faults[it->second].victim)});
      it = due_.erase(it);
    }
  }

  std::unique_ptr<Program> start(const std::string& role) {
    std::string name = "lukou-" + role;
    std::vector<std::string> arguments;
    if (rsu_index(role) >= 0) {
      name = "lukou-rsu";
      arguments = {"--index", std::to_string(rsu_index(role))};
    } else if (role == "clock") {
      arguments = {"--scenario", (folder_ / "scenario.textproto").string(), "--forming-limit", "3"};
    } else if (role == "recorder") {
      arguments = {"--out", folder_.string()};
    } else if (role == "console") {
      arguments = {"--attach", run_, "--ports", "50"};
    }
    return std::make_unique<Program>(
        arguments, std::vector<std::string>{mark_, "LUKOU_RUN=" + run_, "LUKOU_DOMAIN=" + std::to_string(domain_)},
        fs::path(LUKOU_PROGRAM).parent_path() / name);
  }

  void end(Program& lukou) {
    const double begin_s = now_s();
    while (lukou.running()) {
      start_due();
      look(0.01);
      const double waited_s = now_s() - begin_s;
      if (plan_.policy == "WAIT" && waited_s > kRunWaits_s && !observed_.interrupted && due_.empty() &&
          stands_still()) {
        observed_.interrupted = true;
        lukou.signal(SIGINT);
      }
      if (waited_s > kEndLimit_s) break;
    }
    observed_.code = lukou.wait(0.1);
  }

  /// True if nothing has been recorded for a while.
  bool stands_still() {
    if (seen() != stood_at_) {
      stood_at_ = seen();
      stood_since_s_ = now_s();
    }
    return now_s() - stood_since_s_ > kRunWaits_s;
  }

  void end_programs_by_hand() {
    for (ByHand& started : by_hand_) {
      Done& done = observed_.done[started.fault];
      // A console by hand stays as long as it likes.
      if (plan_.faults[started.fault].victim == "console") started.program->signal(SIGTERM);
      done.restarted = started.program->wait(kByHandLimit_s);
      done.said = started.program->err();
    }
    by_hand_.clear();
  }

  void note_what_is_left(const Program& /*lukou*/, const fs::path& temporary, const std::set<std::string>& memory) {
    std::vector<test::RunningProcess> processes;
    const double begin_s = now_s();
    do {
      processes = test::processes_with(mark_);
    } while (!processes.empty() && now_s() - begin_s < kOrphanLimit_s && (pause_s(0.02), true));
    for (const auto& process : processes) {
      observed_.left.push_back("process " + std::to_string(process.pid) + " " + role_of(process.command));
      kill(process.pid, SIGKILL);
    }
    for (const process::ListedRun& listed : process::list_runs())
      if (listed.run == run_) observed_.left.push_back("socket " + process::socket_name(listed));
    for (const std::string& name : shared_memory())
      if (!memory.contains(name) && name.find("lukou") != std::string::npos)
        observed_.left.push_back("/dev/shm/" + name);
    for (const auto& entry : fs::recursive_directory_iterator(temporary))
      observed_.left.push_back("temporary file " + entry.path().filename().string());
    std::error_code none;
    for (const auto& entry : fs::directory_iterator(folder_, none))
      if (entry.path().string().ends_with(".unfinished")) observed_.left.push_back(entry.path().filename().string());
  }

  const Plan& plan_;
  fs::path folder_;
  std::string run_;
  std::string mark_;
  pid_t lukou_ = -1;
  int domain_ = -1;
  double begun_s_ = 0.0;
  Step stood_at_ = -2;
  double stood_since_s_ = 0.0;
  std::unique_ptr<process::RunClient> client_;
  std::vector<std::pair<double, std::size_t>> due_;  ///< when which fault's victim is started again
  std::vector<ByHand> by_hand_;
  Observed observed_;
};

}  // namespace

Observed make_run(const Plan& plan, const fs::path& folder) { return Session(plan, folder).make(); }

}  // namespace lukou::faults
