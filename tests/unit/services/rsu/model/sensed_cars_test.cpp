#include "services/rsu/model/sensed_cars.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <set>

namespace lukou {
namespace {

constexpr RoadLengths kRoad = {.approach_m = 500.0, .exit_m = 100.0};
constexpr Lane kLane = lane_of(Approach::kWest, Turn::kCenter);

/// A car on WC, its front `distance_m` before the line.
SensorReading reading(std::uint32_t sensor, std::uint32_t track, double distance_m, Step seen = 0) {
  return {.sensor = sensor,
          .track = track,
          .front_x_m = -15.5 - distance_m,
          .front_y_m = -5.25,
          .speed_mps = 10.0,
          .heading_rad = 1.5707963,
          .length_m = 4.5,
          .seen = seen};
}

TEST(SensedCars, StandOnTheirLaneFrontToBack) {
  SensedCars cars(kRoad);
  cars.begin(7);
  cars.take(reading(0, 30, 80.0, 5));
  cars.take(reading(1, 20, 40.0, 7));
  cars.take(reading(0, 10, 80.0, 6));
  cars.arrange();
  const auto lane = cars.cars(kLane);
  ASSERT_EQ(lane.size(), 3U);
  EXPECT_EQ(lane[0].track, 20U);
  EXPECT_EQ(lane[0].sensor, 1U);
  EXPECT_EQ(lane[0].age, 0);
  EXPECT_EQ(lane[1].track, 10U);  // equal distances: by sensor, then track
  EXPECT_EQ(lane[2].track, 30U);
  EXPECT_EQ(lane[2].age, 2);
  EXPECT_NEAR(lane[2].distance_m, 80.0, 1e-9);
  EXPECT_EQ(lane[2].speed_mps, 10.0);
  EXPECT_TRUE(cars.cars(lane_of(Approach::kWest, Turn::kLeft)).empty());
}

TEST(SensedCars, AreThoseOfTheStepAlone) {
  SensedCars cars(kRoad);
  cars.begin(0);
  cars.take(reading(0, 1, 80.0));
  cars.arrange();
  cars.begin(1);
  cars.arrange();
  EXPECT_TRUE(cars.cars(kLane).empty());
  EXPECT_TRUE(cars.readings().empty());
}

TEST(SensedCars, TellOfOneTrackWhatWasSeenLast) {
  SensedCars cars(kRoad);
  cars.begin(9);
  cars.take(reading(0, 1, 80.0, 8));
  cars.take(reading(0, 1, 78.0, 9));
  cars.take(reading(0, 1, 82.0, 7));
  cars.arrange();
  ASSERT_EQ(cars.cars(kLane).size(), 1U);
  EXPECT_NEAR(cars.cars(kLane)[0].distance_m, 78.0, 1e-9);
}

TEST(SensedCars, OffTheMapAreNumberedButStandOnNoLane) {
  SensedCars cars(kRoad);
  cars.begin(0);
  cars.take(reading(0, 1, -0.5));  // an error puts it beyond the line
  SensorReading aside = reading(0, 2, 50.0);
  aside.front_y_m = 3.0;
  cars.take(aside);
  SensorReading nowhere = reading(0, 3, 50.0);
  nowhere.front_x_m = std::numeric_limits<double>::quiet_NaN();
  cars.take(nowhere);
  cars.arrange();
  for (int lane = 0; lane < kLanes; ++lane) EXPECT_TRUE(cars.cars(static_cast<Lane>(lane)).empty());
  EXPECT_EQ(cars.readings().size(), 3U);
}

TEST(SensedCars, KeepTheirNumberUntilUnseenForASecond) {
  SensedCars cars(kRoad);
  const auto number_at = [&](Step now) {
    cars.begin(now);
    cars.take(reading(2, 77, 50.0, now));
    cars.arrange();
    return cars.readings()[0].number;
  };
  EXPECT_EQ(number_at(0), 1);
  EXPECT_EQ(number_at(10), 1);
  EXPECT_EQ(number_at(21), 2);
}

TEST(SensedCars, ShareNoNumberWhenNumbersHaveGoneRound) {
  SensedCars cars(kRoad);
  cars.begin(0);
  cars.take(reading(0, 0, 50.0));  // number 1, seen in every step
  cars.arrange();
  std::uint32_t track = 1;
  for (Step now = 1; now <= 700; ++now) {
    cars.begin(now);
    cars.take(reading(0, 0, 50.0, now));
    for (int i = 0; i < 100; ++i) cars.take(reading(0, track++, 60.0, now));
    cars.arrange();
    std::set<std::uint16_t> numbers;
    for (const NumberedReading& item : cars.readings()) numbers.insert(item.number);
    EXPECT_EQ(numbers.size(), 101U);
    EXPECT_EQ(cars.readings()[0].number, 1);
    EXPECT_EQ(cars.readings()[0].reading.track, 0U);
    EXPECT_FALSE(numbers.contains(0));
  }
}

}  // namespace
}  // namespace lukou
