#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "common/core/expected.hpp"
#include "common/lockstep/edge.hpp"
#include "common/lockstep/messages.hpp"

namespace lukou {

/// What a run does when it loses an RSU.
enum class RsuLossPolicy : std::uint8_t { kAbort, kContinue, kWait };

struct ClockSettings {
  std::string run;
  Incarnation incarnation = 0;
  Incarnation launcher = 0;  ///< who may say, beside the members, that somebody is lost; 0 = nobody
  std::string scenario_text;
  std::string scenario_hash;
  std::uint32_t rsus = 1;
  Step end = 0;  ///< last step
  Step signal_promise = 10;
  double pace = 0.0;          ///< simulated seconds per wall second; 0 = as fast as possible
  bool start_paused = false;  ///< held before step 1
  RsuLossPolicy on_rsu_loss = RsuLossPolicy::kAbort;
  Step credit = 200;              ///< steps that may be granted beyond the recorder's last commit
  bool watchdog = true;           ///< false: no deadline of any kind
  double forming_limit_s = 30;    ///< wall time in which everybody must have joined
  double stall_limit_s = 30;      ///< wall time without any progress
  std::vector<Directive> replay;  ///< directives of an earlier run
  std::optional<Step> stop_at;    ///< and the step at which its operator ended it
  /// Checks a live change against the schema and takes it over into the clock's own copy.
  std::function<Expected<Done>(const std::string& set)> check_change;
};

/// How a run ended.
struct RunOutcome {
  enum class Kind : std::uint8_t { kDone, kStopped, kAnomaly, kLost, kStalled };
  Kind kind = Kind::kDone;
  std::string culprit;  ///< role
  std::string text;
  Step complete_to = -1;
};

/// The clock's decisions, pure: messages and the wall time go in, messages come out. Start, roster, grants, pace,
/// pause, directives, watch and end of a run, as docs/adr/0001-step-protocol.md describes.
class ClockCore {
 public:
  explicit ClockCore(ClockSettings settings);

  /// `now_s`: monotonic wall time [s], any origin.
  void receive(double now_s, const Up& message);
  /// The process with this incarnation is gone without having left.
  void gone(double now_s, Incarnation incarnation);
  /// The run ends unfinished, and nobody on the roster is to be blamed for it: the clock itself, or who started it.
  void fail(const std::string& culprit, const std::string& how);
  /// The clock's own endpoints are matched with everybody on this roster.
  void sees(double now_s, std::uint32_t roster_version);
  /// Pace and deadlines; call at least ten times a second.
  void tick(double now_s);

  /// Messages to send, in order.
  std::vector<Control> take_outbox();
  [[nodiscard]] RunState state() const;
  /// Set once the run is over.
  [[nodiscard]] const std::optional<RunOutcome>& outcome() const { return outcome_; }
  /// True once everybody has left (or can no longer).
  [[nodiscard]] bool all_left() const { return outcome_.has_value() && members_.empty(); }
  [[nodiscard]] std::uint32_t roster_version() const { return roster_version_; }
  /// Incarnations and roles of the current roster, the clock excepted.
  [[nodiscard]] std::vector<std::pair<Incarnation, std::string>> roster() const;

 private:
  struct Member {
    std::string role;
    std::uint32_t epoch = 1;
    std::uint32_t sees = 0;
    Step progress = -1;
    Step first = 0;  ///< its first step; kNever until the grant that attaches it
    std::string waiting_for;
    double heard_s = 0.0;
    bool attached = true;  ///< false: a returning RSU before its attach is granted
  };
  struct RsuLife {
    std::uint32_t epoch = 0;  ///< of the last one that was welcomed
    bool fenced = false;      ///< lost, the engine's receipt outstanding
    bool attach_due = false;
  };

  void join(double now_s, const Up& message);
  void request(double now_s, const Up& message);
  /// Sends an answer to an operator's request.
  Control& reply(const Up& request, bool ok, const std::string& text);
  void add_directives_sent(Control& message) const;
  Expected<std::string> execute(double now_s, const std::string& verb, const std::string& argument);
  Expected<std::string> change(const std::string& set);
  void lost(double now_s, Incarnation incarnation, RunOutcome::Kind kind, const std::string& how);
  void fence(std::uint32_t rsu);
  void publish_roster();
  void start_when_all_see(double now_s);
  void grant(double now_s);
  void watch(double now_s);
  void end(RunOutcome outcome);
  [[nodiscard]] Step budget(double now_s);
  [[nodiscard]] std::vector<std::string> missing_roles() const;
  [[nodiscard]] bool rsu_awaited() const;
  /// The step in which a stalled member stands, as far as anybody has said.
  [[nodiscard]] Step stalled_in(const Member& stalled) const;
  Control& send(Control::Kind kind, Incarnation to = 0);

  ClockSettings settings_;
  std::map<Incarnation, Member> members_;
  std::vector<RsuLife> rsus_;
  std::vector<Control> outbox_;
  /// The last request of each operator, answered.
  struct Answer {
    std::uint64_t number = 0;
    bool ok = true;
    std::string text;
  };
  std::map<Incarnation, Answer> answers_;
  std::uint64_t sequence_ = 0;
  std::uint32_t roster_version_ = 0;
  std::uint32_t clock_sees_ = 0;
  RunPhase phase_ = RunPhase::kForming;
  Step through_ = -1;
  bool last_sent_ = false;
  Step recorded_ = -1;
  Incarnation recorder_ = 0;
  std::map<Incarnation, std::uint64_t> foreign_samples_;  ///< by member, also those who have left
  std::map<Incarnation, double> refused_s_;               ///< who asked in vain, and when it was told so last
  Step hold_at_ = kNever;                                 ///< no grant beyond it: paused there
  bool single_steps_ = false;  ///< `step` asked for the way to it: at once, whatever the pace
  Step end_ = 0;
  std::string stopped_;  ///< why the run ends early: "stopped" or "interrupted"
  std::vector<Directive> directives_;
  std::size_t directives_sent_ = 0;
  double pace_ = 0.0;
  double pace_from_s_ = 0.0;  ///< wall time and step from which the pace counts
  Step pace_from_step_ = 0;
  double started_s_ = -1.0;
  double progress_s_ = 0.0;
  double ticked_s_ = -1.0;
  std::optional<RunOutcome> outcome_;
};

/// The speed words of the paper and numbers: "very-slow" 0.1, "slow" 1, "medium" 10, "fast" 100, "max" 0, or X > 0.
Expected<double> pace_of(const std::string& text);

}  // namespace lukou
