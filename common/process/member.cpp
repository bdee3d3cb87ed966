#include "common/process/member.hpp"

#include <utility>

#include "common/process/environment.hpp"
#include "common/process/log.hpp"
#include "common/process/run_list.hpp"

namespace lukou::process {
namespace {

constexpr double kWait_s = 0.1;
constexpr double kHeartbeat_s = 0.2;
constexpr double kJoinAgain_s = 0.05;

}  // namespace

int MemberEnd::exit_code() const {
  switch (kind) {
    case Kind::kEnded:
      return kExitDone;
    case Kind::kAborted:
    case Kind::kClockLost:
    case Kind::kFenced:
      return kExitAborted;
    case Kind::kTerminated:
      return kExitTerminated;
  }
  return kExitInternal;
}

Expected<std::unique_ptr<Member>> Member::create(Settings settings) {
  auto participant = bus::Participant::join(settings.address, settings.role, new_incarnation());
  if (!participant) return participant.error();
  return std::unique_ptr<Member>(new Member(std::move(settings), std::move(participant).value()));
}

Member::Member(Settings settings, std::unique_ptr<bus::Participant> participant)
    : settings_(std::move(settings)),
      participant_(std::move(participant)),
      control_(*participant_),
      up_(*participant_),
      clock_(clock_of(settings_.address)) {
  faces(Topic::kControl, control_);
  faces(Topic::kUp, up_);
  control_.believe(
      [this](Incarnation who) { return clock_ == 0 || clock_ == who ? bus::Belief::kYes : bus::Belief::kForeign; });
  control_.on_flaw([this](Incarnation, const std::string& flaw) {
    finish({MemberEnd::Kind::kAborted, std::string(kClockRole), flaw});
  });
  participant_->keep_writing_while([this] {
    poll();
    return running();
  });
}

void Member::send(Up message) {
  message.incarnation = participant_->self();
  message.role = settings_.role;
  up_.write(message);
}

Expected<std::string> Member::join() {
  const double begin_s = wall_s();
  double asked_s = begin_s - 1.0;
  while (!scenario_ && !refused_ && running()) {
    if (wall_s() - asked_s >= kJoinAgain_s) {
      asked_s = wall_s();
      send({.kind = Up::Kind::kJoin});
    }
    participant_->wait(kJoinAgain_s / 5);
    poll();
    if (settings_.watchdog && wall_s() - begin_s > settings_.join_limit_s) {
      return Error{"run " + settings_.address.run, "no clock answers in DDS domain " +
                                                       std::to_string(settings_.address.domain) + " under the tag " +
                                                       settings_.address.tag() + "; `lukou ctl list` names the runs"};
    }
  }
  if (refused_) return *refused_;
  if (!scenario_) {
    return Error{"run " + settings_.address.run,
                 "ended before this process could join" + (end_ && !end_->text.empty() ? ": " + end_->text : "")};
  }
  joined_ = true;
  return *scenario_;
}

void Member::poll() {
  control_.take([this](Control& control, const bus::SampleInfo& info) {
    if (info.alive) return receive(control);
    if (info.producer == clock_ && running() && settings_.watchdog) {
      end_ = MemberEnd{MemberEnd::Kind::kClockLost, std::string(kClockRole), "the clock is gone"};
    }
  });
  if (roster_open_ && joined_) check_roster();
  if (stop_signal() != 0 && running()) {
    end_ = stop_signal() == clock_died_signal()
               ? MemberEnd{MemberEnd::Kind::kClockLost, std::string(kClockRole), "the clock is gone"}
               : MemberEnd{MemberEnd::Kind::kTerminated, "", "ended by a signal"};
  }
}

void Member::receive(const Control& control) {
  const bool to_me = control.to == participant_->self();
  // Before it is welcomed the clock may not have matched it yet: what is lost then was said to others.
  if (scenario_ && sequence_ && control.sequence != *sequence_ + 1) {
    end_ = MemberEnd{MemberEnd::Kind::kAborted, settings_.role,
                     "lost a control message (expected number " + std::to_string(*sequence_ + 1) + ", got " +
                         std::to_string(control.sequence) + ")"};
    return;
  }
  sequence_ = control.sequence;
  if (control.to != 0 && !to_me) return;
  switch (control.kind) {
    case Control::Kind::kWelcome:
      return welcome(control);
    case Control::Kind::kRefuse:
      refused_ = Error{"run " + settings_.address.run, "refused: " + control.text};
      return;
    case Control::Kind::kReply:
      return;
    default:
      break;
  }
  if (!scenario_) return;  // what is said to others before this process takes part
  switch (control.kind) {
    case Control::Kind::kRoster: {
      Fellows::Roster roster;
      for (std::size_t i = 0; i < control.roster_incarnation.size(); ++i)
        roster[control.roster_incarnation[i]] = control.roster_role[i];
      fellows_.take(roster);
      roster_version_ = control.roster_version;
      roster_open_ = true;
      break;
    }
    case Control::Kind::kGrant:
      for (std::size_t i = 0; i < control.directive_step.size(); ++i)
        directives_.push_back({control.directive_step[i], control.directive_set[i]});
      for (std::size_t i = 0; i < control.attach_rsu.size(); ++i) {
        if (rsu_role(control.attach_rsu[i]) == settings_.role && control.attach_epoch[i] == epoch_) {
          first_step_ = control.attach_from[i];
        } else if (attach_) {
          attach_(control.attach_rsu[i], control.attach_epoch[i], control.attach_from[i]);
        }
      }
      through_ = control.through;
      if (control.last) {
        last_ = control.through;
        stopped_ = control.text;
      }
      break;
    case Control::Kind::kFence:
      fellows_.fence(rsu_role(control.rsu));
      if (rsu_role(control.rsu) == settings_.role && control.epoch == epoch_) {
        end_ = MemberEnd{MemberEnd::Kind::kFenced, settings_.role, "the run goes on without this process"};
      } else if (fence_) {
        send({.kind = Up::Kind::kReceipt, .number = control.rsu, .step = fence_(control.rsu, control.epoch)});
      }
      break;
    case Control::Kind::kEnded:
      end_ = MemberEnd{MemberEnd::Kind::kEnded, "", control.text};
      told_by_clock_ = true;
      break;
    case Control::Kind::kAbort:
      end_ = MemberEnd{MemberEnd::Kind::kAborted, control.culprit, control.text};
      told_by_clock_ = true;
      break;
    default:
      break;
  }
}

void Member::welcome(const Control& control) {
  // Where nobody has said who the clock is, there must be one only.
  if (clock_ == 0 && control_.matched().size() > 1) {
    refused_ = Error{"run " + settings_.address.run,
                     "topic lukou/control has several writers; one of them is a stranger, and which cannot be told"};
    return;
  }
  clock_ = control.clock;
  scenario_ = control.text;
  epoch_ = control.epoch;
  if (epoch_ == 1) first_step_ = 0;
  for (std::size_t i = 0; i < control.directive_step.size(); ++i)
    directives_.push_back({control.directive_step[i], control.directive_set[i]});
}

void Member::check_roster() {
  for (const Endpoint& endpoint : endpoints_) {
    const auto matched = endpoint.matched();
    for (const auto& [incarnation, role] : fellows_.roster()) {
      const bool faces = endpoint.writer ? reads(role, endpoint.topic) : writes(role, endpoint.topic);
      if (faces && incarnation != participant_->self() && !matched.contains(incarnation)) return;
    }
  }
  roster_open_ = false;
  send({.kind = Up::Kind::kSees, .number = roster_version_});
}

std::vector<Directive> Member::due(Step step) {
  std::vector<Directive> now;
  while (directives_due_ < directives_.size() && directives_[directives_due_].step <= step)
    now.push_back(directives_[directives_due_++]);
  return now;
}

void Member::heartbeat() {
  const double now_s = wall_s();
  if (now_s - heartbeat_s_ < kHeartbeat_s) return;
  heartbeat_s_ = now_s;
  tell_foreign();
  send({.kind = Up::Kind::kProgress,
        .number = participant_->foreign_samples(),
        .step = progress_,
        .text = waiting_for_});
}

void Member::wait(const std::string& for_whom) {
  waiting_for_ = for_whom;
  heartbeat();
  participant_->wait(roster_open_ ? kJoinAgain_s / 5 : kWait_s);
  waiting_for_.clear();
  poll();
}

void Member::finish(MemberEnd end) {
  if (!end_) end_ = std::move(end);
}

void Member::leave() {
  const bool somebodys_fault = end_->kind == MemberEnd::Kind::kAborted || end_->kind == MemberEnd::Kind::kClockLost;
  if (somebodys_fault && !told_by_clock_) accuse(end_->culprit, end_->text);
  tell_foreign();
  for (const auto& [topic, foreign] : participant_->foreign())
    log_warning("topic " + topic + ": ignored " + std::to_string(foreign.samples) + " foreign samples");
  send({.kind = Up::Kind::kLeave, .number = participant_->foreign_samples(), .step = progress_});
}

void Member::distrust(Incarnation incarnation, const std::string& what) {
  if (!fellows_.distrust(incarnation)) return;
  const std::string role = role_of(incarnation);
  log_error(role + ": " + what);
  accuse(role, what);
}

void Member::tell_foreign() {
  for (const auto& [topic, foreign] : participant_->foreign()) {
    if (told_foreign_.insert(topic).second) log_warning("topic " + topic + ": ignores " + foreign.first);
  }
}

void Member::accuse(const std::string& culprit, const std::string& what) {
  up_.write({.kind = Up::Kind::kLost, .incarnation = participant_->self(), .role = culprit, .text = what});
}

}  // namespace lukou::process
