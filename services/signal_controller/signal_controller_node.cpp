#include "services/signal_controller/signal_controller_node.hpp"

#include <utility>

#include "common/lockstep/edge.hpp"

namespace lukou {

SignalControllerNode::SignalControllerNode(SignalPlan plan, Step promise)
    : latest_(plan), schedule_(std::move(plan)), promise_(promise), stride_(signal_stride(promise)) {}

void SignalControllerNode::use_plan(const SignalPlan& plan, Step k) {
  if (plan == latest_) return;
  latest_ = plan;
  schedule_.change(plan, k + promise_);
}

bool SignalControllerNode::step(Step k, SignalBatch& batch) {
  if (k % stride_ != 0) return false;
  batch.step = k;
  batch.first = k == 0 ? 0 : decided_ + 1;
  batch.heads.clear();
  for (Step at = batch.first; at <= k + promise_; ++at) {
    for (const Aspect aspect : schedule_.heads(at)) batch.heads.push_back(static_cast<std::uint8_t>(aspect));
  }
  decided_ = k + promise_;
  add_forecast(batch);
  schedule_.forget_before(batch.first);
  return true;
}

void SignalControllerNode::add_forecast(SignalBatch& batch) const {
  constexpr int kCycles = 3;
  batch.change_lane.clear();
  batch.change_aspect.clear();
  batch.change_step.clear();
  const Step to = batch.first + kCycles * schedule_.cycle_at(batch.first);
  for (std::uint8_t lane = 0; lane < kLanes; ++lane) {
    for (const HeadChange& change : schedule_.changes(static_cast<Lane>(lane), batch.first, to)) {
      batch.change_lane.push_back(lane);
      batch.change_aspect.push_back(static_cast<std::uint8_t>(change.to));
      batch.change_step.push_back(change.at);
    }
  }
}

}  // namespace lukou
