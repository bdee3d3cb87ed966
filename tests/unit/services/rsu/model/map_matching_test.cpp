#include "services/rsu/model/map_matching.hpp"

#include <gtest/gtest.h>

#include "common/messages/bsm.hpp"

namespace lukou {
namespace {

constexpr RoadLengths kRoad = {.approach_m = 500.0, .exit_m = 100.0};
constexpr double kLength_m = 4.5;

/// What a car would say whose front is at `position_m` of its lane's path.
ReportedPlace reported(Lane lane, double position_m) {
  const Pose front = pose_on_path(kRoad, lane, position_m);
  const PlanePoint centre = centre_of_car({front.x_m, front.y_m}, front.heading_rad, kLength_m);
  return {centre.x_m, centre.y_m, front.heading_rad, kLength_m};
}

TEST(MapMatching, FindsTheLaneAndTheDistanceOfEveryCarOnAnApproach) {
  for (int i = 0; i < kLanes; ++i) {
    const auto lane = static_cast<Lane>(i);
    for (const double position_m : {0.0, 1.0, 250.0, 499.0, 499.99}) {
      const auto place = match_to_map(kRoad, reported(lane, position_m));
      ASSERT_TRUE(place) << name(lane) << " at " << position_m;
      EXPECT_EQ(place->lane, lane);
      EXPECT_NEAR(place->distance_m, 500.0 - position_m, 1e-9);
    }
  }
}

TEST(MapMatching, FindsTheLaneOfACarThatIsOneStepBeyondTheLine) {
  for (int i = 0; i < kLanes; ++i) {
    const auto lane = static_cast<Lane>(i);
    const auto place = match_to_map(kRoad, reported(lane, 501.6));  // 16 m/s for 0.1 s
    ASSERT_TRUE(place) << name(lane);
    EXPECT_EQ(place->lane, lane);
    EXPECT_NEAR(place->distance_m, -1.6, 0.1);  // a turning car points a little aside
  }
}

TEST(MapMatching, NeverPutsACarThatHasCrossedBeforeALine) {
  for (int i = 0; i < kLanes; ++i) {
    for (double position_m = 500.01; position_m < 620.0; position_m += 0.37) {
      const auto place = match_to_map(kRoad, reported(static_cast<Lane>(i), position_m));
      EXPECT_LE(place ? place->distance_m : 0.0, 0.0) << i << " at " << position_m;
    }
  }
}

TEST(MapMatching, RefusesACarBesideTheRoadBeforeTheEntranceOrTurnedAway) {
  const ReportedPlace good = reported(lane_of(Approach::kWest, Turn::kCenter), 100.0);
  ASSERT_TRUE(match_to_map(kRoad, good));
  ReportedPlace beside = good;
  beside.centre_y_m = -10.6;  // three lanes are 10.5 m wide
  EXPECT_FALSE(match_to_map(kRoad, beside));
  ReportedPlace oncoming = good;
  oncoming.centre_y_m = 0.1;
  EXPECT_FALSE(match_to_map(kRoad, oncoming));
  ReportedPlace far = good;
  far.centre_x_m -= 110.0;
  EXPECT_FALSE(match_to_map(kRoad, far));
  ReportedPlace aslant = good;
  aslant.heading_rad += 0.6;  // 34 degrees
  EXPECT_FALSE(match_to_map(kRoad, aslant));
}

}  // namespace
}  // namespace lukou
