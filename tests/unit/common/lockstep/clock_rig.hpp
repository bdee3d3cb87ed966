#pragma once

#include <gtest/gtest.h>

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/lockstep/clock_core.hpp"

namespace lukou {

inline constexpr Incarnation kClock = 1;
inline constexpr Incarnation kEngine = 10;
inline constexpr Incarnation kController = 11;
inline constexpr Incarnation kRecorder = 12;
inline constexpr Incarnation kRsu = 20;
inline constexpr Incarnation kOperator = 90;
inline constexpr Incarnation kLauncher = 91;

/// A clock with the members' side of the talk. Wall time is `now_s`; nothing happens but what a test does.
class ClockRig {
 public:
  static ClockSettings usual() {
    ClockSettings settings;
    settings.run = "paper-1";
    settings.incarnation = kClock;
    settings.launcher = kLauncher;
    settings.scenario_text = "run { }";
    settings.scenario_hash = "abc123";
    settings.rsus = 1;
    settings.end = 1000;
    settings.check_change = [](const std::string& set) -> Expected<Done> {
      if (set.starts_with("good")) return Done{};
      return Error{set, "cannot change while a run goes on"};
    };
    return settings;
  }

  explicit ClockRig(ClockSettings settings = usual()) : core(std::move(settings)) { core.tick(now_s); }

  /// Everything sent since the last call; the sequence is checked.
  std::vector<Control> heard() {
    auto out = core.take_outbox();
    for (const Control& control : out) {
      EXPECT_EQ(control.sequence, sequence_++);
      EXPECT_EQ(control.clock, kClock);
    }
    return out;
  }
  /// Those of one kind.
  std::vector<Control> heard(Control::Kind kind) {
    auto out = heard();
    std::erase_if(out, [kind](const Control& control) { return control.kind != kind; });
    return out;
  }
  /// The one message of a kind; a test that expects it ends here if there is none.
  Control the(Control::Kind kind) {
    auto out = heard(kind);
    EXPECT_EQ(out.size(), 1U);
    return out.empty() ? Control{} : out.front();
  }

  void up(Up message) { core.receive(now_s, message); }
  void join(Incarnation incarnation, const std::string& role) {
    up({.kind = Up::Kind::kJoin, .incarnation = incarnation, .role = role});
  }
  void sees(Incarnation incarnation) {
    up({.kind = Up::Kind::kSees, .incarnation = incarnation, .number = core.roster_version()});
  }
  void everybody_joins() {
    join(kEngine, "traffic-engine");
    join(kController, "signal-controller");
    join(kRecorder, "recorder");
    join(kRsu, "rsu0");
  }
  void everybody_sees() {
    for (const auto& [incarnation, role] : core.roster()) sees(incarnation);
    core.sees(now_s, core.roster_version());
  }
  /// From nothing to the first grant, which stays to be heard.
  void form() {
    everybody_joins();
    static_cast<void>(heard());
    everybody_sees();
  }
  void credit(Step step) { up({.kind = Up::Kind::kCredit, .incarnation = kRecorder, .step = step}); }
  void progress(Incarnation incarnation, Step step, const std::string& waits_for) {
    up({.kind = Up::Kind::kProgress, .incarnation = incarnation, .step = step, .text = waits_for});
  }
  /// All members have executed a step, the recorder has committed it, and they wait for the clock.
  void all_did(Step step) {
    for (const auto& [incarnation, role] : core.roster()) progress(incarnation, step, "clock");
    credit(step);
  }
  void close(const std::string& anomaly = "", Step complete_to = 1000) {
    up({.kind = Up::Kind::kClosed, .incarnation = kRecorder, .step = complete_to, .text = anomaly});
  }
  /// Wall time goes on, in ticks of a tenth of a second, without a message from anybody.
  void idle(double duration_s) {
    for (int n = 0; n < static_cast<int>(duration_s * 10.0 + 0.5); ++n) {
      now_s += 0.1;
      core.tick(now_s);
    }
  }
  /// Asks as the operator does; returns the answer, with "refused: " before it if the clock said no.
  std::string ask(const std::string& text) {
    up({.kind = Up::Kind::kRequest, .incarnation = kOperator, .text = text});
    std::string answer = "no answer";
    for (const Control& control : heard()) {
      if (control.kind == Control::Kind::kReply) {
        EXPECT_EQ(control.to, kOperator);
        answer = (control.ok ? "" : "refused: ") + control.text;
      } else {
        others.push_back(control);
      }
    }
    return answer;
  }
  [[nodiscard]] Step granted() const { return core.state().granted; }
  [[nodiscard]] RunPhase phase() const { return core.state().phase; }
  [[nodiscard]] std::string culprit() const { return core.outcome() ? core.outcome()->culprit : "none"; }

  double now_s = 1000.0;
  ClockCore core;
  std::vector<Control> others;  ///< what came beside the answers to ask()

 private:
  std::uint64_t sequence_ = 0;
};

}  // namespace lukou
