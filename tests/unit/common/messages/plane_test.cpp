#include "common/messages/plane.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace lukou {
namespace {

// 1e-7 degree along a meridian: 6371008.8 m * pi / 180 * 1e-7.
constexpr double kNorthUnit_m = 0.011119508;

TEST(Plane, PutsTheCentreOfTheJunctionAtTheReference) {
  EXPECT_EQ(to_geo({0.0, 0.0}), kGeoReference);
  const auto point = to_plane(kGeoReference);
  ASSERT_TRUE(point);
  EXPECT_EQ(point->x_m, 0.0);
  EXPECT_EQ(point->y_m, 0.0);
}

TEST(Plane, GoesNorthAlongTheMeridian) {
  // 1000 m / 0.011119508 m = 89931.999
  EXPECT_EQ(to_geo({0.0, 1000.0}).latitude_e7, kGeoReference.latitude_e7 + 89932);
  EXPECT_EQ(to_geo({0.0, 1000.0}).longitude_e7, kGeoReference.longitude_e7);
}

TEST(Plane, GoesEastAlongTheParallel) {
  // A parallel is shorter by the cosine of the latitude: 0.0111195 m * cos(31.286 degrees).
  const double east_unit_m = kNorthUnit_m * std::cos(31.286 * std::acos(-1.0) / 180.0);
  EXPECT_NEAR(to_geo({1000.0, 0.0}).longitude_e7 - kGeoReference.longitude_e7, 1000.0 / east_unit_m, 0.51);
}

TEST(Plane, ReturnsEachPointWithinHalfAUnit) {
  for (double x_m = -617.3; x_m < 620.0; x_m += 12.34567) {
    for (double y_m = -611.9; y_m < 620.0; y_m += 45.678901) {
      const auto point = to_plane(to_geo({x_m, y_m}));
      ASSERT_TRUE(point);
      EXPECT_NEAR(point->x_m, x_m, 0.5 * kNorthUnit_m * 0.8547);  // cos(31.286 degrees) = 0.85462
      EXPECT_NEAR(point->y_m, y_m, 0.5 * kNorthUnit_m * 1.00001);
    }
  }
}

TEST(Plane, KnowsNoPlaceForWhatIsNoPoint) {
  EXPECT_EQ(to_geo({std::numeric_limits<double>::quiet_NaN(), 0.0}), kGeoUnavailable);
  EXPECT_EQ(to_geo({0.0, std::numeric_limits<double>::infinity()}), kGeoUnavailable);
  EXPECT_EQ(to_geo({0.0, 1e8}), kGeoUnavailable);  // beyond the pole
  EXPECT_FALSE(to_plane(kGeoUnavailable));
  EXPECT_FALSE(to_plane({kGeoReference.latitude_e7, -1'800'000'000}));
}

}  // namespace
}  // namespace lukou
