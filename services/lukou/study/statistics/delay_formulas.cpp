#include "services/lukou/study/statistics/delay_formulas.hpp"

#include <algorithm>
#include <cmath>

#include "common/core/contract.hpp"

namespace lukou::statistics {
namespace {

constexpr double kSecondsPerHour = 3600.0;

void check(const SignalisedLane& lane) {
  LUKOU_EXPECT(lane.flow_veh_per_h > 0.0 && lane.saturation_veh_per_h > 0.0);
  LUKOU_EXPECT(lane.green_s > 0.0 && lane.green_s <= lane.cycle_s);
}

}  // namespace

std::optional<double> webster_delay_s(const SignalisedLane& lane) {
  check(lane);
  const double x = lane.saturation();
  if (x >= 1.0) return std::nullopt;
  const double green = lane.green_s / lane.cycle_s;
  const double flow_veh_per_s = lane.flow_veh_per_h / kSecondsPerHour;
  const double uniform_s = lane.cycle_s * (1.0 - green) * (1.0 - green) / (2.0 * (1.0 - green * x));
  const double random_s = x * x / (2.0 * flow_veh_per_s * (1.0 - x));
  const double correction_s =
      0.65 * std::cbrt(lane.cycle_s / (flow_veh_per_s * flow_veh_per_s)) * std::pow(x, 2.0 + 5.0 * green);
  return uniform_s + random_s - correction_s;
}

double hcm_delay_s(const SignalisedLane& lane, double period_s) {
  check(lane);
  LUKOU_EXPECT(period_s > 0.0);
  constexpr double kIncrementalFactor = 0.5;  // k, pretimed
  const double x = lane.saturation();
  const double green = lane.green_s / lane.cycle_s;
  const double capacity_veh_per_h = lane.saturation_veh_per_h * green;
  const double period_h = period_s / kSecondsPerHour;
  const double uniform_s = 0.5 * lane.cycle_s * (1.0 - green) * (1.0 - green) / (1.0 - std::min(1.0, x) * green);
  const double root = std::sqrt((x - 1.0) * (x - 1.0) + 8.0 * kIncrementalFactor * x / (capacity_veh_per_h * period_h));
  return uniform_s + 900.0 * period_h * (x - 1.0 + root);
}

}  // namespace lukou::statistics
