#include "common/measures/free_motion.hpp"

#include <algorithm>
#include <cmath>

#include "common/core/contract.hpp"
#include "common/core/math.hpp"

namespace lukou {
namespace {

/// Time [s] to cover `distance_m` from `speed_mps` at a constant acceleration; requires that the car gets there.
double time_at_constant_acceleration_s(double distance_m, double speed_mps, double acceleration_mps2) {
  const double end_mps = std::sqrt(speed_mps * speed_mps + 2.0 * acceleration_mps2 * distance_m);
  return 2.0 * distance_m / (speed_mps + end_mps);
}

}  // namespace

double theoretical_time_s(double distance_m, double initial_mps, double limit_mps, double acceleration_mps2) {
  LUKOU_EXPECT(distance_m > 0.0 && initial_mps >= 0.0 && limit_mps > 0.0 && acceleration_mps2 > 0.0);
  if (initial_mps >= limit_mps) return distance_m / limit_mps;
  const double ramp_m = (limit_mps * limit_mps - initial_mps * initial_mps) / (2.0 * acceleration_mps2);
  if (ramp_m >= distance_m) return time_at_constant_acceleration_s(distance_m, initial_mps, acceleration_mps2);
  return (limit_mps - initial_mps) / acceleration_mps2 + (distance_m - ramp_m) / limit_mps;
}

double free_time_s(const FreeDriver& driver, double distance_m) {
  LUKOU_EXPECT(distance_m > 0.0 && driver.desired_mps > 0.0 && driver.relaxation_s > 0.0);
  double speed_mps = driver.initial_mps;
  double passed_s = 0.0;
  // First phase, far from the desired speed: the limit of acceleration acts until the difference has fallen to this.
  const double soft_mps = driver.acceleration_max_mps2 * driver.relaxation_s;
  const double difference_mps = driver.desired_mps - speed_mps;
  if (std::abs(difference_mps) > soft_mps) {
    const double acceleration_mps2 =
        difference_mps > 0.0 ? driver.acceleration_max_mps2 : -driver.acceleration_max_mps2;
    const double end_mps = difference_mps > 0.0 ? driver.desired_mps - soft_mps : driver.desired_mps + soft_mps;
    const double ramp_m = (end_mps * end_mps - speed_mps * speed_mps) / (2.0 * acceleration_mps2);
    if (ramp_m >= distance_m) return time_at_constant_acceleration_s(distance_m, speed_mps, acceleration_mps2);
    passed_s = (end_mps - speed_mps) / acceleration_mps2;
    distance_m -= ramp_m;
    speed_mps = end_mps;
  }
  // Second phase: v = v_des + (v - v_des) exp(-t / tau), so x = v_des t + (v - v_des) tau (1 - exp(-t / tau)).
  const double tau_s = driver.relaxation_s;
  const double excess_mps = speed_mps - driver.desired_mps;
  double time_s = distance_m / driver.desired_mps;
  for (int i = 0; i < 50; ++i) {  // Newton; x is monotone and smooth
    const double decay = math::exp(-time_s / tau_s);
    const double position_m = driver.desired_mps * time_s + excess_mps * tau_s * (1.0 - decay);
    const double correction_s = (distance_m - position_m) / (driver.desired_mps + excess_mps * decay);
    time_s = std::max(time_s + correction_s, 0.0);
    if (std::abs(correction_s) < 1e-12) break;
  }
  return passed_s + time_s;
}

}  // namespace lukou
