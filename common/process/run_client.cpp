#include "common/process/run_client.hpp"

#include <utility>

#include "common/process/environment.hpp"
#include "common/process/run_list.hpp"

namespace lukou::process {
namespace {

constexpr double kAskAgain_s = 0.2;

}  // namespace

Expected<std::unique_ptr<RunClient>> RunClient::attach(const bus::Address& address, bool with_view, Incarnation self) {
  auto participant = bus::Participant::join(address, kObserverRole, self == 0 ? new_incarnation() : self);
  if (!participant) return participant.error();
  return std::unique_ptr<RunClient>(new RunClient(std::move(participant).value(), with_view, clock_of(address)));
}

RunClient::RunClient(std::unique_ptr<bus::Participant> participant, bool with_view, Incarnation clock)
    : participant_(std::move(participant)),
      clock_(clock),
      up_(*participant_),
      control_(*participant_),
      states_(*participant_),
      heard_s_(wall_s()) {
  const auto of_the_clock = [this](Incarnation who) {
    return clock_ == 0 || who == clock_ ? bus::Belief::kYes : bus::Belief::kForeign;
  };
  control_.believe(of_the_clock);
  states_.believe(of_the_clock);
  if (with_view) {
    views_.emplace(*participant_);
    views_->believe([this](Incarnation who) {
      if (!state_ || state_->recorder == 0) return bus::Belief::kIgnored;
      return who == state_->recorder ? bus::Belief::kYes : bus::Belief::kForeign;
    });
  }
  participant_->keep_writing_while([] { return false; });
}

void RunClient::poll(double timeout_s) {
  participant_->wait(timeout_s);
  control_.take([this](Control& control, const bus::SampleInfo& info) {
    const bool to_us = control.to == participant_->self();
    if (!info.alive || (control.to != 0 && !to_us)) return;
    if (control.kind == Control::Kind::kReply) {
      if (!request_ || control.number != request_->number) return;  // answered already
      reply_ = control;
      request_.reset();
    }
    if (heard_) heard_(control);
  });
  // Discovery goes both ways: what was said or answered before the other side had matched is lost.
  if (request_ && wall_s() - asked_s_ > kAskAgain_s) {
    asked_s_ = wall_s();
    up_.write(*request_);
  }
  states_.take([this](RunState& state, const bus::SampleInfo& info) {
    if (!info.alive) return;
    clock_ = info.producer;
    state_ = state;
    heard_s_ = wall_s();
  });
  if (!views_) return;
  views_->take([this](View& view, const bus::SampleInfo& info) {
    if (!info.alive) return;
    if (!view_) view_.emplace();
    std::swap(*view_, view);
    ++views_taken_;
  });
}

double RunClient::clock_silent_s() const { return wall_s() - heard_s_; }

bool RunClient::connected() { return !up_.matched().empty() && !control_.matched().empty(); }

void RunClient::ask(const std::string& request) {
  request_ = Up{.kind = Up::Kind::kRequest, .role = std::string(kObserverRole), .number = ++requests_, .text = request};
  asked_s_ = wall_s();
  up_.write(*request_);
}

Expected<std::string> RunClient::request(const std::string& request, double limit_s) {
  const double begin_s = wall_s();
  const auto late = [&] { return wall_s() - begin_s > limit_s; };
  while (!connected() && !late()) poll(0.02);
  if (!late()) ask(request);
  while (!reply_ && !late()) poll(0.05);
  if (!reply_) return Error{"", "the run's clock does not answer"};
  const Control reply = *std::exchange(reply_, std::nullopt);
  if (!reply.ok) return Error{"", reply.text};
  return reply.text;
}

void RunClient::report_lost(const std::string& role, const std::string& how) {
  up_.write({.kind = Up::Kind::kLost, .role = role, .text = how});
}

}  // namespace lukou::process
