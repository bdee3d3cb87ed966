#pragma once

#include <cstdint>
#include <optional>

namespace lukou {

/// A point of the intersection's plane: origin at the centre of the junction, x to the east, y to the north [m].
struct PlanePoint {
  double x_m = 0.0;
  double y_m = 0.0;
};

/// A point as messages carry it, 1e-7 degree (about 11 mm to the north).
struct GeoPoint {
  std::int32_t latitude_e7 = 0;   ///< [-900000000, 900000000], 900000001 = unavailable
  std::int32_t longitude_e7 = 0;  ///< [-1799999999, 1800000000], 1800000001 = unavailable

  friend bool operator==(const GeoPoint&, const GeoPoint&) = default;
};

inline constexpr GeoPoint kGeoUnavailable = {900000001, 1800000001};

/// Where the centre of the junction lies on the globe: 31.2860 N, 121.2100 E; assumed. The only place that says so.
inline constexpr GeoPoint kGeoReference = {312860000, 1212100000};

/// Equirectangular about the reference point, on a sphere of 6371008.8 m (mean radius of WGS 84).
/// A point that is not finite, or leaves the range of the coordinates, becomes `kGeoUnavailable`.
GeoPoint to_geo(const PlanePoint& point);
/// Inverse of to_geo; empty if unavailable or out of range. Round-trip error: at most half a unit in each coordinate.
std::optional<PlanePoint> to_plane(const GeoPoint& point);

/// Between two points [m].
double distance_m(const PlanePoint& a, const PlanePoint& b);

}  // namespace lukou
