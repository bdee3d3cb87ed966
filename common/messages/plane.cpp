#include "common/messages/plane.hpp"

#include <cmath>

#include "common/core/math.hpp"

namespace lukou {
namespace {

constexpr double kEarthRadius_m = 6371008.8;  // mean radius of the WGS 84 ellipsoid
constexpr double kRadiansPerUnit = math::kPi / 180.0 * 1e-7;
constexpr double kNorth_m = kEarthRadius_m * kRadiansPerUnit;  // length of 1e-7 degree along a meridian

/// Length of 1e-7 degree along the parallel of the reference point [m].
double east_m() {
  static const double kEast = kNorth_m * math::cos(kGeoReference.latitude_e7 * kRadiansPerUnit);
  return kEast;
}

/// `reference` + `units`, rounded to the nearest integer, if it lies within [low, high].
std::optional<std::int32_t> rounded(std::int32_t reference, double units, double low, double high) {
  const double sum = reference + units;
  if (!(sum >= low && sum <= high)) return std::nullopt;
  return static_cast<std::int32_t>(sum < 0.0 ? sum - 0.5 : sum + 0.5);
}

}  // namespace

GeoPoint to_geo(const PlanePoint& point) {
  const auto latitude_e7 = rounded(kGeoReference.latitude_e7, point.y_m / kNorth_m, -9e8, 9e8);
  const auto longitude_e7 = rounded(kGeoReference.longitude_e7, point.x_m / east_m(), -1799999999.0, 1.8e9);
  if (!latitude_e7 || !longitude_e7) return kGeoUnavailable;
  return {*latitude_e7, *longitude_e7};
}

std::optional<PlanePoint> to_plane(const GeoPoint& point) {
  if (point.latitude_e7 < -900'000'000 || point.latitude_e7 > 900'000'000) return std::nullopt;
  if (point.longitude_e7 < -1'799'999'999 || point.longitude_e7 > 1'800'000'000) return std::nullopt;
  return PlanePoint{.x_m = (static_cast<double>(point.longitude_e7) - kGeoReference.longitude_e7) * east_m(),
                    .y_m = (static_cast<double>(point.latitude_e7) - kGeoReference.latitude_e7) * kNorth_m};
}

double distance_m(const PlanePoint& a, const PlanePoint& b) {
  const double x_m = a.x_m - b.x_m;
  const double y_m = a.y_m - b.y_m;
  return std::sqrt(x_m * x_m + y_m * y_m);
}

}  // namespace lukou
