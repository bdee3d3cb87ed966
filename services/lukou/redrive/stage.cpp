#include "services/lukou/redrive/stage.hpp"

#include <algorithm>
#include <utility>

#include "common/process/environment.hpp"

namespace lukou::redrive {
namespace {

constexpr double kHeartbeat_s = 0.2;
constexpr Step kCreditEvery = 50;

}  // namespace

Expected<std::unique_ptr<Stage>> Stage::open(const bus::Address& address, ClockSettings settings, bool actuated,
                                             const std::set<std::uint32_t>& absent) {
  std::unique_ptr<Stage> stage(new Stage());
  // Each role has a participant of its own: RSUs tell roles by them.
  const auto participant = [&](std::string_view role) {
    return bus::Participant::join(address, role, process::new_incarnation());
  };
  auto clock = participant(kClockRole);
  if (!clock) return clock.error();
  stage->clock_ = std::move(clock).value();
  for (const auto& [role, player] : {std::pair(kEngineRole, &stage->engine_),
                                     {kControllerRole, &stage->controller_},
                                     {kRecorderRole, &stage->recorder_}}) {
    auto joined = participant(role);
    if (!joined) return joined.error();
    *player = {std::string(role), std::move(joined).value()};
  }
  for (const std::uint32_t rsu : absent) {
    auto joined = participant(rsu_role(rsu));
    if (!joined) return joined.error();
    stage->absent_.push_back({rsu_role(rsu), std::move(joined).value()});
  }
  settings.incarnation = settings.launcher = stage->clock_->self();
  stage->core_.emplace(std::move(settings));
  stage->up_.emplace(*stage->clock_);
  stage->control_.emplace(*stage->clock_);
  stage->air_.emplace(*stage->engine_.participant);
  stage->roadside_.emplace(*stage->engine_.participant);
  stage->signal_.emplace(*stage->controller_.participant);
  if (actuated) stage->requests_.emplace(*stage->controller_.participant);
  for (const Player* player : {&stage->engine_, &stage->controller_, &stage->recorder_}) stage->join(*player);
  for (const Player& player : stage->absent_) stage->join(player);
  return stage;
}

void Stage::say(const Player& player, Up message) {
  message.incarnation = player.participant->self();
  message.role = player.role;
  core_->receive(process::wall_s(), message);
}

void Stage::join(const Player& player) { say(player, {.kind = Up::Kind::kJoin}); }

bool Stage::everybody_is_matched() {
  const auto heard = up_->matched();
  const auto reached = control_->matched();
  const auto air = air_->matched();
  const auto answers = roadside_->matched();
  const auto heads = signal_->matched();
  for (const auto& [incarnation, role] : core_->roster()) {
    const bool ours =
        incarnation == engine_.participant->self() || incarnation == controller_.participant->self() ||
        incarnation == recorder_.participant->self() ||
        std::ranges::any_of(absent_, [id = incarnation](const Player& p) { return p.participant->self() == id; });
    if (ours) continue;
    for (const auto* matched : {&heard, &reached, &air, &answers, &heads}) {
      if (!matched->contains(incarnation)) return false;
    }
    if (requests_ && !requests_->matched().contains(incarnation)) return false;
  }
  return true;
}

void Stage::serve(double timeout_s) {
  // What the programs say wakes the participant that it is said to: the engine, most of the time.
  engine_.participant->wait(timeout_s);
  up_->take([this](Up& message, const bus::SampleInfo& info) {
    if (!info.alive) return core_->gone(process::wall_s(), info.producer);
    if (message.kind == Up::Kind::kJoin) {
      joining_.push_back(message);
    } else {
      core_->receive(process::wall_s(), message);
    }
  });
  const auto reached = control_->matched();
  for (const Up& message : std::exchange(joining_, {})) {
    if (reached.contains(message.incarnation)) core_->receive(process::wall_s(), message);
  }
  roadside_->take([this](RoadsideBatch& batch, const bus::SampleInfo& info) {
    if (info.alive) answers_.push_back(std::move(batch));
  });
  if (requests_) requests_->take([](RequestBatch&, const bus::SampleInfo&) {});
  if (core_->roster_version() > seen_ && everybody_is_matched()) {
    seen_ = core_->roster_version();
    for (const Player* player : {&engine_, &controller_, &recorder_})
      say(*player, {.kind = Up::Kind::kSees, .number = seen_});
    for (const Player& player : absent_) say(player, {.kind = Up::Kind::kSees, .number = seen_});
    core_->sees(process::wall_s(), seen_);
  }
  if (process::wall_s() - told_s_ > kHeartbeat_s) {
    told_s_ = process::wall_s();
    // All of ours wait for the programs: who is silent is the culprit if nothing goes on.
    for (const Player* player : {&engine_, &controller_, &recorder_})
      say(*player, {.kind = Up::Kind::kProgress, .step = played_, .text = "the RSU"});
    for (const Player& player : absent_) say(player, {.kind = Up::Kind::kProgress, .step = played_, .text = "the RSU"});
  }
  core_->tick(process::wall_s());
  send();
}

void Stage::send() {
  for (const Control& control : core_->take_outbox()) {
    if (control.kind == Control::Kind::kGrant) through_ = control.through;
    control_->write(control);
  }
}

void Stage::play(const AirBatch& air, const SignalBatch* signal) {
  if (signal != nullptr) signal_->write(*signal);
  air_->write(air);
  played_ = air.step;
}

std::vector<RoadsideBatch> Stage::take_answers() { return std::exchange(answers_, {}); }

void Stage::compared(Step step) {
  if (step < credited_ + kCreditEvery) return;
  credited_ = step;
  say(recorder_, {.kind = Up::Kind::kCredit, .step = step});
}

void Stage::close(Step step) {
  say(recorder_, {.kind = Up::Kind::kClosed, .step = step});
  send();
}

void Stage::lost(const std::string& role, const std::string& how) {
  core_->receive(process::wall_s(),
                 {.kind = Up::Kind::kLost, .incarnation = clock_->self(), .role = role, .text = how});
  send();
}

}  // namespace lukou::redrive
