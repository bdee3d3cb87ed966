#include "services/signal_controller/model/actuated_heads.hpp"

#include <algorithm>
#include <vector>

#include "common/core/contract.hpp"
#include "common/intersection/conflicts.hpp"

namespace lukou {

ActuatedHeads::ActuatedHeads(const Actuation& actuation) : actuation_(actuation) {
  // Before step 0 the road is cleared.
  heads_.fill(Aspect::kRed);
  since_.fill(-std::max<Step>(actuation_.all_red, 1));
}

RequestOutcome ActuatedHeads::decide(Step at, LaneSet wanted) {
  LUKOU_EXPECT(at == next_ && !has_hard_conflict(wanted));
  ++next_;
  const LaneSet to_be_green = target(at, wanted);
  bool too_young = false;
  for (const Lane lane : kAllLanes) {
    const Step lasted = at - since_[index(lane)];
    if (heads_[index(lane)] == Aspect::kGreen && !to_be_green.contains(lane)) {
      if (lasted >= actuation_.min_green) {
        show(lane, Aspect::kYellow, at);
      } else {
        too_young = true;
      }
    } else if (heads_[index(lane)] == Aspect::kYellow && lasted >= actuation_.yellow) {
      show(lane, Aspect::kRed, at);
    }
  }
  for (const Lane lane : to_be_green) {
    if (heads_[index(lane)] == Aspect::kRed && is_clear_for(lane, at)) show(lane, Aspect::kGreen, at);
  }
  if (to_be_green != wanted) return RequestOutcome::kMaxWait;
  return too_young ? RequestOutcome::kMinGreen : RequestOutcome::kAccepted;
}

LaneSet ActuatedHeads::target(Step at, LaneSet wanted) {
  const auto lasts = [&](Lane lane, Aspect aspect, Step steps) {
    return heads_[index(lane)] == aspect && at - since_[index(lane)] >= steps;
  };
  for (const Lane lane : served_) {
    if (lasts(lane, Aspect::kGreen, actuation_.min_green)) served_.erase(lane);
  }
  std::vector<Lane> overdue;
  for (const Lane lane : kAllLanes - served_) {
    if (lasts(lane, Aspect::kRed, actuation_.max_wait)) overdue.push_back(lane);
  }
  std::ranges::stable_sort(overdue, {}, [&](Lane lane) { return since_[index(lane)]; });
  LaneSet barred = hard_conflicts(served_);
  for (const Lane lane : overdue) {
    if (!barred.contains(lane)) served_.insert(lane);
    barred = barred | hard_conflicts(lane);
  }
  const LaneSet together = served_ | (wanted - hard_conflicts(served_));
  LUKOU_EXPECT(!has_hard_conflict(together));
  return together;
}

void ActuatedHeads::show(Lane lane, Aspect aspect, Step at) {
  heads_[index(lane)] = aspect;
  since_[index(lane)] = at;
}

bool ActuatedHeads::is_clear_for(Lane lane, Step at) const {
  const auto red_for = [&](Lane other, Step steps) {
    return heads_[index(other)] == Aspect::kRed && at - since_[index(other)] >= steps;
  };
  for (const Lane crossing : hard_conflicts(lane)) {
    if (!red_for(crossing, actuation_.all_red)) return false;
  }
  return red_for(lane, std::max<Step>(actuation_.all_red, 1));
}

Step ActuatedHeads::yellow_end(Lane lane) const {
  return heads_[index(lane)] == Aspect::kYellow ? since_[index(lane)] + actuation_.yellow : -1;
}

}  // namespace lukou
