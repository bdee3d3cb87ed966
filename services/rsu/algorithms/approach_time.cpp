#include "services/rsu/algorithms/approach_time.hpp"

#include <algorithm>
#include <cmath>

namespace lukou {
namespace {

/// A change of speed at a constant rate; negative = braking.
struct SpeedChange {
  double from_mps;
  double to_mps;
  double rate_mps2;
};

double length_m(const SpeedChange& change) {
  return (change.to_mps * change.to_mps - change.from_mps * change.from_mps) / (2 * change.rate_mps2);
}

/// Time for the first `distance_m` of a change, which is at least as long.
double time_over_s(const SpeedChange& change, double distance_m) {
  const double squared = change.from_mps * change.from_mps + 2 * change.rate_mps2 * distance_m;
  return (std::sqrt(std::max(squared, 0.0)) - change.from_mps) / change.rate_mps2;
}

}  // namespace

double approach_time_s(const SpeedRates& rates, const ApproachProfile& profile) {
  const double w = profile.cruise_mps;
  const SpeedChange first = {profile.speed_mps, w,
                             w > profile.speed_mps ? rates.speeding_up_mps2 : -rates.slowing_down_mps2};
  const SpeedChange last = {w, profile.final_mps,
                            profile.final_mps > w ? rates.speeding_up_mps2 : -rates.final_braking_mps2};
  const double first_m = length_m(first);
  if (first_m >= profile.distance_m) return time_over_s(first, profile.distance_m);
  const double first_s = (w - profile.speed_mps) / first.rate_mps2;
  const double rest_m = profile.distance_m - first_m;
  const double last_m = length_m(last);
  if (last_m >= rest_m) return first_s + time_over_s(last, rest_m);
  return first_s + (rest_m - last_m) / w + (profile.final_mps - w) / last.rate_mps2;
}

}  // namespace lukou
