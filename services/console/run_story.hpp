#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "common/core/directive.hpp"
#include "common/core/expected.hpp"
#include "common/intersection/plan_schedule.hpp"
#include "common/scenario/scenario.hpp"

namespace lukou::console {

class Hello;
class SignalProgram;

/// What a run is: its scenario, and what operators have changed in it so far.
class RunStory {
 public:
  /// `recorded_to`: the last step of a recording, whose time may go back; none: a run that goes on. Errors: a text that
  /// is no resolved scenario.
  static Expected<RunStory> of(const std::string& run, const std::string& scenario_text,
                               std::optional<Step> recorded_to = std::nullopt);

  /// Takes over an accepted change, in the order of the steps.
  void change(const Directive& directive);
  /// The signal plan that the heads follow at a step, and a step at which one of its cycles starts. Of a run, plans
  /// that ended before are forgotten.
  struct Program {
    const PlanSchedule::Running* running = nullptr;
    Step cycle_start = 0;
  };
  Program program_at(Step step);

  [[nodiscard]] const std::string& run() const { return run_; }
  [[nodiscard]] const scenario::Resolved& scenario() const { return scenario_; }
  [[nodiscard]] std::optional<Step> recorded_to() const { return recorded_to_; }
  /// All that does not change while the run goes on, and the values that do as they are now.
  [[nodiscard]] Hello hello() const;

 private:
  RunStory(std::string run, scenario::Resolved scenario, std::string text, SignalPlan plan,
           std::optional<Step> recorded_to);

  std::string run_;
  scenario::Resolved scenario_;
  std::string text_;
  std::map<std::string, std::string> initial_;  ///< live values before all changes, by path
  SignalPlan latest_;
  PlanSchedule plans_;
  Step promise_;
  std::optional<Step> recorded_to_;
};

SignalProgram message_of(const SignalPlan& plan, Step offset);

}  // namespace lukou::console
