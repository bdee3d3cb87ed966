#include "services/traffic_engine/model/guard.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "common/core/keyed_random.hpp"

namespace lukou::traffic {
namespace {

constexpr double kBraking_mps2 = 3.0;
constexpr double kSpeedMax_mps = 50.0 / 3.0;
constexpr double kSpacing_m = 5.5;

struct Body {
  double position_m = 0.0;
  double speed_mps = 0.0;

  [[nodiscard]] double stopping_point() const { return stopping_point_m(position_m, speed_mps, kBraking_mps2); }
  void go(double next_mps) {
    position_m = advanced_m(position_m, speed_mps, next_mps);
    speed_mps = next_mps;
  }
};

double uniform(std::uint64_t roll, std::uint32_t draw, double low, double high) {
  return low + (high - low) * uniform01({.run_seed = 11, .entity = draw, .index = roll});
}

double limited(double speed_mps, double acceleration_mps2) {
  return std::clamp(speed_mps + acceleration_mps2 * kStep_s, 0.0, kSpeedMax_mps);
}

TEST(Guard, LeavesASpeedAloneThatKeepsToTheRoom) {
  EXPECT_DOUBLE_EQ(guarded_speed_mps(0.0, 10.0, 10.3, {100.0, 100.0}, kBraking_mps2), 10.3);
}

TEST(Guard, AllowsTheSpeedWhoseStoppingPointIsTheRoomsEnd) {
  // From 10 m/s with 17.7 m of room: 1 + v' * 0.05 - 0.5 + v'^2 / 6 = 17.7 has the root v' = 10.007.
  const double next_mps = guarded_speed_mps(0.0, 10.0, 10.3, {100.0, 17.7}, kBraking_mps2);
  EXPECT_LT(next_mps, 10.3);
  EXPECT_NEAR(stopping_point_m(advanced_m(0.0, 10.0, next_mps), next_mps, kBraking_mps2), 17.7, 1e-9);
}

TEST(Guard, NeverBrakesHarderThanTheLimit) {
  EXPECT_DOUBLE_EQ(guarded_speed_mps(0.0, 10.0, 10.0, {0.0, 0.0}, kBraking_mps2), 9.7);
  EXPECT_DOUBLE_EQ(guarded_speed_mps(0.0, 0.1, 0.2, {0.0, 0.0}, kBraking_mps2), 0.0);
}

TEST(Guard, KeepsTwoCarsApartWhateverTheyWant) {
  // Any start whose stopping points are in order; a leader that brakes with at most a_max; a follower that wants
  // anything.
  for (std::uint64_t roll = 0; roll < 100000; ++roll) {
    Body ahead{100.0, uniform(roll, 0, 0.0, kSpeedMax_mps)};
    Body own{0.0, uniform(roll, 1, 0.0, kSpeedMax_mps)};
    const double slack_m = uniform(roll, 2, 0.0, 1.0) < 0.5 ? 0.0 : uniform(roll, 3, 0.0, 20.0);
    own.position_m =
        std::min(ahead.stopping_point() - own.stopping_point() - kSpacing_m - slack_m, ahead.position_m - kSpacing_m);
    const double habit_mps2 = uniform(roll, 4, -3.0, 3.0);
    for (std::uint32_t step = 0; step < 40; ++step) {
      ahead.go(limited(ahead.speed_mps, std::clamp(habit_mps2 + uniform(roll, 10 + step, -3.0, 3.0), -3.0, 3.0)));
      const double wanted_mps = limited(own.speed_mps, uniform(roll, 60 + step, -1.0, 3.0));
      const double before = own.stopping_point();
      const double speed_before_mps = own.speed_mps;
      own.go(guarded_speed_mps(own.position_m, own.speed_mps, wanted_mps,
                               {ahead.position_m - kSpacing_m, ahead.stopping_point() - kSpacing_m}, kBraking_mps2));
      ASSERT_GE(ahead.position_m - own.position_m, kSpacing_m - 0.005) << "roll " << roll;
      ASSERT_GE(ahead.stopping_point() - own.stopping_point(), kSpacing_m - 0.005) << "roll " << roll;
      ASSERT_GE(own.stopping_point() - before, -1e-9);
      ASSERT_GE(own.speed_mps - speed_before_mps, -kBraking_mps2 * kStep_s - 1e-12);
      ASSERT_GE(own.speed_mps, 0.0);
    }
  }
}

}  // namespace
}  // namespace lukou::traffic
