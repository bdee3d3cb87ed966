#include "services/lukou/control/run_client.hpp"

#include <utility>

#include "common/process/environment.hpp"

namespace lukou::control {
namespace {

constexpr double kAskAgain_s = 0.2;

}  // namespace

Expected<std::unique_ptr<RunClient>> RunClient::attach(const bus::Address& address, bool with_view) {
  auto participant = bus::Participant::join(address, process::new_incarnation());
  if (!participant) return participant.error();
  return std::unique_ptr<RunClient>(new RunClient(std::move(participant).value(), with_view));
}

RunClient::RunClient(std::unique_ptr<bus::Participant> participant, bool with_view)
    : participant_(std::move(participant)), up_(*participant_), control_(*participant_), states_(*participant_) {
  if (with_view) views_.emplace(*participant_);
  participant_->keep_writing_while([] { return false; });
}

void RunClient::poll(double timeout_s) {
  participant_->wait(timeout_s);
  control_.take([this](Control& control, const bus::SampleInfo& info) {
    if (!info.alive || control.kind != Control::Kind::kReply || control.to != participant_->self()) return;
    reply_ = control;
    request_.reset();
  });
  // Discovery goes both ways: what was said or answered before the other side had matched is lost.
  if (request_ && process::wall_s() - asked_s_ > kAskAgain_s) {
    asked_s_ = process::wall_s();
    up_.write(*request_);
  }
  states_.take([this](RunState& state, const bus::SampleInfo& info) {
    if (info.alive) state_ = state;
  });
  if (!views_) return;
  views_->take([this](View& view, const bus::SampleInfo& info) {
    if (!info.alive) return;
    if (!view_) view_.emplace();
    std::swap(*view_, view);
  });
}

bool RunClient::connected() const { return !up_.matched().empty() && !control_.matched().empty(); }

void RunClient::ask(const std::string& request) {
  request_ = Up{.kind = Up::Kind::kRequest, .role = std::string(kObserverRole), .number = ++requests_, .text = request};
  asked_s_ = process::wall_s();
  up_.write(*request_);
}

Expected<std::string> RunClient::request(const std::string& request, double limit_s) {
  const double begin_s = process::wall_s();
  const auto late = [&] { return process::wall_s() - begin_s > limit_s; };
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

}  // namespace lukou::control
