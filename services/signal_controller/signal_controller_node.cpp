#include "services/signal_controller/signal_controller_node.hpp"

#include <string>
#include <utility>

#include "common/core/contract.hpp"
#include "common/intersection/conflicts.hpp"
#include "common/lockstep/edge.hpp"

namespace lukou {

SignalControllerNode::SignalControllerNode(SignalPlan plan, Step promise, const std::optional<Actuation>& actuation)
    : latest_(plan), schedule_(std::move(plan)), promise_(promise), stride_(signal_stride(promise)) {
  if (actuation) actuated_.emplace(Actuated{ActuatedHeads(*actuation), {}, {}});
}

void SignalControllerNode::use_plan(const SignalPlan& plan, Step k) {
  if (plan == latest_) return;
  latest_ = plan;
  schedule_.change(plan, k + promise_);
}

void SignalControllerNode::hear(Step k, const RequestBatch& requests) {
  LUKOU_EXPECT(actuated_.has_value() && requests.lanes.size() == requests.lifetime.size());
  if (requests.lanes.empty()) return;
  actuated_->desk.take({.rsu = requests.rsu,
                        .asked = requests.step,
                        .lanes = requests.lanes.back(),
                        .lifetime = requests.lifetime.back()},
                       k);
}

bool SignalControllerNode::step(Step k, SignalBatch& batch) {
  if (actuated_) decide(k);
  if (k % stride_ != 0) return false;
  batch.step = k;
  batch.first = k == 0 ? 0 : decided_ + 1;
  batch.heads.clear();
  for (Step at = batch.first; at <= k + promise_; ++at) {
    const Heads heads =
        actuated_ ? actuated_->unpublished[static_cast<std::size_t>(at - batch.first)] : schedule_.heads(at);
    for (const Aspect aspect : heads) batch.heads.push_back(static_cast<std::uint8_t>(aspect));
  }
  decided_ = k + promise_;
  batch.change_lane.clear();
  batch.change_aspect.clear();
  batch.change_step.clear();
  if (actuated_) {
    add_certain_changes(batch);
    add_request_news(batch);
    actuated_->unpublished.clear();
  } else {
    add_forecast(batch);
  }
  schedule_.forget_before(batch.first);
  return true;
}

void SignalControllerNode::decide(Step k) {
  for (Step at = k == 0 ? 0 : k + promise_; at <= k + promise_; ++at) {
    LaneSet plan_green;
    const Heads plan = schedule_.heads(at);
    for (const Lane lane : kAllLanes) {
      if (plan[index(lane)] == Aspect::kGreen) plan_green.insert(lane);
    }
    const RequestOutcome outcome = actuated_->heads.decide(at, actuated_->desk.wanted(k).value_or(plan_green));
    actuated_->desk.tell(k, outcome);
    // The conflict monitor: whatever the rules above did, no two crossing lanes leave the controller.
    LUKOU_EXPECT(conflicts_of(actuated_->heads.heads(), at).empty());
    actuated_->unpublished.push_back(actuated_->heads.heads());
  }
}

void SignalControllerNode::add_forecast(SignalBatch& batch) const {
  constexpr int kCycles = 3;
  const Step to = batch.first + kCycles * schedule_.cycle_at(batch.first);
  for (std::uint8_t lane = 0; lane < kLanes; ++lane) {
    for (const HeadChange& change : schedule_.changes(static_cast<Lane>(lane), batch.first, to)) {
      batch.change_lane.push_back(lane);
      batch.change_aspect.push_back(static_cast<std::uint8_t>(change.to));
      batch.change_step.push_back(change.at);
    }
  }
}

void SignalControllerNode::add_certain_changes(SignalBatch& batch) const {
  const auto add = [&](std::size_t lane, Aspect to, Step at) {
    batch.change_lane.push_back(static_cast<std::uint8_t>(lane));
    batch.change_aspect.push_back(static_cast<std::uint8_t>(to));
    batch.change_step.push_back(at);
  };
  const std::vector<Heads>& decided = actuated_->unpublished;
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    for (std::size_t i = 1; i < decided.size(); ++i) {
      if (decided[i][lane] != decided[i - 1][lane]) {
        add(lane, decided[i][lane], batch.first + static_cast<Step>(i));
      }
    }
    const Step red = actuated_->heads.yellow_end(static_cast<Lane>(lane));
    if (red >= 0) add(lane, Aspect::kRed, red);
  }
}

void SignalControllerNode::add_request_news(SignalBatch& batch) {
  batch.request_step.clear();
  batch.request_asked.clear();
  batch.request_rsu.clear();
  batch.request_lanes.clear();
  batch.request_outcome.clear();
  for (const RequestNews& news : actuated_->desk.news()) {
    batch.request_step.push_back(news.step);
    batch.request_asked.push_back(news.request.asked);
    batch.request_rsu.push_back(news.request.rsu);
    batch.request_lanes.push_back(news.request.lanes);
    batch.request_outcome.push_back(static_cast<std::uint8_t>(news.outcome));
  }
  actuated_->desk.clear_news();
}

}  // namespace lukou
