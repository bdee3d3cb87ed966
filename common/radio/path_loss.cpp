#include "common/radio/path_loss.hpp"

#include <algorithm>
#include <cmath>

#include "common/core/contract.hpp"
#include "common/core/math.hpp"
#include "common/intersection/geometry.hpp"

namespace lukou {
namespace {

constexpr double kFrequency_ghz = 5.9;
constexpr double kLightSpeed_mps = 299'792'458.0;
constexpr double kDistanceMin_m = 3.0;

constexpr double kLog10Frequency = 0.7708520116421442;  // log10(5.9)

double log10_of(double x) { return math::log(x) / 2.302585092994046; }

double size_of(double x) { return x < 0.0 ? -x : x; }

/// WINNER+ B1, clear sight.
double winner_clear_db(double distance_m, double height_m) {
  const double d = std::max(distance_m, kDistanceMin_m);
  const double break_m = 4.0 * height_m * height_m * kFrequency_ghz * 1e9 / kLightSpeed_mps;
  const double loss_db = d < break_m ? 22.7 * log10_of(d) + 27.0 + 20.0 * kLog10Frequency
                                     : 40.0 * log10_of(d) + 7.56 - 34.6 * log10_of(height_m) + 2.7 * kLog10Frequency;
  return std::max(loss_db, 20.0 * log10_of(d) + 46.4 + 20.0 * (kLog10Frequency - 0.6989700043360189));
}

/// WINNER+ B1 around a corner, seen from the street of the first leg.
double winner_leg_db(double first_m, double second_m, double height_m) {
  const double exponent = std::max(2.8 - 0.0024 * first_m, 1.84);
  return winner_clear_db(first_m, height_m) + 17.3 + 3.0 * kLog10Frequency - 12.5 * exponent +
         10.0 * exponent * log10_of(std::max(second_m, kDistanceMin_m));
}

double winner_corner_db(const PlanePoint& a, const PlanePoint& b, double height_m) {
  const double leg_a_m = size_of(along_street_m(a));
  const double leg_b_m = size_of(along_street_m(b));
  return std::max(winner_clear_db(distance_m(a, b), height_m),
                  std::min(winner_leg_db(leg_a_m, leg_b_m, height_m), winner_leg_db(leg_b_m, leg_a_m, height_m)));
}

}  // namespace

Street street_of(const PlanePoint& at) {
  const double x_m = size_of(at.x_m);
  const double y_m = size_of(at.y_m);
  if (std::max(x_m, y_m) <= kStopLineOffset_m) return Street::kJunction;
  return x_m > y_m ? Street::kEastWest : Street::kNorthSouth;
}

Arm arm_of(const PlanePoint& at) {
  if (size_of(at.x_m) >= size_of(at.y_m)) return at.x_m < 0.0 ? Arm::kWest : Arm::kEast;
  return at.y_m < 0.0 ? Arm::kSouth : Arm::kNorth;
}

bool around_corner(const PlanePoint& a, const PlanePoint& b) {
  const Street one = street_of(a);
  const Street other = street_of(b);
  return one != other && one != Street::kJunction && other != Street::kJunction;
}

double along_street_m(const PlanePoint& at) {
  switch (street_of(at)) {
    case Street::kEastWest:
      return at.x_m;
    case Street::kNorthSouth:
      return at.y_m;
    case Street::kJunction:
      break;
  }
  return at.x_m + at.y_m;
}

ShadowingLaw shadowing_law(const PathLossModel& model, Sight sight) {
  const double deviation_db = sight == Sight::kCorner ? 4.0 : 3.0;
  if (model.law == PathLossModel::Law::kWinnerB1) return {deviation_db, 10.0};
  return {deviation_db, sight == Sight::kClear ? 10.0 : 13.0};
}

double path_loss_db(const PathLossModel& model, Sight sight, const PlanePoint& a, const PlanePoint& b) {
  LUKOU_EXPECT(model.law != PathLossModel::Law::kNone);
  const double d = std::max(distance_m(a, b), kDistanceMin_m);
  if (model.law == PathLossModel::Law::kWinnerB1) {
    return sight == Sight::kCorner ? winner_corner_db(a, b, model.antenna_height_m)
                                   : winner_clear_db(d, model.antenna_height_m);
  }
  if (sight == Sight::kCorner) return 36.85 + 30.0 * log10_of(d) + 18.9 * kLog10Frequency;
  return 38.77 + 16.7 * log10_of(d) + 18.2 * kLog10Frequency;
}

double clear_probability(const PathLossModel& model, double distance_m) {
  if (model.law == PathLossModel::Law::kWinnerB1) return 1.0;
  return std::min(1.0, 1.05 * math::exp(-0.0114 * distance_m));
}

double blocker_mean_db(double distance_m) {
  return 9.0 + std::max(0.0, 15.0 * log10_of(std::max(distance_m, kDistanceMin_m)) - 41.0);
}

}  // namespace lukou
