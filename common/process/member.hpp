#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "common/bus/participant.hpp"
#include "common/core/expected.hpp"
#include "common/lockstep/edge.hpp"
#include "common/lockstep/messages.hpp"
#include "common/process/fellows.hpp"

namespace lukou::process {

/// How the run ended for a member.
struct MemberEnd {
  enum class Kind : std::uint8_t { kEnded, kAborted, kClockLost, kTerminated, kFenced };
  Kind kind = Kind::kEnded;
  std::string culprit;  ///< kAborted: role
  std::string text;

  [[nodiscard]] int exit_code() const;
};

/// A process's part in the step protocol: joins, answers the roster, keeps the grants and the directives, reports
/// progress, notices the clock's death. The process itself owns its lockstep readers, writers and edges.
class Member {
 public:
  struct Settings {
    std::string role;
    bus::Address address;
    bool watchdog = true;
    double join_limit_s = 10.0;
  };
  /// Errors: DDS cannot start.
  static Expected<std::unique_ptr<Member>> create(Settings settings);

  [[nodiscard]] bus::Participant& participant() { return *participant_; }

  /// Declares an endpoint of this process, before join() or between join() and the first step: the start waits until it
  /// is matched with everybody on the roster who faces it.
  template <class Batch>
  void faces(Topic topic, const bus::Writer<Batch>& writer) {
    endpoints_.push_back({topic, true, [&writer] { return writer.matched(); }});
  }
  /// A reader hands over, from then on, only what members say whose topic it is; one that sends what is broken is lost.
  template <class Batch>
  void faces(Topic topic, bus::Reader<Batch>& reader) {
    endpoints_.push_back({topic, false, [&reader] { return reader.matched(); }});
    reader.believe([this, topic](Incarnation who) { return fellows_.belief(topic, who); });
    reader.on_flaw([this](Incarnation who, const std::string& flaw) { distrust(who, flaw); });
  }

  /// Role of a process that takes part; empty if it does not.
  [[nodiscard]] std::string role_of(Incarnation incarnation) const { return fellows_.role_of(incarnation); }
  /// What this member sends is of no use: the clock is told, and decides what becomes of the run.
  void distrust(Incarnation incarnation, const std::string& what);

  /// Asks to take part until the clock welcomes this process. Returns the resolved scenario.
  /// Errors: refused (both values), or no clock within the limit (domain, run).
  Expected<std::string> join();

  [[nodiscard]] std::uint32_t epoch() const { return epoch_; }
  /// The step this process begins with; known at once for epoch 1, for a returning RSU with the grant that attaches it.
  [[nodiscard]] std::optional<Step> first_step() const { return first_step_; }
  [[nodiscard]] bool granted(Step step) const { return step <= through_; }
  /// The last step of the run, once the clock has said so.
  [[nodiscard]] std::optional<Step> last_step() const { return last_; }
  /// Why the last step came before the planned end: "", "stopped" or "interrupted".
  [[nodiscard]] const std::string& stopped() const { return stopped_; }
  /// Directives that take effect with `step`, in their order (and, the first time, all before it).
  std::vector<Directive> due(Step step);
  [[nodiscard]] const std::vector<Directive>& directives() const { return directives_; }

  /// Called with (rsu, epoch) when an RSU is lost; returns the first step not heard of it.
  void on_fence(std::function<Step(std::uint32_t, std::uint32_t)> action) { fence_ = std::move(action); }
  /// Called with (rsu, epoch, from) when an RSU takes part again.
  void on_attach(std::function<void(std::uint32_t, std::uint32_t, Step)> action) { attach_ = std::move(action); }

  /// True until the clock ends the run or is lost, or a signal ends this process.
  [[nodiscard]] bool running() const { return !end_.has_value(); }
  [[nodiscard]] const MemberEnd& end() const { return *end_; }

  /// Looks at the control stream without waiting; call once a step.
  void poll();
  void executed(Step step) { progress_ = step; }
  /// Waits for news (at most 100 ms), saying for whom: "" = nobody.
  void wait(const std::string& for_whom);
  void send(Up message);
  /// Ends this process's part from inside: the clock is told whose fault that is, and why.
  void finish(MemberEnd end);
  void leave();

 private:
  struct Endpoint {
    Topic topic;
    bool writer;
    std::function<std::set<Incarnation>()> matched;
  };

  Member(Settings settings, std::unique_ptr<bus::Participant> participant);
  void receive(const Control& control);
  void welcome(const Control& control);
  void check_roster();
  void heartbeat();
  /// Tells the clock that a member, perhaps this one, cannot go on.
  void accuse(const std::string& culprit, const std::string& what);
  /// Says in the log what strangers have begun to send.
  void tell_foreign();

  Settings settings_;
  std::unique_ptr<bus::Participant> participant_;
  bus::Reader<Control> control_;
  bus::Writer<Up> up_;
  std::vector<Endpoint> endpoints_;
  std::function<Step(std::uint32_t, std::uint32_t)> fence_;
  std::function<void(std::uint32_t, std::uint32_t, Step)> attach_;

  std::optional<std::string> scenario_;
  std::optional<Error> refused_;
  Incarnation clock_ = 0;
  std::optional<std::uint64_t> sequence_;
  std::uint32_t epoch_ = 0;
  std::optional<Step> first_step_;
  Step through_ = -1;
  std::optional<Step> last_;
  std::string stopped_;
  std::vector<Directive> directives_;
  std::size_t directives_due_ = 0;
  Fellows fellows_;
  std::set<std::string> told_foreign_;  ///< topics of which the log has been told
  std::uint32_t roster_version_ = 0;
  bool roster_open_ = false;
  bool joined_ = false;  ///< every endpoint is declared: the roster may be answered
  Step progress_ = -1;
  std::string waiting_for_;
  double heartbeat_s_ = 0.0;
  std::optional<MemberEnd> end_;
  bool told_by_clock_ = false;  ///< how it ends; otherwise the clock may not know
};

}  // namespace lukou::process
