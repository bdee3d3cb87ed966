#include "services/rsu/algorithms/arrive_on_green.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>
#include <vector>

namespace lukou {
namespace {

constexpr TemporaryId kCar{77};

/// One lane at a time; the limit is 60 km/h, so the target speed is 15 m/s.
class ArriveOnGreenTest : public testing::Test {
 protected:
  /// What the algorithm says at `now` to cars of which each is {distance, speed}; ids count from 77.
  std::vector<RsuAnswer::Item> answer(Step now, std::vector<std::pair<double, double>> cars) {
    return answer(algorithm_, now, std::move(cars));
  }
  std::vector<RsuAnswer::Item> answer(RsuAlgorithm& algorithm, Step now, std::vector<std::pair<double, double>> cars) {
    heard_.clear();
    for (const auto& [distance_m, speed_mps] : cars) {
      heard_.push_back({.id = TemporaryId{77 + heard_.size()}, .distance_m = distance_m, .speed_mps = speed_mps});
    }
    RsuView view;
    view.step = now;
    view.time_s = time_s(now);
    view.map = {.speed_limit_mps = 60.0 / 3.6, .approach_length_m = 500.0};
    lane_.cars = heard_;
    lane_.changes = changes_;
    view.lanes[1] = lane_;
    RsuAnswer said;
    algorithm.on_step(view, said);
    return said.items();
  }

  void red_until(Step green) {
    lane_.aspect = Aspect::kRed;
    changes_ = {{Aspect::kGreen, green}, {Aspect::kRed, green + 450}, {Aspect::kGreen, green + 900}};
  }
  void green_until(Step red) {
    lane_.aspect = Aspect::kGreen;
    changes_ = {{Aspect::kRed, red}, {Aspect::kGreen, red + 450}, {Aspect::kRed, red + 900}};
  }

