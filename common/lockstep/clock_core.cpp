#include "common/lockstep/clock_core.hpp"

#include <algorithm>
#include <utility>

namespace lukou {
namespace {

constexpr double kRefuseAgain_s = 1.0;

}  // namespace

ClockCore::ClockCore(ClockSettings settings)
    : settings_(std::move(settings)),
      rsus_(settings_.rsus),
      end_(settings_.end),
      directives_(settings_.replay),
      pace_(settings_.pace) {
  if (settings_.start_paused) hold_at_ = 0;
  if (settings_.stop_at && *settings_.stop_at < end_) {
    end_ = *settings_.stop_at;
    stopped_ = "stopped";
  }
}

Control& ClockCore::send(Control::Kind kind, Incarnation to) {
  Control& control = outbox_.emplace_back();
  control.kind = kind;
  control.clock = settings_.incarnation;
  control.sequence = sequence_++;
  control.to = to;
  return control;
}

std::vector<Control> ClockCore::take_outbox() { return std::exchange(outbox_, {}); }

std::vector<std::pair<Incarnation, std::string>> ClockCore::roster() const {
  std::vector<std::pair<Incarnation, std::string>> list;
  for (const auto& [incarnation, member] : members_) list.emplace_back(incarnation, member.role);
  return list;
}

std::vector<std::string> ClockCore::missing_roles() const {
  std::vector<std::string> missing = roles_of_a_run(settings_.rsus);
  for (const auto& [incarnation, member] : members_) std::erase(missing, member.role);
  return missing;
}

void ClockCore::receive(double now_s, const Up& message) {
  if (message.kind == Up::Kind::kJoin) return join(now_s, message);
  if (message.kind == Up::Kind::kRequest) return request(now_s, message);
  if (message.kind == Up::Kind::kLost) {
    const bool may_say = members_.contains(message.incarnation) ||
                         (message.incarnation == settings_.launcher && settings_.launcher != 0);
    if (!may_say) return;
    for (const auto& [incarnation, member] : members_)
      if (member.role == message.role) return lost(now_s, incarnation, RunOutcome::Kind::kLost, message.text);
    // A process that never joined: nobody to fence, the run cannot form.
    if (phase_ == RunPhase::kForming || message.role == kClockRole) fail(message.role, message.text);
    return;
  }
  const auto found = members_.find(message.incarnation);
  if (found == members_.end()) return;
  Member& member = found->second;
  member.heard_s = now_s;
  switch (message.kind) {
    case Up::Kind::kSees:
      member.sees = std::max(member.sees, static_cast<std::uint32_t>(message.number));
      start_when_all_see(now_s);
      break;
    case Up::Kind::kProgress:
      if (message.step > member.progress) progress_s_ = now_s;
      member.progress = std::max(member.progress, message.step);
      member.waiting_for = message.text;
      foreign_samples_[message.incarnation] = message.number;
      break;
    case Up::Kind::kCredit:
      progress_s_ = now_s;
      recorded_ = std::max(recorded_, message.step);
      grant(now_s);
      break;
    case Up::Kind::kReceipt: {
      if (message.number >= rsus_.size()) break;
      rsus_[message.number].fenced = false;
      grant(now_s);
      break;
    }
    case Up::Kind::kClosed:
      recorded_ = std::max(recorded_, message.step);
      if (!outcome_) {
        const auto kind = !message.text.empty() ? RunOutcome::Kind::kAnomaly
                          : !stopped_.empty()   ? RunOutcome::Kind::kStopped
                                                : RunOutcome::Kind::kDone;
        end({kind, "", message.text, message.step});
      }
      break;
    case Up::Kind::kLeave:
      foreign_samples_[message.incarnation] = message.number;
      // Before the end it is a loss like any other: the others must not wait for it.
      lost(now_s, message.incarnation, RunOutcome::Kind::kLost, "left before the end of the run");
      break;
    case Up::Kind::kJoin:
    case Up::Kind::kRequest:
    case Up::Kind::kLost:
      break;
  }
}

void ClockCore::join(double now_s, const Up& message) {
  if (members_.contains(message.incarnation) || outcome_) return;
  const auto refuse = [&](const std::string& why) {
    // Everybody reads what is said to one: who asks without end is not answered without end.
    const auto before = refused_s_.find(message.incarnation);
    if (before != refused_s_.end() && now_s - before->second < kRefuseAgain_s) return;
    refused_s_[message.incarnation] = now_s;
    send(Control::Kind::kRefuse, message.incarnation).text = why;
  };
  if (message.protocol != kProtocolVersion) {
    return refuse("speaks protocol version " + std::to_string(message.protocol) + ", the run speaks " +
                  std::to_string(kProtocolVersion));
  }
  if (!message.hash.empty() && message.hash != settings_.scenario_hash) {
    return refuse("was started for the scenario with hash " + message.hash + ", the run's is " +
                  settings_.scenario_hash);
  }
  const auto missing = missing_roles();
  if (std::ranges::find(missing, message.role) == missing.end()) {
    return refuse("role `" + message.role +
                  "` is unknown or taken; vacant: " + (missing.empty() ? std::string("none") : missing.front()));
  }
  const int rsu = rsu_index(message.role);
  if (rsu >= 0 && rsus_[static_cast<std::size_t>(rsu)].fenced) return;  // it asks again; receipts come first
  Member member{.role = message.role, .heard_s = now_s};
  if (rsu >= 0) {
    RsuLife& life = rsus_[static_cast<std::size_t>(rsu)];
    member.epoch = ++life.epoch;
    life.attach_due = phase_ != RunPhase::kForming;
    member.attached = !life.attach_due;
    if (life.attach_due) member.first = kNever;
  }
  Control& welcome = send(Control::Kind::kWelcome, message.incarnation);
  welcome.epoch = member.epoch;
  welcome.text = settings_.scenario_text;
  add_directives_sent(welcome);
  if (message.role == kRecorderRole) recorder_ = message.incarnation;
  members_.emplace(message.incarnation, std::move(member));
  progress_s_ = now_s;
  if (missing_roles().empty() || phase_ != RunPhase::kForming) publish_roster();
}

void ClockCore::add_directives_sent(Control& message) const {
  for (std::size_t i = 0; i < directives_sent_; ++i) {
    message.directive_step.push_back(directives_[i].step);
    message.directive_set.push_back(directives_[i].set);
  }
}

void ClockCore::publish_roster() {
  Control& roster = send(Control::Kind::kRoster);
  roster.roster_version = ++roster_version_;
  roster.roster_incarnation.push_back(settings_.incarnation);
  roster.roster_role.emplace_back(kClockRole);
  for (const auto& [incarnation, member] : members_) {
    roster.roster_incarnation.push_back(incarnation);
    roster.roster_role.push_back(member.role);
  }
}

void ClockCore::sees(double now_s, std::uint32_t roster_version) {
  clock_sees_ = std::max(clock_sees_, roster_version);
  start_when_all_see(now_s);
}

void ClockCore::start_when_all_see(double now_s) {
  if (roster_version_ == 0 || clock_sees_ < roster_version_ || outcome_) return;
  for (const auto& [incarnation, member] : members_)
    if (member.sees < roster_version_) return;
  if (phase_ == RunPhase::kForming) {
    phase_ = RunPhase::kRunning;
    pace_from_s_ = now_s;
    pace_from_step_ = 0;
  }
  for (auto& [incarnation, member] : members_) member.attached = true;
  progress_s_ = now_s;
  grant(now_s);
}

bool ClockCore::rsu_awaited() const {
  if (settings_.on_rsu_loss != RsuLossPolicy::kWait) return false;
  for (const RsuLife& life : rsus_)
    if (life.fenced || life.attach_due) return true;
  return !missing_roles().empty();
}

Step ClockCore::budget(double now_s) {
  Step through = std::min({end_, hold_at_, recorded_ + settings_.credit});
  if (pace_ > 0.0 && !single_steps_) {
    const double elapsed_s = now_s - pace_from_s_;
    const Step paced = pace_from_step_ + static_cast<Step>(elapsed_s * pace_ * static_cast<double>(kStepsPerSecond));
    // A run that cannot keep the pace does not catch up later.
    const Step behind =
        std::max<Step>(settings_.credit, static_cast<Step>(pace_ * static_cast<double>(kStepsPerSecond)));
    if (paced > through_ + behind) {
      pace_from_s_ = now_s;
      pace_from_step_ = through_;
    }
    through = std::min(through, std::max<Step>(paced, 0));
  }
  return through;
}

void ClockCore::grant(double now_s) {
  if (phase_ != RunPhase::kRunning && phase_ != RunPhase::kPaused) return;
  const bool all_attached = std::ranges::all_of(members_, [](const auto& m) { return m.second.attached; });
  const bool waits = rsu_awaited() && !(all_attached && missing_roles().empty());
  const Step through = waits ? through_ : std::max(budget(now_s), through_);
  const bool last = through >= end_;
  if (waits && !last) return;  // nobody comes back to a run that is to end here
  const bool news = through > through_ || (last && !last_sent_);
  phase_ = through >= hold_at_ && !last ? RunPhase::kPaused : RunPhase::kRunning;
  if (!news) return;
  Control& grant = send(Control::Kind::kGrant);
  grant.through = through;
  grant.last = last;
  if (last) grant.text = stopped_;
  for (; directives_sent_ < directives_.size(); ++directives_sent_) {
    grant.directive_step.push_back(directives_[directives_sent_].step);
    grant.directive_set.push_back(directives_[directives_sent_].set);
  }
  for (auto& [incarnation, member] : members_) {
    const int rsu = rsu_index(member.role);
    if (rsu < 0 || !member.attached || !rsus_[static_cast<std::size_t>(rsu)].attach_due) continue;
    rsus_[static_cast<std::size_t>(rsu)].attach_due = false;
    grant.attach_rsu.push_back(static_cast<std::uint32_t>(rsu));
    grant.attach_epoch.push_back(member.epoch);
    // All that its first step needs is published after it could be heard.
    const EdgeTiming signal = signal_timing(settings_.signal_promise);
    member.first = through_ + 1 + signal.delay + signal.stride;
    grant.attach_from.push_back(member.first);
  }
  through_ = through;
  if (last) {
    last_sent_ = true;
    phase_ = RunPhase::kEnding;
  }
}

void ClockCore::gone(double now_s, Incarnation incarnation) {
  answers_.erase(incarnation);
  refused_s_.erase(incarnation);
  // Under a debugger a process stands still for minutes: only the launcher's word counts then.
  if (members_.contains(incarnation) && settings_.watchdog) {
    lost(now_s, incarnation, RunOutcome::Kind::kLost, "is gone: its process ended, stands still or cannot be reached");
  }
}

void ClockCore::lost(double now_s, Incarnation incarnation, RunOutcome::Kind kind, const std::string& how) {
  const Member member = members_.at(incarnation);
  members_.erase(incarnation);
  if (outcome_) return;
  const int rsu = rsu_index(member.role);
  if (rsu >= 0 && settings_.on_rsu_loss != RsuLossPolicy::kAbort && phase_ != RunPhase::kForming) {
    fence(static_cast<std::uint32_t>(rsu));
    progress_s_ = now_s;
    return;
  }
  end({kind, member.role, how, recorded_});
}

void ClockCore::fence(std::uint32_t rsu) {
  RsuLife& life = rsus_[rsu];
  life.fenced = true;
  life.attach_due = false;
  Control& fence = send(Control::Kind::kFence);
  fence.rsu = rsu;
  fence.epoch = life.epoch;
}

void ClockCore::fail(const std::string& culprit, const std::string& how) {
  if (!outcome_) end({RunOutcome::Kind::kLost, culprit, how, recorded_});
}

void ClockCore::end(RunOutcome outcome) {
  outcome_ = std::move(outcome);
  const bool aborted = outcome_->kind == RunOutcome::Kind::kLost || outcome_->kind == RunOutcome::Kind::kStalled;
  phase_ = aborted ? RunPhase::kAborted : RunPhase::kEnded;
  Control& last = send(aborted ? Control::Kind::kAbort : Control::Kind::kEnded);
  last.text = outcome_->text;
  last.culprit = outcome_->culprit;
}

void ClockCore::tick(double now_s) {
  if (started_s_ < 0.0) started_s_ = progress_s_ = ticked_s_ = now_s;
  // A stopped host (Ctrl-Z, a suspended laptop) makes every deadline look missed: start them again.
  if (now_s - ticked_s_ > 1.0) {
    started_s_ += now_s - ticked_s_;
    progress_s_ = now_s;
  }
  ticked_s_ = now_s;
  grant(now_s);
  watch(now_s);
}

void ClockCore::watch(double now_s) {
  if (!settings_.watchdog || outcome_) return;
  if (phase_ == RunPhase::kForming) {
    if (now_s - started_s_ < settings_.forming_limit_s) return;
    const auto missing = missing_roles();
    const std::string who = missing.empty() ? "everybody joined, but not all see each other" : missing.front();
    end({RunOutcome::Kind::kLost, missing.empty() ? std::string(kClockRole) : missing.front(),
         "did not join within " + std::to_string(static_cast<int>(settings_.forming_limit_s)) + " s (missing: " + who +
             ")",
         recorded_});
    return;
  }
  // Nothing is due while the run is held or waits for the wall clock.
  const bool all_done = std::ranges::all_of(
      members_, [&](const auto& m) { return m.second.progress >= through_ || m.second.first > through_; });
  if (all_done && phase_ != RunPhase::kEnding) {
    progress_s_ = now_s;
    return;
  }
  if (now_s - progress_s_ < settings_.stall_limit_s) return;
  // All stand still; the culprit is whoever waits for nobody. Who waits says so again and again: who is silent
  // computes.
  for (const auto& [incarnation, member] : members_) {
    if (member.first > through_) continue;
    const bool silent = now_s - member.heard_s >= settings_.stall_limit_s / 2;
    if (!member.waiting_for.empty() && !silent) continue;
    return lost(now_s, incarnation, RunOutcome::Kind::kStalled,
                "has not finished step " + std::to_string(stalled_in(member)) + " for " +
                    std::to_string(static_cast<int>(now_s - progress_s_)) + " s");
  }
  end({RunOutcome::Kind::kStalled, std::string(kClockRole), "no participant makes progress and none says why",
       recorded_});
}

Step ClockCore::stalled_in(const Member& stalled) const {
  // It says how far it is only while it waits; those who wait for it know better. Of an RSU they need the step before.
  const Step delay = rsu_index(stalled.role) >= 0 ? kStepBefore.delay : kSameStep.delay;
  Step step = std::max(stalled.progress + 1, stalled.first);
  for (const auto& [incarnation, member] : members_) {
    if (member.waiting_for == stalled.role && stalled.role != kControllerRole) {
      step = std::max(step, member.progress + 1 - delay);
    }
  }
  return step;
}

RunState ClockCore::state() const {
  RunState state{
      .run = settings_.run, .phase = phase_, .granted = through_, .recorded = recorded_, .end = end_, .pace = pace_};
  if (phase_ == RunPhase::kForming) {
    for (const std::string& role : missing_roles()) state.text += (state.text.empty() ? "" : " ") + role;
  }
  if (outcome_) {
    state.text = outcome_->text;
    state.culprit = outcome_->culprit;
  }
  state.recorder = recorder_;
  for (const auto& [incarnation, samples] : foreign_samples_) state.foreign_samples += samples;
  return state;
}

}  // namespace lukou
