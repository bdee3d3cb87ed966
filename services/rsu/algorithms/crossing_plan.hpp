#pragma once

#include <optional>
#include <vector>

#include "services/rsu/algorithms/approach_rules.hpp"
#include "services/rsu/sdk/planning.hpp"
#include "services/rsu/sdk/rsu_view.hpp"

namespace lukou {

/// When a car is to cross its stop line, as far as the RSU can know.
struct Crossing {
  enum class Kind {
    kPlanned,    ///< at `time_s`, in `green`
    kQueued,     ///< it stands, or crawls in the queue: the light and the cars ahead decide
    kCommitted,  ///< it cannot stop for the light any more
    kUnknown,    ///< no green is known that late
  };
  Kind kind = Kind::kUnknown;
  double earliest_s = 0.0;  ///< with nobody ahead and no light
  double time_s = 0.0;
  GreenWindow green;  ///< of a planned car
};

/// The car crosses at `not_before_s` at the earliest: then, or as soon as it can be there, or when a green has begun
/// for first_crossing_s; in the first green that ends at most tail_s before.
Crossing plan_crossing(const ApproachRules& rules, const RsuView& heard, const LaneView& lane, const HeardCar& car,
                       double not_before_s);

/// When a car of the queue, `distance_m` from the line, crosses it: the queue moves at spacing / headway in every
/// green, the first car of it first_crossing_s after the begin. Empty if the known greens do not last until then.
std::optional<double> queue_crossing_s(const ApproachRules& rules, const QueueRules& queue, const LaneView& lane,
                                       double now_s, double distance_m);

/// One crossing for each heard car of the lane. With queue rules they keep a headway, start behind the last crossing
/// that was heard and wait until the queue has crossed; without, each car is planned as if it were alone.
/// Behind the last car of the queue that is heard, (1 - p) / p more are expected at the share p = equipped_share: the
/// mean number of cars without a unit between two that have one.
void plan_lane(const ApproachRules& rules, const std::optional<QueueRules>& queue, const RsuView& heard,
               const LaneView& lane, std::vector<Crossing>& plan);

}  // namespace lukou
