#include "services/rsu/sdk/planning.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

namespace lukou {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Green now, since 10 s, until 45 s; then red until 90 s, green until 135 s, red.
class LaneWithTwoGreens : public testing::Test {
 protected:
  LaneWithTwoGreens() {
    lane_.aspect = Aspect::kGreen;
    lane_.aspect_since = 100;
    lane_.changes = changes_;
  }
  std::array<SignalChange, 4> changes_ = {
      {{Aspect::kYellow, 450}, {Aspect::kRed, 480}, {Aspect::kGreen, 900}, {Aspect::kRed, 1350}}};
  LaneView lane_;
};

TEST_F(LaneWithTwoGreens, HasTwoWindows) {
  const auto windows = green_windows(lane_);
  ASSERT_EQ(windows.size(), 2U);
  EXPECT_DOUBLE_EQ(windows[0].begin_s, 10.0);
  EXPECT_DOUBLE_EQ(windows[0].end_s, 45.0);
  EXPECT_DOUBLE_EQ(windows[1].begin_s, 90.0);
  EXPECT_DOUBLE_EQ(windows[1].end_s, 135.0);
}

TEST_F(LaneWithTwoGreens, ShowsWhatTheLastChangeLeftIt) {
  EXPECT_EQ(aspect_at(lane_, 449), Aspect::kGreen);
  EXPECT_EQ(aspect_at(lane_, 450), Aspect::kYellow);
  EXPECT_EQ(aspect_at(lane_, 480), Aspect::kRed);
  EXPECT_EQ(aspect_at(lane_, 5000), Aspect::kRed) << "nothing is known of a later change";
}

TEST_F(LaneWithTwoGreens, GivesTheGreenThatACarCanUse) {
  EXPECT_DOUBLE_EQ(green_at_or_after(lane_, 45.0)->begin_s, 10.0) << "its last instant belongs to it";
  EXPECT_DOUBLE_EQ(green_at_or_after(lane_, 45.1)->begin_s, 90.0) << "waits for the next";
  EXPECT_DOUBLE_EQ(green_at_or_after(lane_, 47.0, 2.5)->begin_s, 10.0) << "within the tail";
  EXPECT_FALSE(green_at_or_after(lane_, 135.1)) << "nothing is known of a third";
}

TEST(GreenWindows, EndNeverWhereNoChangeIsKnown) {
  LaneView lane;
  lane.aspect = Aspect::kGreen;
  ASSERT_EQ(green_windows(lane).size(), 1U);
  EXPECT_EQ(green_windows(lane)[0].end_s, kInfinity);
  lane.aspect = Aspect::kRed;
  EXPECT_TRUE(green_windows(lane).empty());
}

TEST(TimeToLine, SpeedsUpAndThenHolds) {
  // From 5 to 15 m/s at 2 m/s2: 5 s and 50 m; the other 150 m at 15 m/s: 10 s.
  EXPECT_DOUBLE_EQ(time_to_line_s(200.0, 5.0, 2.0, 15.0), 15.0);
  // 24 m from 5 m/s at 2 m/s2: 5 t + t^2 = 24, t = 3.
  EXPECT_DOUBLE_EQ(time_to_line_s(24.0, 5.0, 2.0, 15.0), 3.0);
  EXPECT_DOUBLE_EQ(time_to_line_s(200.0, 20.0, 2.0, 15.0), 10.0) << "a faster car keeps its speed";
  EXPECT_DOUBLE_EQ(time_to_line_s(0.0, 5.0, 2.0, 15.0), 0.0);
  EXPECT_EQ(time_to_line_s(10.0, 0.0, 2.0, 0.0), kInfinity);
}

TEST(ArrivalAcceleration, BringsACarToTheLineInTime) {
  // 300 m, 15 m/s, 25 s: 2 (300 - 375) / 625 = -0.24, and the car ends at 2 * 300 / 25 - 15 = 9 m/s.
  EXPECT_DOUBLE_EQ(*arrival_acceleration_mps2(300.0, 15.0, 25.0), -0.24);
  EXPECT_DOUBLE_EQ(*arrival_acceleration_mps2(300.0, 15.0, 20.0), 0.0);
  EXPECT_DOUBLE_EQ(*arrival_acceleration_mps2(300.0, 15.0, 40.0), -0.375) << "just comes to a stand: 2 d / t = v";
  EXPECT_FALSE(arrival_acceleration_mps2(300.0, 15.0, 40.1));
}

TEST(CarriableAcceleration, IsWhatEveryCarTakesAndAMessageCarries) {
  EXPECT_DOUBLE_EQ(carriable_mps2(1.239, 3.0), 1.23);
  EXPECT_DOUBLE_EQ(carriable_mps2(-1.239, 3.0), -1.23);
  EXPECT_DOUBLE_EQ(carriable_mps2(7.0, 2.999), 2.99) << "rounding up would be beyond the limit";
  EXPECT_DOUBLE_EQ(carriable_mps2(-kInfinity, 3.0), -3.0);
  EXPECT_DOUBLE_EQ(carriable_mps2(std::nan(""), 3.0), 0.0);
  for (int hundredths = -300; hundredths <= 300; ++hundredths) {
    EXPECT_DOUBLE_EQ(carriable_mps2(hundredths / 100.0, 3.0), hundredths / 100.0) << "a multiple stays as it is";
  }
}

TEST(StandingQueue, CountsHeardCarsThatStand) {
  const std::array<HeardCar, 3> cars = {{{.distance_m = 2.0, .speed_mps = 0.0},
                                         {.distance_m = 13.0, .speed_mps = 1.0},
                                         {.distance_m = 40.0, .speed_mps = 1.5}}};
  LaneView lane;
  lane.cars = cars;
  EXPECT_EQ(standing_queue(lane).cars, 2U) << "5 km/h are 1.39 m/s";
  EXPECT_DOUBLE_EQ(standing_queue(lane).tail_m, 13.0);
  EXPECT_EQ(standing_queue(lane, 2.0).cars, 3U);
  EXPECT_EQ(standing_queue(LaneView{}).cars, 0U);
}

}  // namespace
}  // namespace lukou
