#include "common/intersection/plan_schedule.hpp"

#include <algorithm>
#include <limits>
#include <ranges>
#include <utility>

namespace lukou {

PlanSchedule::PlanSchedule(SignalPlan first) {
  const Step offset = first.offset;
  plans_.push_back({std::numeric_limits<Step>::min(), offset, std::move(first)});
}

const PlanSchedule::Running& PlanSchedule::running_at(Step step) const {
  for (const Running& running : plans_ | std::views::reverse)
    if (running.from <= step) return running;
  return plans_.front();
}

void PlanSchedule::change(SignalPlan next, Step earliest) {
  while (plans_.size() > 1 && plans_.back().from >= earliest) plans_.pop_back();
  const Step from = next_cycle_start(plans_.back().plan, earliest);
  const Step offset = next.offset;
  next.offset += from;
  plans_.push_back({from, offset, std::move(next)});
}

Heads PlanSchedule::heads(Step step) const {
  const Running& running = running_at(step);
  Heads heads{};
  for (std::size_t i = 0; i < kLanes; ++i) heads[i] = aspect_at(running.plan, static_cast<Lane>(i), step);
  return heads;
}

std::vector<HeadChange> PlanSchedule::changes(Lane lane, Step from, Step to) const {
  std::vector<HeadChange> found;
  Aspect now = aspect_at(running_at(from).plan, lane, from);
  for (std::size_t i = 0; i < plans_.size(); ++i) {
    const SignalPlan& plan = plans_[i].plan;
    const Step end = i + 1 < plans_.size() ? std::min(plans_[i + 1].from, to + 1) : to + 1;
    if (end <= from + 1) continue;
    // The hand-over itself may change the head.
    Step at = std::max(plans_[i].from, from);
    if (at >= end) continue;  // takes over after `to`
    if (at > from && aspect_at(plan, lane, at) != now) found.push_back({at, now = aspect_at(plan, lane, at)});
    for (at = next_change(plan, lane, at); at >= 0 && at < end; at = next_change(plan, lane, at)) {
      found.push_back({at, now = aspect_at(plan, lane, at)});
    }
  }
  return found;
}

void PlanSchedule::forget_before(Step step) {
  while (plans_.size() > 1 && plans_[1].from <= step) plans_.pop_front();
}

}  // namespace lukou
