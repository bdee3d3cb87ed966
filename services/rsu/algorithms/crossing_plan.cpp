#include "services/rsu/algorithms/crossing_plan.hpp"

#include <algorithm>
#include <limits>

#include "common/core/contract.hpp"

namespace lukou {
namespace {

/// A slower car belongs to the queue; its block moves at 10 km/h (docs/model.md).
constexpr double kQueue_mps = 12.0 / 3.6;
constexpr double kLongAgo_s = -std::numeric_limits<double>::infinity();

}  // namespace

Crossing plan_crossing(const ApproachRules& rules, const RsuView& heard, const LaneView& lane, const HeardCar& car,
                       double not_before_s) {
  const double now_s = heard.time_s;
  const double cruise_mps = std::max(car.speed_mps, rules.target_speed_share * heard.map.speed_limit_mps);
  const double earliest_s = now_s + time_to_line_s(car.distance_m, car.speed_mps, rules.speeding_up_mps2, cruise_mps);
  Crossing crossing{Crossing::Kind::kUnknown, earliest_s, std::max(earliest_s, not_before_s), {}};
  const double braking_m = car.speed_mps * car.speed_mps / (2.0 * rules.acceleration_max_mps2);
  if (lane.aspect != Aspect::kGreen && braking_m > car.distance_m) {
    crossing.kind = Crossing::Kind::kCommitted;
  } else if (car.speed_mps < kQueue_mps) {
    crossing.kind = Crossing::Kind::kQueued;
  } else if (const auto green = green_at_or_after(lane, crossing.time_s, rules.tail_s)) {
    crossing.kind = Crossing::Kind::kPlanned;
    crossing.time_s = std::max(crossing.time_s, green->begin_s + rules.first_crossing_s);
    crossing.green = *green;
  }
  return crossing;
}

std::optional<double> queue_crossing_s(const ApproachRules& rules, const QueueRules& queue, const LaneView& lane,
                                       double now_s, double distance_m) {
  LUKOU_EXPECT(queue.headway_s > 0.0 && queue.spacing_m > 0.0);
  const double discharge_mps = queue.spacing_m / queue.headway_s;
  double left_m = distance_m;
  for (const GreenWindow& green : green_windows(lane)) {
    const double start_s = std::max(now_s, green.begin_s + rules.first_crossing_s);
    const double crossing_s = start_s + left_m / discharge_mps;
    if (crossing_s <= green.end_s) return crossing_s;
    left_m -= std::max(0.0, green.end_s - start_s) * discharge_mps;
  }
  return std::nullopt;
}

void plan_lane(const ApproachRules& rules, const std::optional<QueueRules>& queue, const RsuView& heard,
               const LaneView& lane, std::vector<Crossing>& plan) {
  plan.clear();
  double before_s = lane.last_crossing_s.value_or(kLongAgo_s);
  bool behind_queue = false;
  for (const HeardCar& car : lane.cars) {
    if (!queue) {
      plan.push_back(plan_crossing(rules, heard, lane, car, kLongAgo_s));
      continue;
    }
    const double hidden = behind_queue ? (1.0 - queue->equipped_share) / queue->equipped_share : 0.0;
    Crossing crossing = plan_crossing(rules, heard, lane, car, before_s + (1.0 + hidden) * queue->headway_s);
    if (crossing.kind == Crossing::Kind::kQueued) {
      crossing.time_s = queue_crossing_s(rules, *queue, lane, heard.time_s, car.distance_m).value_or(crossing.time_s);
    } else if (crossing.kind == Crossing::Kind::kCommitted) {
      crossing.time_s = std::max(crossing.earliest_s, before_s);
    }
    before_s = crossing.time_s;
    behind_queue = crossing.kind == Crossing::Kind::kQueued;
    plan.push_back(crossing);
  }
}

}  // namespace lukou
