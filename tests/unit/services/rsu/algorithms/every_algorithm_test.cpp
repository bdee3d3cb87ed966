#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <string>

#include "services/rsu/algorithms/registry.hpp"
#include "tests/unit/services/rsu/algorithms/one_lane.hpp"

namespace lukou {
namespace {

/// What holds for every algorithm that ships and guides.
class EveryAlgorithm : public testing::TestWithParam<std::string> {
 protected:
  std::unique_ptr<RsuAlgorithm> algorithm_ = std::move(make_algorithm(GetParam(), {})).value();
  test::OneLane road_;
};

/// Numbers from 0 to 999,999; the generator of Lehmer.
class Numbers {
 public:
  double in(double least, double most) {
    state_ = state_ * 48271U % 2147483647U;
    return least + (most - least) * static_cast<double>(state_ % 1000000U) / 1e6;
  }

 private:
  std::uint64_t state_ = 20260;
};

TEST_P(EveryAlgorithm, BringsAnEarlyCarToTheLineInGreenWithoutAStop) {
  // There after 20 s; green after 28 s. The car takes the smaller of the advice and its own wish: 2 m/s2 up to 15 m/s;
  // before red it brakes only where more than 2.5 m/s2 would be needed.
  constexpr Step kGreen = 280;
  road_.red_until(kGreen);
  double distance_m = 300.0;
  double speed_mps = 15.0;
  bool green = false;
  Step now = 0;
  for (; distance_m > 0.0; ++now) {
    ASSERT_LT(now, 400);
    if (now == kGreen) {
      road_.green_until(kGreen + 450);
      green = true;
    }
    road_.cars({{distance_m, speed_mps}});
    const auto said = road_.answer(*algorithm_, now);
    double acceleration_mps2 = std::min(2.0, 15.0 - speed_mps);
    if (!said.empty() && said[0].advice) {
      acceleration_mps2 = std::min(acceleration_mps2, said[0].advice->acceleration_mps2);
    }
    const double needed_mps2 = speed_mps * speed_mps / (2.0 * distance_m);
    if (!green && needed_mps2 > 2.5) acceleration_mps2 = -needed_mps2;
    distance_m -= speed_mps * 0.1 + 0.5 * acceleration_mps2 * 0.01;
    speed_mps += acceleration_mps2 * 0.1;
    ASSERT_GT(speed_mps, 3.0);
  }
  EXPECT_GE(time_s(now), 28.0);
  EXPECT_LE(time_s(now), 30.0);
}

TEST_P(EveryAlgorithm, SaysOnlyWhatCarsTakeAndToCarsThatItHears) {
  Numbers numbers;
  for (Step now = 0; now < 2000; ++now) {
    std::vector<std::pair<double, double>> cars;
    const auto count = static_cast<std::size_t>(numbers.in(0.0, 12.0));
    for (std::size_t i = 0; i < count; ++i) cars.emplace_back(numbers.in(1e-6, 500.0), numbers.in(0.0, 17.0));
    std::ranges::sort(cars);
    road_.cars(cars);
    const Step in = 1 + static_cast<Step>(numbers.in(0.0, 450.0));
    if (numbers.in(0.0, 1.0) < 0.5) {
      road_.red_until(now + in);
    } else {
      road_.green_until(now + in);
    }
    if (numbers.in(0.0, 1.0) < 0.1) road_.no_change_is_known();
    if (numbers.in(0.0, 1.0) < 0.5) road_.last_crossing(time_s(now) - numbers.in(0.0, 60.0));
    std::vector<TemporaryId> named;
    for (const auto& item : road_.answer(*algorithm_, now)) {
      named.push_back(item.car);
      EXPECT_LT(static_cast<std::uint64_t>(item.car) - 77, count);
      if (!item.advice) continue;
      EXPECT_LE(item.advice->acceleration_mps2, 3.0);
      EXPECT_GE(item.advice->acceleration_mps2, -3.0);
      EXPECT_EQ(item.advice->binding, Binding::kFollowing);
    }
    std::ranges::sort(named);
    EXPECT_TRUE(std::ranges::adjacent_find(named) == named.end()) << "no car is told twice";
  }
}

TEST_P(EveryAlgorithm, SaysNothingOnAnEmptyRoad) {
  road_.red_until(100);
  for (Step now = 0; now < 5; ++now) EXPECT_TRUE(road_.answer(*algorithm_, now).empty());
}

TEST_P(EveryAlgorithm, LeavesCarsAloneThatStandBeforeARedWhoseEndNobodyKnows) {
  // As under a controller that RSUs may ask for greens.
  road_.red_until(100);
  road_.no_change_is_known();
  road_.cars({{5.0, 0.0}, {40.0, 8.0}, {150.0, 15.0}, {300.0, 16.0}});
  for (Step now = 0; now < 50; ++now) {
    for (const auto& item : road_.answer(*algorithm_, now)) EXPECT_FALSE(item.advice) << now;
  }
}

INSTANTIATE_TEST_SUITE_P(Shipped, EveryAlgorithm,
                         testing::Values("arrive_on_green", "eco", "glosa", "glosa_queue", "platoon",
                                         "speed_harmonisation"),
                         [](const auto& parameter) { return parameter.param; });

}  // namespace
}  // namespace lukou
