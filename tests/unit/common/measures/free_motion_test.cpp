#include "common/measures/free_motion.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace lukou {
namespace {

TEST(TheoreticalTime, IsARampAndThenTheLimit) {
  // 10 -> 16 m/s at 3 m/s2: 2 s and 26 m; the other 474 m at 16 m/s.
  EXPECT_NEAR(theoretical_time_s(500.0, 10.0, 16.0, 3.0), 2.0 + 474.0 / 16.0, 1e-12);
}

TEST(TheoreticalTime, MayEndOnTheRamp) {
  // From rest 6 m at 3 m/s2 take 2 s.
  EXPECT_NEAR(theoretical_time_s(6.0, 0.0, 16.0, 3.0), 2.0, 1e-12);
}

TEST(TheoreticalTime, AtTheLimitIsDistanceOverSpeed) {
  EXPECT_DOUBLE_EQ(theoretical_time_s(500.0, 16.0, 16.0, 3.0), 31.25);
}

TEST(FreeTime, AtTheDesiredSpeedIsDistanceOverSpeed) {
  EXPECT_NEAR(free_time_s({.initial_mps = 15.0, .desired_mps = 15.0}, 600.0), 40.0, 1e-9);
}

TEST(FreeTime, LosesTheSpeedDifferenceTimesTheRelaxationTime) {
  // 2 m/s slower, tau 1 s, long way: x = v t - 2 tau, so t = (600 + 2) / 15.
  EXPECT_NEAR(free_time_s({.initial_mps = 13.0, .desired_mps = 15.0}, 600.0), 602.0 / 15.0, 1e-9);
  EXPECT_NEAR(free_time_s({.initial_mps = 17.0, .desired_mps = 15.0}, 600.0), 598.0 / 15.0, 1e-9);
}

TEST(FreeTime, AcceleratesFullyWhileFarFromTheDesiredSpeed) {
  // 6 -> 12 m/s at 3 m/s2: 2 s, 18 m. Then 3 m/s below 15 m/s: (582 + 3) / 15.
  EXPECT_NEAR(free_time_s({.initial_mps = 6.0, .desired_mps = 15.0}, 600.0), 2.0 + 585.0 / 15.0, 1e-9);
  // 2 m within the ramp, from rest: sqrt(2 * 1.5 / 3) = 1 s for 1.5 m.
  EXPECT_NEAR(free_time_s({.initial_mps = 0.0, .desired_mps = 15.0}, 1.5), 1.0, 1e-12);
}

TEST(FreeTime, AgreesWithAFineIntegration) {
  const FreeDriver driver{.initial_mps = 4.0, .desired_mps = 13.0, .relaxation_s = 2.0, .acceleration_max_mps2 = 2.5};
  double position_m = 0.0;
  double speed_mps = driver.initial_mps;
  double time_s = 0.0;
  constexpr double kFine_s = 1e-5;
  while (position_m < 40.0) {
    const double a = std::clamp((driver.desired_mps - speed_mps) / driver.relaxation_s, -2.5, 2.5);
    position_m += speed_mps * kFine_s;
    speed_mps += a * kFine_s;
    time_s += kFine_s;
  }
  EXPECT_NEAR(free_time_s(driver, 40.0), time_s, 1e-4);
}

}  // namespace
}  // namespace lukou
