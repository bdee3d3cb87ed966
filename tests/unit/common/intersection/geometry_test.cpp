#include "common/intersection/geometry.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "common/core/math.hpp"

namespace lukou {
namespace {

constexpr double kPi = math::kPi;
constexpr RoadLengths kRoad{.approach_m = 500.0, .exit_m = 100.0};
constexpr double kTolerance = 1e-9;

struct Place {
  const char* lane;
  double x_m;
  double y_m;
  double heading_rad;
};

void expect_at(const Place& place, double position_m) {
  const Pose pose = pose_on_path(kRoad, *lane_named(place.lane), position_m);
  EXPECT_NEAR(pose.x_m, place.x_m, kTolerance) << place.lane;
  EXPECT_NEAR(pose.y_m, place.y_m, kTolerance) << place.lane;
  EXPECT_NEAR(pose.heading_rad, place.heading_rad, kTolerance) << place.lane;
}

double distance_m(const Pose& a, const Pose& b) { return std::hypot(a.x_m - b.x_m, a.y_m - b.y_m); }

// Lanes are 3.5 m wide, the first one's middle is 1.75 m from the axis, the stop line 15.5 m from the centre; cars keep
// to the right, so those from the west (heading east, pi/2) drive south of their axis.
TEST(Geometry, PutsTheStopLinesWhereTheDrawingHasThem) {
  const Place kLines[] = {
      {"WL", -15.5, -1.75, kPi / 2},   {"WC", -15.5, -5.25, kPi / 2},   {"WR", -15.5, -8.75, kPi / 2},
      {"SL", 1.75, -15.5, 0},          {"SC", 5.25, -15.5, 0},          {"SR", 8.75, -15.5, 0},
      {"EL", 15.5, 1.75, 3 * kPi / 2}, {"EC", 15.5, 5.25, 3 * kPi / 2}, {"ER", 15.5, 8.75, 3 * kPi / 2},
      {"NL", -1.75, 15.5, kPi},        {"NC", -5.25, 15.5, kPi},        {"NR", -8.75, 15.5, kPi}};
  for (const Place& line : kLines) expect_at(line, kRoad.approach_m);
}

TEST(Geometry, PutsTheEntranceTheApproachsLengthBeforeTheStopLine) {
  expect_at({"WL", -515.5, -1.75, kPi / 2}, 0.0);
  expect_at({"NR", -8.75, 515.5, kPi}, 0.0);
  expect_at({"SC", 5.25, -115.5, 0.0}, 400.0);
}

TEST(Geometry, LetsEachTurnEndOnItsOwnExitLane) {
  // A left turn from the west is a quarter circle of radius 15.5 + 1.75 about (-15.5, 15.5), it ends heading north;
  // a right turn one of 15.5 - 8.75 about (-15.5, -15.5), it ends heading south; straight on it is 31 m.
  EXPECT_NEAR(curve_length_m(*lane_named("WL")), kPi / 2 * 17.25, kTolerance);
  EXPECT_NEAR(curve_length_m(*lane_named("WC")), 31.0, kTolerance);
  EXPECT_NEAR(curve_length_m(*lane_named("WR")), kPi / 2 * 6.75, kTolerance);
  expect_at({"WL", 1.75, 15.5, 0.0}, 500.0 + kPi / 2 * 17.25);
  expect_at({"WC", 15.5, -5.25, kPi / 2}, 531.0);
  expect_at({"WR", -8.75, -15.5, kPi}, 500.0 + kPi / 2 * 6.75);
  // Half way round: the point of the circle at 45 degrees.
  const double half = std::sqrt(0.5);
  expect_at({"WL", -15.5 + 17.25 * half, 15.5 - 17.25 * half, kPi / 4}, 500.0 + kPi / 4 * 17.25);
  expect_at({"WR", -15.5 + 6.75 * half, -15.5 + 6.75 * half, 3 * kPi / 4}, 500.0 + kPi / 4 * 6.75);
}

TEST(Geometry, EndsTheExitLaneTheExitsLengthBehindTheStopLine) {
  expect_at({"WC", -15.5 + 100.0, -5.25, kPi / 2}, 600.0);
  expect_at({"WL", 1.75, 15.5 + 100.0 - kPi / 2 * 17.25, 0.0}, 600.0);
  expect_at({"WR", -8.75, -15.5 - (100.0 - kPi / 2 * 6.75), kPi}, 600.0);
}

TEST(Geometry, GivesNoTwoLanesTheSameExit) {
  for (int i = 0; i < kLanes; ++i) {
    for (int j = 0; j < i; ++j) {
      const Pose a = pose_on_path(kRoad, static_cast<Lane>(i), 600.0);
      const Pose b = pose_on_path(kRoad, static_cast<Lane>(j), 600.0);
      // Across the direction of travel the middles of two exit lanes of one arm are at least a lane's width apart.
      const bool same_arm = std::abs(std::remainder(a.heading_rad - b.heading_rad, 2 * kPi)) < kTolerance;
      if (!same_arm) continue;
      const double across_m =
          std::abs((a.x_m - b.x_m) * std::cos(a.heading_rad) - (a.y_m - b.y_m) * std::sin(a.heading_rad));
      EXPECT_GT(across_m, kLaneWidth_m - kTolerance) << name(static_cast<Lane>(i)) << name(static_cast<Lane>(j));
    }
  }
}

TEST(Geometry, SharesNoExitLaneWithAnApproachLane) {
  for (int i = 0; i < kLanes; ++i) {
    for (int j = 0; j < kLanes; ++j) {
      const Pose leaving = pose_on_path(kRoad, static_cast<Lane>(i), 580.0);
      for (double position_m = 380.0; position_m <= 500.0; position_m += 1.0) {
        EXPECT_GT(distance_m(leaving, pose_on_path(kRoad, static_cast<Lane>(j), position_m)), 3.0);
      }
    }
  }
}

TEST(Geometry, LeadsEveryPathOnWithoutAJumpOrAKink) {
  constexpr double kPiece_m = 0.05;
  for (int i = 0; i < kLanes; ++i) {
    const auto lane = static_cast<Lane>(i);
    for (double position_m = 480.0; position_m < 560.0; position_m += kPiece_m) {
      const Pose from = pose_on_path(kRoad, lane, position_m);
      const Pose middle = pose_on_path(kRoad, lane, position_m + kPiece_m / 2);
      const Pose to = pose_on_path(kRoad, lane, position_m + kPiece_m);
      // A chord of the smallest circle (6.75 m) is shorter than its arc by s^3 / (24 r^2) = 1.2e-7 m.
      ASSERT_NEAR(distance_m(from, to), kPiece_m, 2e-7) << name(lane) << " at " << position_m;
      // The heading in the middle points along the chord.
      const double along_m =
          (to.x_m - from.x_m) * std::sin(middle.heading_rad) + (to.y_m - from.y_m) * std::cos(middle.heading_rad);
      ASSERT_NEAR(along_m, kPiece_m, 1e-6) << name(lane) << " at " << position_m;
      ASSERT_GE(from.heading_rad, 0.0);
      ASSERT_LT(from.heading_rad, 2 * kPi);
    }
  }
}

TEST(Geometry, MakesThePathAsLongAsItsParametersSay) {
  for (const RoadLengths& road : {kRoad, RoadLengths{.approach_m = 200.0, .exit_m = 60.0}}) {
    for (int i = 0; i < kLanes; ++i) {
      const auto lane = static_cast<Lane>(i);
      constexpr int kPieces = 26000;
      const double whole_m = road.approach_m + road.exit_m;
      double length_m = 0.0;
      Pose before = pose_on_path(road, lane, 0.0);
      for (int n = 1; n <= kPieces; ++n) {
        const Pose now = pose_on_path(road, lane, whole_m * n / kPieces);
        length_m += distance_m(before, now);
        before = now;
      }
      EXPECT_NEAR(length_m, whole_m, 1e-4) << name(lane);
    }
  }
}

TEST(Geometry, LooksTheSameFromAllFourSides) {
  // From west to south is a quarter turn counter-clockwise of the plane: (x, y) -> (-y, x), the heading 90 degrees
  // less.
  for (int i = 0; i < kLanes; ++i) {
    const auto lane = static_cast<Lane>(i);
    const auto next = static_cast<Lane>((i + kLanesPerApproach) % kLanes);
    for (double position_m = 0.0; position_m <= 600.0; position_m += 3.7) {
      const Pose a = pose_on_path(kRoad, lane, position_m);
      const Pose b = pose_on_path(kRoad, next, position_m);
      ASSERT_NEAR(b.x_m, -a.y_m, kTolerance);
      ASSERT_NEAR(b.y_m, a.x_m, kTolerance);
      ASSERT_NEAR(std::remainder(b.heading_rad - a.heading_rad + kPi / 2, 2 * kPi), 0.0, kTolerance);
    }
  }
}

}  // namespace
}  // namespace lukou
