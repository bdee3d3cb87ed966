#include "common/measures/crossing_watch.hpp"

#include <gtest/gtest.h>

#include <map>

#include "common/intersection/crossing.hpp"

namespace lukou {
namespace {

constexpr Lane kWestCenter = lane_of(Approach::kWest, Turn::kCenter);
constexpr Lane kWestLeft = lane_of(Approach::kWest, Turn::kLeft);
constexpr Lane kEastCenter = lane_of(Approach::kEast, Turn::kCenter);
constexpr Lane kSouthCenter = lane_of(Approach::kSouth, Turn::kCenter);
constexpr double kLength_m = 4.5;
constexpr double kSpeed_mps = 10.0;

/// Cars at 10 m/s: one metre a step.
class Junction : public testing::Test {
 protected:
  /// The car's front is at its stop line at `line_s`.
  void car(std::uint32_t vehicle, Lane lane, double line_s) { cars_[vehicle] = {lane, line_s, 0}; }
  void run(double until_s) {
    for (int k = 0; k * 0.1 <= until_s; ++k) {
      const double now_s = k / 10.0;
      for (auto& [vehicle, it] : cars_) {
        const double past_m = (now_s - it.line_s) * kSpeed_mps;
        if (past_m <= 0.0) continue;
        watch_.move(
            {.vehicle = vehicle, .lane = it.lane, .position_m = road_.approach_m + past_m, .speed_mps = kSpeed_mps},
            now_s, it.next_mark);
      }
      for (const PostEncroachment& pair : watch_.settle()) found_.push_back(pair);
    }
  }

  RoadLengths road_;
  CrossingWatch watch_{road_, kLength_m};
  struct Path {
    Lane lane{};
    double line_s = 0.0;
    std::size_t next_mark = 0;
  };
  std::map<std::uint32_t, Path> cars_;
  std::vector<PostEncroachment> found_;
};

TEST_F(Junction, MeasuresFromTheFirstsRearToTheSecondsFront) {
  // The rear of the car from the west is out to_m + 4.5 m past its line; the front from the south comes in from_m past
  // its own. At 10 m/s, lines reached at 1 s and 3 s: PET = 3 + from/10 - (1 + (to + 4.5)/10).
  const double to_m = crossing_area(kWestCenter, kSouthCenter)->to_m;
  const double from_m = crossing_area(kSouthCenter, kWestCenter)->from_m;
  car(0, kWestCenter, 1.0);
  car(1, kSouthCenter, 3.0);
  run(8.0);
  ASSERT_EQ(found_.size(), 1U);
  EXPECT_EQ(found_[0].first.vehicle, 0U);
  EXPECT_EQ(found_[0].second.vehicle, 1U);
  EXPECT_NEAR(found_[0].pet_s, 2.0 + (from_m - to_m - kLength_m) / kSpeed_mps, 1e-9);
  EXPECT_NEAR(found_[0].entered_s, 3.0 + from_m / kSpeed_mps, 1e-9);
  EXPECT_DOUBLE_EQ(found_[0].past_line_m, from_m);
  EXPECT_FALSE(found_[0].opposed_left);
}

TEST_F(Junction, IsZeroWhileTheFirstIsStillInside) {
  // From the west the place begins about 19 m past the line, from the south about 8.5 m, and a car occupies it for
  // about 3.6 + 4.5 m, 0.8 s. Fronts at their places at 2.9 s and 3.25 s.
  car(0, kWestCenter, 1.0);
  car(1, kSouthCenter, 2.4);
  run(8.0);
  ASSERT_EQ(found_.size(), 1U);
  EXPECT_EQ(found_[0].second.vehicle, 1U);
  EXPECT_DOUBLE_EQ(found_[0].pet_s, 0.0);
}

TEST_F(Junction, PairsOnlyCarsThatComeDirectlyAfterOneAnother) {
  // West, west, south, south: the second from the west and the first from the south are the one pair.
  car(0, kWestCenter, 1.0);
  car(4, kWestCenter, 3.0);
  car(1, kSouthCenter, 6.0);
  car(5, kSouthCenter, 8.0);
  run(14.0);
  ASSERT_EQ(found_.size(), 1U);
  EXPECT_EQ(found_[0].first.vehicle, 4U);
  EXPECT_EQ(found_[0].second.vehicle, 1U);
}

TEST_F(Junction, KeepsOpposedLeftsApart) {
  car(0, kWestLeft, 1.0);
  car(2, kEastCenter, 3.0);
  run(8.0);
  ASSERT_EQ(found_.size(), 1U);
  EXPECT_TRUE(found_[0].opposed_left);
}

}  // namespace
}  // namespace lukou
