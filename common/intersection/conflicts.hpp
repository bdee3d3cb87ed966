#pragma once

#include <string>
#include <vector>

#include "common/intersection/lane_set.hpp"
#include "common/intersection/signal_plan.hpp"

namespace lukou {

/// How the paths of two lanes meet inside the junction.
enum class Conflict : std::uint8_t {
  kNone,       ///< their paths keep apart
  kPermitted,  ///< a left turn and the stream that comes towards it: the driver must yield (not modelled)
  kHard,       ///< crossing streams: never green together
};

/// Follows from the geometry: two paths conflict if their centre lines come closer than a car's width (1.8 m).
Conflict conflict(Lane a, Lane b);

/// The lanes whose streams cross that of `lane`: Conflict::kHard.
LaneSet hard_conflicts(Lane lane);
/// The lanes that cross one of `lanes`.
LaneSet hard_conflicts(LaneSet lanes);
/// Whether two of `lanes` cross: they can never be green together.
bool has_hard_conflict(LaneSet lanes);

/// Two lanes that are not red at the same step.
struct PlanConflict {
  Lane a{};
  Lane b{};
  Conflict kind = Conflict::kNone;
  Step at = 0;  ///< first step of the cycle, [offset, offset + cycle)
};

/// Every conflicting pair that shows green or yellow together somewhere in the cycle, in the order of the lanes.
std::vector<PlanConflict> conflicts_of(const SignalPlan& plan);

/// First hard-conflicting pair that `heads` show green or yellow together, if any. For the conflict monitor.
std::vector<PlanConflict> conflicts_of(const Heads& heads, Step at);

/// "WC and SC at 45.0 s"
std::string text(const PlanConflict& conflict);

}  // namespace lukou
