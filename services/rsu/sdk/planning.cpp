#include "services/rsu/sdk/planning.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/core/contract.hpp"

namespace lukou {
namespace {

constexpr double kNever_s = std::numeric_limits<double>::infinity();

/// The first green of the lane that is `wanted`.
template <class Wanted>
std::optional<GreenWindow> find_green(const LaneView& lane, Wanted wanted) {
  Aspect aspect = lane.aspect;
  Step since = lane.aspect_since;
  for (const SignalChange& change : lane.changes) {
    const GreenWindow green{time_s(since), time_s(change.step)};
    if (aspect == Aspect::kGreen && wanted(green)) return green;
    aspect = change.aspect;
    since = change.step;
  }
  const GreenWindow last{time_s(since), kNever_s};
  if (aspect == Aspect::kGreen && wanted(last)) return last;
  return std::nullopt;
}

}  // namespace

std::vector<GreenWindow> green_windows(const LaneView& lane) {
  std::vector<GreenWindow> windows;
  find_green(lane, [&](const GreenWindow& green) {
    windows.push_back(green);
    return false;
  });
  return windows;
}

std::optional<GreenWindow> green_at_or_after(const LaneView& lane, double time_s, double tail_s) {
  return find_green(lane, [&](const GreenWindow& green) { return time_s <= green.end_s + tail_s; });
}

Aspect aspect_at(const LaneView& lane, Step step) {
  Aspect aspect = lane.aspect;
  for (const SignalChange& change : lane.changes) {
    if (change.step > step) break;
    aspect = change.aspect;
  }
  return aspect;
}

LaneSet promised_green(const RsuView& view) {
  LaneSet green;
  for (const Lane lane : kAllLanes) {
    if (aspect_at(view.lanes[index(lane)], view.promised_to) == Aspect::kGreen) green.insert(lane);
  }
  return green;
}

double time_to_line_s(double distance_m, double speed_mps, double acceleration_mps2, double cruise_mps) {
  LUKOU_EXPECT(acceleration_mps2 > 0.0);
  if (distance_m <= 0.0) return 0.0;
  const double top_mps = std::max(speed_mps, cruise_mps);
  if (top_mps <= 0.0) return kNever_s;
  const double run_up_m = (top_mps * top_mps - speed_mps * speed_mps) / (2.0 * acceleration_mps2);
  if (distance_m <= run_up_m) {
    return (std::sqrt(speed_mps * speed_mps + 2.0 * acceleration_mps2 * distance_m) - speed_mps) / acceleration_mps2;
  }
  return (top_mps - speed_mps) / acceleration_mps2 + (distance_m - run_up_m) / top_mps;
}

std::optional<double> arrival_acceleration_mps2(double distance_m, double speed_mps, double time_s) {
  LUKOU_EXPECT(time_s > 0.0);
  if (2.0 * distance_m < speed_mps * time_s) return std::nullopt;
  return 2.0 * (distance_m - speed_mps * time_s) / (time_s * time_s);
}

double carriable_mps2(double wanted_mps2, double limit_mps2) {
  if (std::isnan(wanted_mps2)) return 0.0;
  const double limited_mps2 = std::clamp(wanted_mps2, -limit_mps2, limit_mps2);
  // The margin keeps a value that is a multiple already, but for its rounding.
  const double margin = limited_mps2 < 0.0 ? -1e-9 : 1e-9;
  return std::trunc(limited_mps2 * 100.0 + margin) / 100.0;
}

QueueEstimate standing_queue(const LaneView& lane, double standing_mps) {
  QueueEstimate queue;
  for (const HeardCar& car : lane.cars) {
    if (car.speed_mps >= standing_mps) continue;
    ++queue.cars;
    queue.tail_m = std::max(queue.tail_m, car.distance_m);
  }
  return queue;
}

}  // namespace lukou
