#include "common/intersection/signal_plan.hpp"

#include <string>

#include "common/core/contract.hpp"

namespace lukou {
namespace {

constexpr Step seconds(Step s) { return s * kStepsPerSecond; }

Step phase_at(const SignalPlan& plan, Step step) {
  const Step phase = (step - plan.offset) % plan.cycle;
  return phase < 0 ? phase + plan.cycle : phase;
}

/// Green from `from` for `green`, then yellow for `yellow`, red for the rest of the cycle.
std::vector<TimedAspect> one_green(Step cycle, Step from, Step green, Step yellow) {
  std::vector<TimedAspect> list;
  if (from > 0) list.push_back({Aspect::kRed, from});
  list.push_back({Aspect::kGreen, green});
  if (yellow > 0) list.push_back({Aspect::kYellow, yellow});
  if (from + green + yellow < cycle) list.push_back({Aspect::kRed, cycle - from - green - yellow});
  return list;
}

bool on_west_east_axis(Approach approach) { return approach == Approach::kWest || approach == Approach::kEast; }

SignalPlan two_phases(Step green, Step yellow) {
  SignalPlan plan;
  plan.cycle = 2 * (green + yellow);
  for (int i = 0; i < kLanes; ++i) {
    const auto lane = static_cast<Lane>(i);
    const Step from = on_west_east_axis(approach_of(lane)) ? 0 : green + yellow;
    plan.lanes[index(lane)] = one_green(plan.cycle, from, green, yellow);
  }
  return plan;
}

}  // namespace

Expected<SignalPlan> validated(SignalPlan plan) {
  if (plan.cycle < 1) return Error{"cycle_s", "must be at least 0.1 s"};
  for (int i = 0; i < kLanes; ++i) {
    const auto lane = static_cast<Lane>(i);
    const std::string where = "lane " + std::string(name(lane));
    Step sum = 0;
    for (const TimedAspect& timed : plan.lanes[index(lane)]) {
      if (timed.duration < 1) return Error{where, "every duration must be at least 0.1 s"};
      sum += timed.duration;
    }
    if (plan.lanes[index(lane)].empty()) return Error{where, "has no aspects; every lane must stand in the plan once"};
    if (sum != plan.cycle) {
      return Error{where, "durations add up to " + std::to_string(sum / 10) + "." + std::to_string(sum % 10) +
                              " s, the cycle is " + std::to_string(plan.cycle / 10) + "." +
                              std::to_string(plan.cycle % 10) + " s; they must be equal"};
    }
  }
  return plan;
}

Aspect aspect_at(const SignalPlan& plan, Lane lane, Step step) {
  Step phase = phase_at(plan, step);
  for (const TimedAspect& timed : plan.lanes[index(lane)]) {
    if (phase < timed.duration) return timed.aspect;
    phase -= timed.duration;
  }
  contract_violated("the plan is validated: durations add up to the cycle", __FILE__, __LINE__);
}

Step next_change(const SignalPlan& plan, Lane lane, Step step) {
  const auto& list = plan.lanes[index(lane)];
  const Aspect now = aspect_at(plan, lane, step);
  Step boundary = step - phase_at(plan, step);
  for (int cycle = 0; cycle < 2; ++cycle) {
    for (const TimedAspect& timed : list) {
      if (boundary > step && timed.aspect != now) return boundary;
      boundary += timed.duration;
    }
  }
  return boundary > step && list.front().aspect != now ? boundary : -1;
}

Step next_cycle_start(const SignalPlan& plan, Step step) {
  const Step phase = phase_at(plan, step);
  return phase == 0 ? step : step + plan.cycle - phase;
}

double green_share(const SignalPlan& plan, Lane lane) {
  Step green = 0;
  for (const TimedAspect& timed : plan.lanes[index(lane)])
    if (timed.aspect == Aspect::kGreen) green += timed.duration;
  return static_cast<double>(green) / static_cast<double>(plan.cycle);
}

SignalPlan paper_plan() { return two_phases(seconds(45), 0); }

SignalPlan paper_yellow_plan() { return two_phases(seconds(42), seconds(3)); }

SignalPlan protected_left_plan() {
  constexpr Step kThrough = 18;
  constexpr Step kLeft = 19;
  SignalPlan plan;
  plan.cycle = seconds(90);
  for (int i = 0; i < kLanes; ++i) {
    const auto lane = static_cast<Lane>(i);
    const Step axis_start = on_west_east_axis(approach_of(lane)) ? 0 : seconds(45);
    const bool left = turn_of(lane) == Turn::kLeft;
    const Step from = axis_start + (left ? seconds(kThrough + 4) : 0);
    plan.lanes[index(lane)] = one_green(plan.cycle, from, seconds(left ? kLeft : kThrough), seconds(3));
  }
  return plan;
}

}  // namespace lukou
