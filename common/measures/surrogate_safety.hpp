#pragma once

#include <optional>

namespace lukou {

// Surrogate measures of a car that follows another on the same path: how near they are to a collision. Thresholds are
// the defaults of SUMO's SSM device where it has one.

inline constexpr double kTtc_s = 3.0;              ///< below it an encounter (SUMO)
inline constexpr double kTtcCritical_s = 1.5;      ///< Van der Horst (1990), as SUMO cites
inline constexpr double kDrac_mps2 = 3.0;          ///< from it on an encounter (SUMO)
inline constexpr double kDracCritical_mps2 = 3.4;  ///< from it on critical; AASHTO's comfortable limit of braking
inline constexpr double kMttc_s = 3.0;             ///< below it an encounter; the threshold of TTC
inline constexpr double kPet_s = 2.0;              ///< below it an encounter (SUMO)
inline constexpr double kHardBraking_mps2 = -3.0 + 1e-6;  ///< at least as hard: 3 m/s2, less rounding
inline constexpr double kJerk_mps3 = 3.0;  ///< a jerk with more than this, of either sign; assumed, 2 ... 3 is common

/// A follower and the car ahead of it.
struct Following {
  double gap_m = 0.0;          ///< between the bodies
  double approach_mps = 0.0;   ///< follower's speed less leader's; > 0 closes in
  double approach_mps2 = 0.0;  ///< follower's acceleration less leader's
};

/// Time to collision at constant speeds [s], >= 0; empty if they do not close in.
std::optional<double> time_to_collision_s(const Following& pair);
/// Deceleration that just avoids the collision if the leader keeps its speed [m/s2]; infinite without a gap; empty if
/// they do not close in.
std::optional<double> deceleration_to_avoid_crash_mps2(const Following& pair);
/// Time to collision at constant accelerations [s], >= 0; empty if they never meet. Source: Ozbay, Yang, Bartin,
/// Mudigonda (2008), Transp. Res. Record 2083.
std::optional<double> modified_time_to_collision_s(const Following& pair);

// The same against the thresholds, without a division.

inline bool is_ttc_encounter(const Following& pair) {
  return pair.approach_mps > 0.0 && pair.gap_m < kTtc_s * pair.approach_mps;
}
inline bool is_drac_encounter(const Following& pair) {
  return pair.approach_mps > 0.0 && pair.approach_mps * pair.approach_mps >= 2.0 * kDrac_mps2 * pair.gap_m;
}
inline bool is_mttc_encounter(const Following& pair) {
  const double closed_m = pair.approach_mps * kMttc_s + 0.5 * pair.approach_mps2 * kMttc_s * kMttc_s;
  if (closed_m > pair.gap_m) return true;
  // They may have met before and be apart again by then.
  return pair.approach_mps > 0.0 && pair.approach_mps < -pair.approach_mps2 * kMttc_s &&
         pair.approach_mps * pair.approach_mps + 2.0 * pair.approach_mps2 * pair.gap_m >= 0.0;
}

}  // namespace lukou