  ArriveOnGreen algorithm_{ArriveOnGreenParameters{}};
  LaneView lane_;
  std::vector<HeardCar> heard_;
  std::vector<SignalChange> changes_;
};

TEST_F(ArriveOnGreenTest, LeavesACarAloneThatMakesIt) {
  green_until(450);
  EXPECT_TRUE(answer(0, {{150.0, 15.0}}).empty());  // there after 10 s
}

TEST_F(ArriveOnGreenTest, SlowsACarThatWouldComeTooEarly) {
  // 300 m at 15 m/s: 20 s. Green after 21.4 s, first crossing 0.6 s later: 2 s early.
  red_until(214);
  const auto said = answer(0, {{300.0, 15.0}});
  ASSERT_EQ(said.size(), 1U);
  EXPECT_EQ(said[0].car, kCar);
  ASSERT_TRUE(said[0].advice);
  EXPECT_EQ(said[0].advice->binding, Binding::kFollowing);
  EXPECT_EQ(said[0].advice->lifetime, 5);
  // The acceleration closes the gap to the cruising speed w in 2 s, and w takes 22 s to the line at 6.4 m/s.
  const double cruise_mps = 15.0 + 2.0 * said[0].advice->acceleration_mps2;
  EXPECT_LT(cruise_mps, 15.0);
  EXPECT_NEAR(approach_time_s({}, {.distance_m = 300.0, .speed_mps = 15.0, .cruise_mps = cruise_mps, .final_mps = 6.4}),
              22.0, 0.02);
}

TEST_F(ArriveOnGreenTest, BringsACarThatWouldComeFiveSecondsEarlyToTheLineWhenItIsGreen) {
  // There after 20 s; green after 24.4 s, so its turn is at 25.0 s. The car takes the smaller of the advice and its own
  // wish: 2 m/s2 up to 15 m/s; before red it brakes only where more than 2.5 m/s2 would be needed.
  red_until(244);
  double distance_m = 300.0;
  double speed_mps = 15.0;
  Step now = 0;
  for (; distance_m > 0.0; ++now) {
    ASSERT_LT(now, 400);
    if (now == 244) {
      green_until(244 + 450);
      lane_.aspect_since = 244;
    }
    const auto said = answer(now, {{distance_m, speed_mps}});
    double acceleration_mps2 = speed_mps < 15.0 ? 2.0 : 0.0;
    if (!said.empty() && said[0].advice)
      acceleration_mps2 = std::min(acceleration_mps2, said[0].advice->acceleration_mps2);
    const double needed_mps2 = speed_mps * speed_mps / (2.0 * distance_m);
    if (lane_.aspect == Aspect::kRed && needed_mps2 > 2.5) acceleration_mps2 = -needed_mps2;
    distance_m -= speed_mps * 0.1 + 0.5 * acceleration_mps2 * 0.01;
    speed_mps += acceleration_mps2 * 0.1;
    ASSERT_GT(speed_mps, 5.0);  // on its way it never comes near to rest
  }
  EXPECT_GE(time_s(now), 24.4);
  EXPECT_LE(time_s(now), 25.5);
}

TEST_F(ArriveOnGreenTest, LeavesACommittedCarAlone) {
  red_until(300);
  // 15^2 / (2 * 3) = 37.5 m to stop.
  EXPECT_TRUE(answer(0, {{37.0, 15.0}}).empty());
  EXPECT_EQ(answer(1, {{38.0, 15.0}}).size(), 1U);
}

TEST_F(ArriveOnGreenTest, ReleasesACarOnce) {
  red_until(300);
  ASSERT_EQ(answer(0, {{300.0, 15.0}}).size(), 1U);
  const auto said = answer(1, {{37.0, 15.0}});
  ASSERT_EQ(said.size(), 1U);
  EXPECT_EQ(said[0].car, kCar);
  EXPECT_FALSE(said[0].advice);
  EXPECT_TRUE(answer(2, {{36.0, 15.0}}).empty());
}

TEST_F(ArriveOnGreenTest, RenewsItsAdviceInEveryStep) {
  red_until(300);
  for (Step now = 0; now < 5; ++now)
    EXPECT_EQ(answer(now, {{300.0 - 1.5 * static_cast<double>(now), 15.0}}).size(), 1U);
}

TEST_F(ArriveOnGreenTest, TellsANearCarThatMakesItsGreenNotToBrakeForRed) {
  // From 10 to 15 m/s takes 2.5 s and 31.25 m; there after 7.08 s. Green after 6 s, first crossing after 6.6 s.
  red_until(60);
  const auto said = answer(0, {{100.0, 10.0}});
  ASSERT_EQ(said.size(), 1U);
  ASSERT_TRUE(said[0].advice);
  EXPECT_EQ(said[0].advice->acceleration_mps2, 3.0);
}

TEST_F(ArriveOnGreenTest, SaysNothingToAFarCarThatMakesItsGreen) {
  red_until(60);
  EXPECT_TRUE(answer(0, {{151.0, 10.0}}).empty());  // there after 10.5 s; beyond 150 m no car brakes for red
}

TEST_F(ArriveOnGreenTest, LetsACarGoThatIsLateForAGreenToCome) {
  // At 16.6 m/s over 160 m, slowing to 15 m/s at the line: (16.6^2 - 15^2) / 3 = 16.85 m in 1.07 s and 143.15 m in
  // 8.62 s: 9.69 s. Its turn is at 10.9 s, more than the slack of 1 s later; but slowing to 6.4 m/s at the line takes
  // 78.2 m in 6.8 s after 81.8 m in 4.93 s: 11.73 s.
  red_until(103);
  const auto said = answer(0, {{160.0, 16.6}});
  ASSERT_EQ(said.size(), 1U);
  ASSERT_TRUE(said[0].advice);
  EXPECT_EQ(said[0].advice->acceleration_mps2, 3.0);
}

TEST_F(ArriveOnGreenTest, KeepsAHeadwayBehindTheCarBefore) {
  green_until(2000);
  // The first is there after 1 s, the second after 1.33 s: 2.98 s is its turn. Even at the lowest speed it would be
  // early (braking at 1 m/s2 it is there after 1.4 s), so it is told to brake at 1 m/s2.
  const auto said = answer(1000, {{15.0, 15.0}, {20.0, 15.0}});
  ASSERT_EQ(said.size(), 1U);
  EXPECT_EQ(said[0].car, TemporaryId{78});
  ASSERT_TRUE(said[0].advice);
  EXPECT_EQ(said[0].advice->acceleration_mps2, -1.0);
}

TEST_F(ArriveOnGreenTest, KeepsAHeadwayBehindTheLastCrossing) {
  green_until(2000);
  lane_.last_crossing_s = 100.0;
  // There after 0.9 s; its turn is 1.98 s after the crossing, 1.08 s later than that: beyond the slack.
  const auto said = answer(1000, {{13.5, 15.0}});
  ASSERT_EQ(said.size(), 1U);
  EXPECT_TRUE(said[0].advice);
  lane_.last_crossing_s = 99.9;  // 0.98 s later than it: within the slack
  const auto released = answer(1000, {{13.5, 15.0}});
  ASSERT_EQ(released.size(), 1U);
  EXPECT_FALSE(released[0].advice);
}

TEST_F(ArriveOnGreenTest, LetsACarUseTheTailOfAGreen) {
  green_until(100);
  EXPECT_TRUE(answer(0, {{187.0, 15.0}}).empty());  // there after 12.47 s; the tail is 2.5 s
  const auto said = answer(1, {{189.5, 15.0}});     // at 12.73 s: too late, so it waits for the next green at 55 s
  ASSERT_EQ(said.size(), 1U);
  ASSERT_TRUE(said[0].advice);
  EXPECT_EQ(said[0].advice->acceleration_mps2, -1.0);
}

TEST_F(ArriveOnGreenTest, LeavesCarsAloneWhereNoGreenIsKnown) {
  lane_.aspect = Aspect::kRed;
  changes_.clear();
  EXPECT_TRUE(answer(0, {{300.0, 15.0}, {100.0, 5.0}}).empty());
}

TEST(ArriveOnGreenLimits, NeverAsksForMoreThanEveryCarCanDo) {
  ArriveOnGreenParameters weak;
  weak.acceleration_max_mps2 = 1.239;
  ArriveOnGreen algorithm(weak);
  const std::vector<HeardCar> cars = {{.id = kCar, .distance_m = 100.0, .speed_mps = 10.0}};
  const std::vector<SignalChange> changes = {{Aspect::kGreen, 60}, {Aspect::kRed, 500}};
  RsuView view;
  view.map.speed_limit_mps = 60.0 / 3.6;
  view.lanes[0] = {.cars = cars, .last_crossing_s = {}, .aspect = Aspect::kRed, .aspect_since = 0, .changes = changes};
  RsuAnswer said;
  algorithm.on_step(view, said);
  ASSERT_EQ(said.items().size(), 1U);
  EXPECT_EQ(said.items()[0].advice->acceleration_mps2, 1.23);  // rounded down to what the message carries
}

}  // namespace
}  // namespace lukou
