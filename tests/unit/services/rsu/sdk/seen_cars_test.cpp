#include "services/rsu/sdk/seen_cars.hpp"

#include <gtest/gtest.h>

namespace lukou {
namespace {

TEST(SeenCars, CountsACarOnceThatIsHeardAndSensedByTwoSensors) {
  const std::vector<HeardCar> heard = {{.distance_m = 12.0, .speed_mps = 3.0},
                                       {.distance_m = 300.0, .speed_mps = 15.0}};
  const std::vector<SensedCar> sensed = {{.sensor = 0, .distance_m = 6.5, .speed_mps = 1.0},
                                         {.sensor = 0, .distance_m = 12.4, .speed_mps = 2.8},
                                         {.sensor = 1, .distance_m = 12.2, .speed_mps = 2.9}};
  LaneView lane;
  lane.cars = heard;
  lane.sensed = sensed;
  std::vector<SeenCar> cars;
  seen_cars(lane, cars);
  ASSERT_EQ(cars.size(), 3U);
  EXPECT_EQ(cars[0].distance_m, 6.5);
  EXPECT_EQ(cars[1].distance_m, 12.0);
  EXPECT_EQ(cars[2].distance_m, 300.0);
}

TEST(SeenCars, KeepsCarsApartThatStandInAQueue) {
  // Heads stand 5.5 m apart.
  const std::vector<SensedCar> sensed = {{.distance_m = 0.1}, {.distance_m = 5.6}, {.distance_m = 11.1}};
  LaneView lane;
  lane.sensed = sensed;
  std::vector<SeenCar> cars = {{1.0, 1.0}};
  seen_cars(lane, cars);
  EXPECT_EQ(cars.size(), 3U);
}

}  // namespace
}  // namespace lukou
