#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "common/core/expected.hpp"
#include "common/core/step.hpp"
#include "common/intersection/lane.hpp"

namespace lukou {

/// What a signal head shows.
enum class Aspect : std::uint8_t { kRed = 1, kYellow = 2, kGreen = 3 };

/// The heads of the twelve lanes at one step.
using Heads = std::array<Aspect, kLanes>;

/// A stretch of a lane's cycle.
struct TimedAspect {
  Aspect aspect = Aspect::kRed;
  Step duration = 0;  ///< steps, >= 1

  friend bool operator==(const TimedAspect&, const TimedAspect&) = default;
};

/// A fixed-time plan: every lane runs through its own list once a cycle.
struct SignalPlan {
  Step cycle = 0;                                      ///< steps, >= 1
  Step offset = 0;                                     ///< steps; cycles start at offset + n * cycle
  std::array<std::vector<TimedAspect>, kLanes> lanes;  ///< durations add up to the cycle

  friend bool operator==(const SignalPlan&, const SignalPlan&) = default;
};

/// Returns the plan if each lane's durations are positive and add up to the cycle; otherwise which lane fails and why.
Expected<SignalPlan> validated(SignalPlan plan);

/// What a lane's head shows at a step (any step, also before the offset). Requires a validated plan.
Aspect aspect_at(const SignalPlan& plan, Lane lane, Step step);
/// The first step after `step` at which the lane's head changes; -1 if it never does.
Step next_change(const SignalPlan& plan, Lane lane, Step step);
/// The first start of a cycle at or after `step`.
Step next_cycle_start(const SignalPlan& plan, Step step);
/// Share of the cycle in which the lane's head is green, [0, 1].
double green_share(const SignalPlan& plan, Lane lane);

/// 90 s: W and E green for 45 s, then S and N, no yellow (the paper, figure 3).
SignalPlan paper_plan();
/// 90 s: 42 s green and 3 s yellow for each axis.
SignalPlan paper_yellow_plan();
/// 90 s, four phases: W/E straight and right, W/E left, S/N straight and right, S/N left; 3 s yellow and 1 s all-red
/// after each. Assumed; carries about 1,100 veh/h per approach at equal lane shares.
SignalPlan protected_left_plan();

}  // namespace lukou
