#pragma once

#include <algorithm>

namespace lukou {

/// What a car burns [mL/s], in two parts that add up.
struct FuelRate {
  double steady_ml_per_s = 0.0;        ///< at this speed, not accelerating
  double accelerating_ml_per_s = 0.0;  ///< on top of it, for the acceleration; 0 while braking

  [[nodiscard]] double total_ml_per_s() const { return steady_ml_per_s + accelerating_ml_per_s; }
};

/// A petrol car on a level road. Source: Kamal, Mukai, Murata, Kawabe (2013), IEEE Trans. Control Systems Technology
/// 21(3). Requires speed_mps >= 0.
inline FuelRate kamal_fuel(double speed_mps, double acceleration_mps2) {
  const double steady = 0.1569 + speed_mps * (2.45e-2 + speed_mps * (-7.415e-4 + speed_mps * 5.975e-5));
  const double per_mps2 = 7.224e-2 + speed_mps * (9.681e-2 + speed_mps * 1.075e-3);
  return {steady, std::max(acceleration_mps2, 0.0) * per_mps2};
}

/// The check: VT-CPFM-1 of a Honda Civic [mL/s]. Source: Rakha, Ahn, Moran, Saerens, Van den Bulck (2011), Transp. Res.
/// D 16; coefficients of Kamalanathsharma (2014), table 7.3.
inline double cpfm_fuel_ml_per_s(double speed_mps, double acceleration_mps2) {
  constexpr double kMass_kg = 1453.0;
  constexpr double kInertia_kg = 1.04 * kMass_kg;  // rotating masses: 4 %
  constexpr double kGravity_mps2 = 9.8066;
  constexpr double kRolling_n = kMass_kg * kGravity_mps2 * 1.75 / 1000.0;
  constexpr double kDrag_kg_per_m = 0.5 * 1.2256 * 0.30 * 2.32;  // air density, drag coefficient, front area
  constexpr double kWattsToKilowatts = 1.0 / (1000.0 * 0.92);    // efficiency of the driveline
  const double force_n = kInertia_kg * acceleration_mps2 + kRolling_n * (0.0328 * 3.6 * speed_mps + 4.575) +
                         kDrag_kg_per_m * speed_mps * speed_mps;
  const double power_kw = std::max(force_n * speed_mps * kWattsToKilowatts, 0.0);
  return 0.47738 + power_kw * (5.363e-2 + power_kw * 1e-3);
}

/// CO2 of a litre of petrol [kg]. Source: US EPA, 8,887 g per gallon of 3.785412 l.
inline constexpr double kCo2_kg_per_l = 8.887 / 3.785412;

/// What some cars have burnt [mL].
struct FuelTotals {
  double fuel_ml = 0.0;
  double standing_ml = 0.0;      ///< of it while slower than the stop speed
  double accelerating_ml = 0.0;  ///< of the rest the accelerating part
  double check_ml = 0.0;         ///< all of it by the other model

  FuelTotals& operator+=(const FuelTotals& other) {
    fuel_ml += other.fuel_ml;
    standing_ml += other.standing_ml;
    accelerating_ml += other.accelerating_ml;
    check_ml += other.check_ml;
    return *this;
  }
};

}  // namespace lukou
