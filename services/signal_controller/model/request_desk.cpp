#include "services/signal_controller/model/request_desk.hpp"

#include "common/intersection/conflicts.hpp"

namespace lukou {

std::optional<RequestOutcome> RequestDesk::fault(const GreenRequest& request) {
  const bool known_lanes = request.lanes != 0 && (request.lanes & ~LaneSet::kAllBits) == 0;
  if (!known_lanes || request.lifetime < 1 || request.lifetime > kLongestRequest) return RequestOutcome::kMalformed;
  if (has_hard_conflict(LaneSet::from_bits(request.lanes))) return RequestOutcome::kConflict;
  return std::nullopt;
}

void RequestDesk::take(const GreenRequest& request, Step k) {
  if (const auto found = fault(request)) {
    news_.push_back({k, request, *found});
    return;
  }
  if (wanted(k) && in_force_->rsu < request.rsu) {
    news_.push_back({k, request, RequestOutcome::kOtherRsu});
    return;
  }
  if (in_force_ && in_force_->rsu > request.rsu) news_.push_back({k, *in_force_, RequestOutcome::kOtherRsu});
  in_force_ = request;
  told_.reset();
}

std::optional<LaneSet> RequestDesk::wanted(Step k) {
  if (!in_force_) return std::nullopt;
  if (k > in_force_->asked + in_force_->lifetime) {
    news_.push_back({k, *in_force_, RequestOutcome::kEnded});
    in_force_.reset();
    return std::nullopt;
  }
  return LaneSet::from_bits(in_force_->lanes);
}

void RequestDesk::tell(Step k, RequestOutcome outcome) {
  if (!in_force_ || told_ == outcome) return;
  told_ = outcome;
  news_.push_back({k, *in_force_, outcome});
}

}  // namespace lukou
