#include "common/measures/fuel.hpp"

#include <gtest/gtest.h>

namespace lukou {
namespace {

constexpr double kCruise_mps = 50.0 / 3.6;

TEST(Fuel, OfAStandingCarIsTheIdleRate) {
  EXPECT_DOUBLE_EQ(kamal_fuel(0.0, 0.0).total_ml_per_s(), 0.1569);
  EXPECT_DOUBLE_EQ(cpfm_fuel_ml_per_s(0.0, 0.0), 0.47738);
}

TEST(Fuel, At50KmhIsThatOfTheWorkedExample) {
  // v = 13.8889: 0.1569 + 0.0245 v = 0.497178; - 7.415e-4 v^2 (192.901) = 0.354142; + 5.975e-5 v^3 (2679.18) = 0.514223
  const FuelRate rate = kamal_fuel(kCruise_mps, 0.0);
  EXPECT_NEAR(rate.steady_ml_per_s, 0.514223, 2e-6);
  EXPECT_DOUBLE_EQ(rate.accelerating_ml_per_s, 0.0);
  // 7.2 s for 100 m: 3.70 l/100 km.
  EXPECT_NEAR(rate.total_ml_per_s() * 7200.0 / 1000.0, 3.70, 0.005);
  // Rolling 1453 * 9.8066 * 1.75e-3 * (0.0328 * 50 + 4.575) = 154.97 N, air 0.426509 * 192.901 = 82.27 N;
  // 237.25 N * 13.8889 / 920 = 3.5817 kW; 0.47738 + 0.05363 * 3.5817 + 0.001 * 12.829 = 0.68230
  EXPECT_NEAR(cpfm_fuel_ml_per_s(kCruise_mps, 0.0), 0.68230, 1e-4);
}

TEST(Fuel, OfBrakingIsThatOfTheSpeedAlone) {
  EXPECT_DOUBLE_EQ(kamal_fuel(10.0, -3.0).total_ml_per_s(), kamal_fuel(10.0, 0.0).total_ml_per_s());
  // Power below zero is no fuel back: the engine idles.
  EXPECT_DOUBLE_EQ(cpfm_fuel_ml_per_s(10.0, -3.0), 0.47738);
}

TEST(Fuel, OfAStopFrom50KmhIsTwelveMillilitresMoreThanCruising) {
  // Down and up again with 2 m/s2, in short steps. By integration over the speed, with V = 13.8889:
  // steady part, each way: (0.1569 V + 0.0245 V^2/2 - 7.415e-4 V^3/3 + 5.975e-5 V^4/4) / 2 = 4.43584 / 2 = 2.21792
  // acceleration, once: 0.07224 V + 0.09681 V^2/2 + 0.001075 V^3/3 = 11.30076
  // both: 15.7366. The same way at 50 km/h: V^2 / 2 = 96.451 m, 6.94444 s * 0.514223 = 3.57099. Difference: 12.1656.
  constexpr double kDt_s = 1e-3;
  constexpr double kRate_mps2 = 2.0;
  double burnt_ml = 0.0;
  double way_m = 0.0;
  double check_ml = 0.0;
  for (int sign = -1; sign <= 1; sign += 2) {
    const int steps = static_cast<int>(kCruise_mps / kRate_mps2 / kDt_s);
    for (int i = 0; i < steps; ++i) {
      const double changed_mps = kRate_mps2 * kDt_s * (i + 0.5);
      const double speed_mps = sign < 0 ? kCruise_mps - changed_mps : changed_mps;
      burnt_ml += kamal_fuel(speed_mps, sign * kRate_mps2).total_ml_per_s() * kDt_s;
      check_ml += cpfm_fuel_ml_per_s(speed_mps, sign * kRate_mps2) * kDt_s;
      way_m += speed_mps * kDt_s;
    }
  }
  const double cruise_s = way_m / kCruise_mps;
  EXPECT_NEAR(burnt_ml - kamal_fuel(kCruise_mps, 0.0).total_ml_per_s() * cruise_s, 12.166, 0.01);
  // The check: 0.47738 * 13.8889 s of idling = 6.630. To accelerate: energy 1511.12 * V^2/2 = 145.75 kJ and resistance
  // on the way 8.80 kJ, over 920: 167.99 kW s * 0.05363 = 9.009. Square: with the mean force of 3216 N, weighted by
  // v^2, (3216 / 920)^2 * V^3 / 6 = 5457 * 0.001 = 5.457. Together 21.096; cruising 6.94444 s * 0.68229 = 4.738.
  EXPECT_NEAR(check_ml - cpfm_fuel_ml_per_s(kCruise_mps, 0.0) * cruise_s, 16.358, 0.02);
}

TEST(Fuel, OfALitreGivesTheCarbonDioxideOfPetrol) {
  EXPECT_NEAR(kCo2_kg_per_l, 2.3477, 1e-4);  // 8.887 kg / 3.785412 l
}

}  // namespace
}  // namespace lukou
