#include "services/traffic_engine/model/follow_law.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "common/core/keyed_random.hpp"

namespace lukou::traffic {
namespace {

constexpr double kDesired_mps = 15.0;

class Follow : public testing::Test {
 protected:
  /// Acceleration of a car at 0 m.
  [[nodiscard]] double behind(double speed_mps, double distance_m, double ahead_mps, double ahead_mps2 = 0.0) const {
    return law_.following_mps2({0.0, speed_mps, 0.0}, kDesired_mps, {distance_m, ahead_mps, ahead_mps2});
  }
  FollowLaw law_{VehicleParameters{}, DrivingParameters{}};
};

TEST_F(Follow, KeepsSafeDistanceOfTheoryWithItsFloor) {
  EXPECT_DOUBLE_EQ(law_.safe_distance_m(0.0), 5.5);
  EXPECT_DOUBLE_EQ(law_.safe_distance_m(10.0), 19.8);         // 1.98 s * 10 m/s
  EXPECT_NEAR(law_.safe_distance_m(10.0 / 3.6), 5.5, 1e-12);  // at 10 km/h both are equal: 1.98 / 3.6 = 0.55
}

TEST_F(Follow, PerceivesSpeedDifferencesByTheAngleOfACarsWidth) {
  EXPECT_NEAR(law_.perceived_mps(30.0), 0.30, 1e-12);  // 6e-4 * 900 / 1.8
  EXPECT_NEAR(law_.perceived_mps(150.0), 7.5, 1e-12);  // 6e-4 * 22500 / 1.8
  EXPECT_DOUBLE_EQ(law_.perceived_mps(5.5), 0.02);     // 0.0101 is below the floor
}

TEST_F(Follow, DrivesFreelyBeyondTheReactionDistance) {
  EXPECT_DOUBLE_EQ(behind(14.0, 150.0, 0.0), 1.0);  // (15 - 14) / 1 s
  EXPECT_DOUBLE_EQ(behind(2.0, 150.0, 0.0), 3.0);   // 13 m/s2, cut to the limit
  EXPECT_LT(behind(14.0, 149.9, 0.0), 0.0);
}

TEST_F(Follow, BrakesHardWhenTooCloseAndNotOpening) {
  // Behind 10 m/s: S = 19.8 m, S / 1.10 = 18 m.
  EXPECT_DOUBLE_EQ(behind(12.0, 17.0, 10.0), -3.0);
  EXPECT_DOUBLE_EQ(behind(10.0, 15.0, 10.0), -3.0);  // below 0.8 S = 15.84 m even without closing in
}

TEST_F(Follow, EasesOffWhenALittleTooCloseAtTheSameSpeed) {
  EXPECT_DOUBLE_EQ(behind(10.0, 17.0, 10.0, 1.0), -0.3);
  EXPECT_DOUBLE_EQ(behind(10.0, 17.0, 10.0, -0.5), -0.8);
}

TEST_F(Follow, TakesTheSpeedOfTheGapWhenTooCloseButOpening) {
  // 17 m / 1.98 s = 8.5859 m/s; from 8 m/s in 1 s.
  EXPECT_NEAR(behind(8.0, 17.0, 10.0), 17.0 / 1.98 - 8.0, 1e-12);
}

TEST_F(Follow, BrakesToTheSpeedAheadWhenClosingIn) {
  // Equation (7) with the minus sign: S = 9.9 m, D = 30.1 m, dv = 7 m/s: 49 / 60.2.
  EXPECT_NEAR(behind(12.0, 40.0, 5.0), -49.0 / 60.2, 1e-12);
  EXPECT_NEAR(behind(12.0, 40.0, 5.0, 0.2), 0.2 - 49.0 / 60.2, 1e-12);
}

TEST_F(Follow, StopsBehindACarThatWillStandFirst) {
  // Ahead: 2 m/s, -2 m/s2, stands after 1 s and 1 m. S = 5.5 m, D = 24.5 m, dv = 8 m/s: (7) takes 6.125 s to match.
  // (7) gives -2 - 64 / 49 = -3.306; stopping after 30 + 1 - 5.5 = 25.5 m takes 100 / 51.
  EXPECT_NEAR(behind(10.0, 30.0, 2.0, -2.0), -100.0 / 51.0, 1e-12);
}

TEST_F(Follow, AcceleratesFreelyWhenOpeningAndFar) { EXPECT_DOUBLE_EQ(behind(5.0, 40.0, 10.0), 3.0); }

TEST_F(Follow, AcceleratesByEquation7WhenOpeningInsideTheBand) {
  // S = 19.8 m, band up to 22.5 m; D = 2.2 m, dv = -2 m/s: 0.1 + 4 / 4.4.
  EXPECT_NEAR(behind(8.0, 22.0, 10.0, 0.1), 0.1 + 4.0 / 4.4, 1e-12);
}

TEST_F(Follow, ClosesALargeGapGentlyWhenItSeesNoDifference) {
  EXPECT_DOUBLE_EQ(behind(10.0, 40.0, 10.0), 1.0);
  EXPECT_NEAR(behind(14.6, 40.0, 14.5), 0.4, 1e-12);  // the free acceleration is less
}

TEST_F(Follow, CopiesTheCarAheadInsideTheBand) {
  EXPECT_DOUBLE_EQ(behind(10.0, 20.0, 10.0, 0.4), 0.4);
  // dv = 0.1 m/s is not perceived at 20 m (0.133); D = 0.2 m is taken as 0.5 m: 0.01 / 1.
  EXPECT_NEAR(behind(10.1, 20.198, 10.0, 0.4), 0.4 - 0.01, 1e-12);
}

TEST_F(Follow, NeverWantsMoreThanTheFreeAcceleration) {
  for (std::uint64_t i = 0; i < 100000; ++i) {
    const auto u = [&](std::uint32_t n) { return uniform01({.run_seed = 7, .entity = n, .index = i}); };
    const Motion own{0.0, 17.0 * u(0), 0.0};
    const Motion ahead{4.6 + 160.0 * u(1), 17.0 * u(2), -3.0 + 6.0 * u(3)};
    const double wanted = law_.following_mps2(own, kDesired_mps, ahead);
    ASSERT_TRUE(std::isfinite(wanted));
    ASSERT_LE(wanted, law_.free_mps2(own.speed_mps, kDesired_mps));
  }
}

/// The sign table of the law: closing in never speeds up, opening never brakes, outside the band's close side.
TEST_F(Follow, HasTheSignOfTheSpeedDifference) {
  for (std::uint64_t i = 0; i < 100000; ++i) {
    const auto u = [&](std::uint32_t n) { return uniform01({.run_seed = 8, .entity = n, .index = i}); };
    const double speed_mps = 14.9 * u(0);
    const double ahead_mps = 14.9 * u(1);
    const double distance_m = law_.safe_distance_m(ahead_mps) + 100.0 * u(2);
    if (distance_m >= 150.0) continue;
    const double closing_mps = speed_mps - ahead_mps;
    const double wanted = behind(speed_mps, distance_m, ahead_mps);
    if (closing_mps > law_.perceived_mps(distance_m)) {
      ASSERT_LT(wanted, 0.0);
    }
    if (closing_mps < -law_.perceived_mps(distance_m)) {
      ASSERT_GT(wanted, 0.0);
    }
  }
}

TEST_F(Follow, BrakesComfortablyForAStop) {
  // 15 m/s from 150 m is exactly the comfortable 0.75 m/s2; from 100 m it takes 225 / 200.
  EXPECT_DOUBLE_EQ(law_.braking_to_mps2({0.0, 15.0, 0.0}, 15.0, 100.0), -1.125);
  EXPECT_DOUBLE_EQ(law_.braking_to_mps2({0.0, 15.0, 0.0}, 15.0, 150.0), 0.0);
}

TEST_F(Follow, RollsUpToAStopThatIsStillFar) {
  // 2 m/s, 50 m before it: steers to sqrt(2 * 0.75 * 50) = 8.66 m/s, with at most 1 m/s2.
  EXPECT_DOUBLE_EQ(law_.braking_to_mps2({0.0, 2.0, 0.0}, 15.0, 50.0), 1.0);
  // 0.5 m/s, 0.3 m before it: sqrt(0.45) = 0.6708 m/s within 1 s.
  EXPECT_NEAR(law_.braking_to_mps2({0.0, 0.5, 0.0}, 15.0, 0.3), std::sqrt(0.45) - 0.5, 1e-12);
  EXPECT_DOUBLE_EQ(law_.braking_to_mps2({0.0, 0.5, 0.0}, 15.0, -0.1), -3.0);
}

}  // namespace
}  // namespace lukou::traffic
