#include "services/rsu/model/heard_cars.hpp"

#include <gtest/gtest.h>

namespace lukou {
namespace {

constexpr RoadLengths kRoad = {.approach_m = 500.0, .exit_m = 100.0};
constexpr Lane kLane = lane_of(Approach::kWest, Turn::kCenter);

/// A car without a length on WC, `distance_m` before the line.
CarReport report(std::uint64_t id, Step made, double distance_m) {
  return {.id = static_cast<TemporaryId>(id),
          .made = made,
          .place = {.centre_x_m = -15.5 - distance_m, .centre_y_m = -5.25, .heading_rad = 1.5707963, .length_m = 0.0},
          .speed_mps = 10.0,
          .acceleration_mps2 = 0.0};
}

TEST(HeardCars, StandFrontToBackAndByIdWhereEqual) {
  HeardCars cars(kRoad);
  cars.hear(report(9, 5, 80.0));
  cars.hear(report(3, 5, 120.0));
  cars.hear(report(4, 5, 80.0));
  cars.arrange(5);
  const auto lane = cars.cars(kLane);
  ASSERT_EQ(lane.size(), 3U);
  EXPECT_EQ(lane[0].id, TemporaryId{4});
  EXPECT_EQ(lane[1].id, TemporaryId{9});
  EXPECT_EQ(lane[2].id, TemporaryId{3});
  EXPECT_NEAR(lane[2].distance_m, 120.0, 1e-9);
  EXPECT_TRUE(cars.cars(lane_of(Approach::kWest, Turn::kLeft)).empty());
}

TEST(HeardCars, AreForgottenAfterASecondUnheard) {
  HeardCars cars(kRoad);
  cars.hear(report(1, 5, 80.0));
  cars.arrange(15);
  ASSERT_EQ(cars.cars(kLane).size(), 1U);
  EXPECT_EQ(cars.cars(kLane)[0].age, 10);
  cars.arrange(16);
  EXPECT_TRUE(cars.cars(kLane).empty());
  EXPECT_EQ(cars.report(TemporaryId{1}), nullptr);
}

TEST(HeardCars, CrossTheirLineBetweenTwoReports) {
  HeardCars cars(kRoad);
  cars.hear(report(1, 20, 0.75));
  EXPECT_FALSE(cars.last_crossing_s(kLane));
  cars.hear(report(1, 21, -0.25));
  cars.arrange(21);
  // Three quarters of the way from 2.0 s to 2.1 s.
  ASSERT_TRUE(cars.last_crossing_s(kLane));
  EXPECT_NEAR(*cars.last_crossing_s(kLane), 2.075, 1e-9);
  EXPECT_TRUE(cars.cars(kLane).empty());
}

TEST(HeardCars, HaveCrossedBySometimeWhenTheyAreNextHeardElsewhere) {
  HeardCars cars(kRoad);
  cars.hear(report(1, 20, 0.75));
  CarReport turned = report(1, 25, -8.0);
  turned.place.heading_rad = 3.0;
  cars.hear(turned);
  EXPECT_EQ(cars.last_crossing_s(kLane), 2.5);
}

TEST(HeardCars, TakeNoOldNewsAndNoCarThatWasNeverOnItsWay) {
  HeardCars cars(kRoad);
  cars.hear(report(1, 20, 50.0));
  cars.hear(report(1, 19, 51.0));
  cars.hear(report(2, 20, -3.0));
  cars.arrange(20);
  ASSERT_EQ(cars.cars(kLane).size(), 1U);
  EXPECT_NEAR(cars.cars(kLane)[0].distance_m, 50.0, 1e-9);
  EXPECT_FALSE(cars.last_crossing_s(kLane));
}

TEST(HeardCars, HaveNotCrossedWhenAnErrorPutsThemOffTheRoadFarFromTheLine) {
  HeardCars cars(kRoad);
  cars.hear(report(1, 20, 300.0));
  CarReport aside = report(1, 21, 299.0);
  aside.place.centre_y_m = 20.0;
  cars.hear(aside);
  cars.arrange(21);
  EXPECT_FALSE(cars.last_crossing_s(kLane));
  EXPECT_TRUE(cars.cars(kLane).empty());
  cars.hear(report(1, 22, 298.0));
  cars.arrange(22);
  EXPECT_EQ(cars.cars(kLane).size(), 1U);
}

TEST(HeardCars, AreNotYoungerThanNowWhenTheirClockIsAhead) {
  HeardCars cars(kRoad);
  cars.hear(report(1, 25, 80.0));
  cars.arrange(20);
  ASSERT_EQ(cars.cars(kLane).size(), 1U);
  EXPECT_EQ(cars.cars(kLane)[0].age, 0);
  cars.hear(report(1, 26, 79.0));  // the next one is news
  cars.arrange(21);
  EXPECT_NEAR(cars.cars(kLane)[0].distance_m, 79.0, 1e-9);
}

}  // namespace
}  // namespace lukou
