#include <csignal>
#include <deque>
#include <set>
#include <utility>

#include "common/process/environment.hpp"
#include "common/scenario/scenario_steps.hpp"
#include "services/lukou/launch/child.hpp"
#include "services/lukou/launch/domain_claim.hpp"
#include "services/lukou/launch/rsu_child.hpp"
#include "services/lukou/redrive/redrive.hpp"
#include "services/lukou/redrive/stage.hpp"

namespace lukou::redrive {
namespace {

constexpr double kPoll_s = 0.02;
constexpr Step kAhead = 100;  ///< steps that may be under way
constexpr double kLeave_s = 3.0;

/// Step that has been played and not been answered by everybody.
struct Pending {
  TapeStep recorded;
  std::map<std::uint32_t, Answer> answers;
};

class Performance {
 public:
  Performance(Tape& tape, Stage& stage, const std::map<std::uint32_t, std::string>& commands, Comparison& comparison)
      : tape_(tape), stage_(stage), commands_(commands), comparison_(comparison) {}

  /// Plays what may be played.
  Expected<Done> play() {
    while (next_ <= tape_.last() && next_ <= stage_.through() && next_ - compared_ <= kAhead) {
      const auto taken = tape_.next();
      if (!taken) return taken.error();
      TapeStep& got = *taken.value();
      stage_.play(got.air, got.signal ? &*got.signal : nullptr);
      pending_.push_back({std::move(got), {}});
      ++next_;
    }
    return Done{};
  }

  Expected<Done> hear(const Listener& listener) {
    for (RoadsideBatch& batch : stage_.take_answers()) {
      const std::string role = rsu_role(batch.rsu);
      if (!commands_.contains(batch.rsu)) return Error{role, "answers, but no program plays it here"};
      const Step place = batch.step - compared_ - 1;
      if (place < 0 || place >= static_cast<Step>(pending_.size())) {
        return Error{role, "answers step " + std::to_string(batch.step) + ", which was not asked"};
      }
      pending_[static_cast<std::size_t>(place)].answers[batch.rsu] = {
          std::move(batch.frames), std::move(batch.request_lanes), std::move(batch.request_lifetime)};
    }
    while (!pending_.empty() && pending_.front().answers.size() == commands_.size()) {
      const Pending& step = pending_.front();
      for (const auto& [rsu, answer] : step.answers) comparison_.add(step.recorded, rsu, answer);
      pending_.pop_front();
      stage_.compared(++compared_);
      listener(compared_);
    }
    return Done{};
  }

  [[nodiscard]] bool over() const { return compared_ == tape_.last(); }

 private:
  Tape& tape_;
  Stage& stage_;
  const std::map<std::uint32_t, std::string>& commands_;
  Comparison& comparison_;
  std::deque<Pending> pending_;
  Step next_ = 0;
  Step compared_ = -1;
};

ClockSettings settings_of(const scenario::Resolved& scenario, const std::string& run, Step end) {
  const scenario::Protocol protocol = scenario::protocol(scenario);
  return {.run = run,
          .scenario_text = scenario::text(scenario),
          .scenario_hash = scenario::hash(scenario),
          .rsus = protocol.rsus,
          .end = end,
          .signal_promise = protocol.signal_promise};
}

/// Ends the programs: they leave by themselves, or are made to.
void dismiss(Stage& stage, launch::Children& children) {
  for (const int signal : {0, SIGTERM, SIGKILL}) {
    if (signal != 0) children.signal_all(signal);
    const double until_s = process::wall_s() + kLeave_s;
    while (!children.empty() && process::wall_s() < until_s) {
      stage.serve(kPoll_s);
      children.reap();
    }
  }
}

}  // namespace

Expected<Done> as_processes(Tape& tape, const scenario::Resolved& scenario,
                            const std::map<std::uint32_t, std::string>& commands, Comparison& comparison,
                            const Listener& listener) {
  const std::string run = "redrive-" + std::to_string(process::new_incarnation() % 100'000);
  auto claim = launch::DomainClaim::lowest_free({.run = run});
  if (!claim) return claim.error();
  const bus::Address address{.domain = claim.value().domain(), .run = run};
  ClockSettings settings = settings_of(scenario, run, tape.last());
  auto changes = tape.directives();
  if (!changes) return changes.error();
  settings.replay = std::move(changes).value();
  std::set<std::uint32_t> absent;
  for (std::uint32_t rsu = 0; rsu < settings.rsus; ++rsu)
    if (!commands.contains(rsu)) absent.insert(rsu);
  auto stage = Stage::open(address, std::move(settings), scenario::is_actuated(scenario), absent);
  if (!stage) return stage.error();
  launch::Children children;
  const std::vector<std::string> environment = {"LUKOU_RUN=" + run, "LUKOU_DOMAIN=" + std::to_string(address.domain)};
  for (const auto& [rsu, command] : commands) {
    if (auto started = children.start(launch::rsu_child(rsu, command, environment)); !started) return started;
  }
  Performance performance(tape, *stage.value(), commands, comparison);
  Expected<Done> result = Done{};
  while (result && !performance.over() && !stage.value()->outcome() && process::stop_signal() == 0) {
    stage.value()->serve(kPoll_s);
    result = performance.play();
    if (result) result = performance.hear(listener);
    for (const launch::ChildExit& ended : children.reap()) stage.value()->lost(ended.role, ended.text());
  }
  if (result && performance.over()) stage.value()->close(tape.last());
  const auto outcome = stage.value()->outcome();
  dismiss(*stage.value(), children);
  if (!result) return result;
  if (process::stop_signal() != 0) return Error{"", "interrupted"};
  if (!performance.over() && outcome) return Error{outcome->culprit, outcome->text};
  return Done{};
}

}  // namespace lukou::redrive
