#pragma once

namespace lukou {

/// How a guided car changes its speed on the way to the stop line [m/s2], all positive.
struct SpeedRates {
  double speeding_up_mps2 = 2.0;
  double slowing_down_mps2 = 1.0;   ///< on the way to the cruising speed
  double final_braking_mps2 = 1.5;  ///< on the way to the speed at the line
};

/// A way to the stop line: from the speed now to a cruising speed, hold it, reach the line at the final speed.
struct ApproachProfile {
  double distance_m = 0.0;  ///< to the stop line, >= 0
  double speed_mps = 0.0;   ///< now, >= 0
  double cruise_mps = 0.0;  ///< > 0
  double final_mps = 0.0;   ///< > 0
};

/// Time until the stop line [s]. If the distance is too short for all three parts, the line cuts the last ones off.
/// Never rises with the cruising speed, up to the larger of the speed now and the final speed, unless the line cuts off
/// a braking: then it may rise by a little, since the two rates of braking differ.
/// Source: guidance study, algorithm "punctual".
double approach_time_s(const SpeedRates& rates, const ApproachProfile& profile);

}  // namespace lukou
