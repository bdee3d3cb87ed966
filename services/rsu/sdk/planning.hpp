#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "common/intersection/conflicts.hpp"
#include "common/intersection/lane_set.hpp"
#include "services/rsu/sdk/rsu_view.hpp"

namespace lukou {

// What nearly every algorithm needs. Times are simulated seconds, distances those of a car's front to its stop line.

/// A green of a lane, begun or to come.
struct GreenWindow {
  double begin_s = 0.0;
  double end_s = 0.0;  ///< infinite if its end is not known
};

/// The greens of a lane that the RSU knows of, in the order of time; the one that shows now is the first.
std::vector<GreenWindow> green_windows(const LaneView& lane);
/// The first green that a car may use which reaches the line at `time_s` or waits there from then on: it ends at most
/// `tail_s` before. Empty if no green is known that late.
std::optional<GreenWindow> green_at_or_after(const LaneView& lane, double time_s, double tail_s = 0.0);

/// What the lane's head will show at `step` >= now, as far as the RSU knows: what the last known change up to then
/// leads to. Certain up to RsuView::promised_to.
Aspect aspect_at(const LaneView& lane, Step step);
/// The lanes whose heads show green at the last step that is known for certain, RsuView::promised_to.
LaneSet promised_green(const RsuView& view);

/// Time to the line of a car with nobody ahead [s], which speeds up at `acceleration_mps2` > 0 until it drives at
/// `cruise_mps`, then holds that; one that is faster keeps its speed. Infinite if it never gets there.
double time_to_line_s(double distance_m, double speed_mps, double acceleration_mps2, double cruise_mps);
/// The constant acceleration that brings a car to the line in exactly `time_s` > 0: 2 (d - v t) / t^2. Empty if the car
/// would have to roll back, that is 2 d / t < v.
std::optional<double> arrival_acceleration_mps2(double distance_m, double speed_mps, double time_s);
/// The nearest value to `wanted_mps2` that every car takes, +-`limit_mps2`, and that a message carries: rounded towards
/// zero to 0.01 m/s2. 0 if it is not a number.
double carriable_mps2(double wanted_mps2, double limit_mps2);

/// A standing queue as far as its cars are heard: a lower bound, since cars without a unit are silent.
struct QueueEstimate {
  std::size_t cars = 0;  ///< heard, standing
  double tail_m = 0.0;   ///< distance of the last one's front; 0 without a queue
};
/// Cars slower than `standing_mps` count as standing; 5 km/h in all tables of Lukou.
QueueEstimate standing_queue(const LaneView& lane, double standing_mps = 5.0 / 3.6);

}  // namespace lukou
