#include "services/traffic_engine/model/demand.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "common/core/keyed_random.hpp"
#include "common/core/math.hpp"
#include "common/core/step.hpp"
#include "services/traffic_engine/model/entrance.hpp"

namespace lukou::traffic {
namespace {

DemandParameters constant(double flow_veh_per_h) {
  DemandParameters demand;
  demand.flows = {{.from_s = 0.0, .flow_veh_per_h = flow_veh_per_h}};
  return demand;
}

std::vector<double> arrivals_until(Demand& demand, double end_s) {
  std::vector<double> arrivals_s;
  for (Step k = 1; k <= step_at_or_after(end_s); ++k) {
    while (const auto at_s = demand.next_until(time_s(k))) arrivals_s.push_back(*at_s);
  }
  return arrivals_s;
}

TEST(Demand, HasExponentialGaps) {
  Demand demand(1, Approach::kWest, constant(1800.0));
  const auto arrivals_s = arrivals_until(demand, 36000.0);
  std::vector<double> gaps_s;
  for (std::size_t i = 1; i < arrivals_s.size(); ++i) gaps_s.push_back(arrivals_s[i] - arrivals_s[i - 1]);
  std::ranges::sort(gaps_s);
  const auto n = static_cast<double>(gaps_s.size());
  double distance = 0.0;  // Kolmogorov and Smirnov, against a mean gap of 2 s
  for (std::size_t i = 0; i < gaps_s.size(); ++i) {
    const double law = 1.0 - math::exp(-gaps_s[i] / 2.0);
    const auto place = static_cast<double>(i);
    distance = std::max({distance, std::abs(law - place / n), std::abs(law - (place + 1.0) / n)});
  }
  EXPECT_LT(distance * std::sqrt(n), 1.95);  // 0.1 % level
}

TEST(Demand, CountsLikeAPoissonProcess) {
  for (const Approach approach : kAllApproaches) {
    Demand demand(2, approach, constant(1800.0));
    const auto arrivals_s = arrivals_until(demand, 36000.0);
    const double expected = 18000.0;
    EXPECT_NEAR(static_cast<double>(arrivals_s.size()), expected, 4.0 * std::sqrt(expected));
    // Variance over mean of the counts in 600 windows of 60 s (mean 30): 1 within 4 sqrt(2 / 599).
    std::vector<double> counts(600, 0.0);
    for (const double at_s : arrivals_s)
      counts[std::min<std::size_t>(static_cast<std::size_t>(at_s / 60.0), 599)] += 1.0;
    double squares = 0.0;
    const double mean = static_cast<double>(arrivals_s.size()) / 600.0;
    for (const double count : counts) squares += (count - mean) * (count - mean);
    EXPECT_NEAR(squares / 599.0 / mean, 1.0, 4.0 * std::sqrt(2.0 / 599.0));
  }
}

TEST(Demand, DrawsEachApproachForItself) {
  Demand west(3, Approach::kWest, constant(1800.0));
  Demand south(3, Approach::kSouth, constant(1800.0));
  EXPECT_NE(arrivals_until(west, 60.0), arrivals_until(south, 60.0));
}

TEST(Demand, StretchesTheSameDrawsUnderAnotherFlow) {
  Demand slow(4, Approach::kEast, constant(900.0));
  Demand fast(4, Approach::kEast, constant(1800.0));
  const auto slow_s = arrivals_until(slow, 2000.0);
  const auto fast_s = arrivals_until(fast, 1000.0);
  ASSERT_EQ(slow_s.size(), fast_s.size());
  for (std::size_t i = 0; i < slow_s.size(); ++i) EXPECT_NEAR(slow_s[i], 2.0 * fast_s[i], 1e-9);
}

TEST(Demand, BringsThePendingArrivalForwardWhenTheFlowRises) {
  Demand steady(5, Approach::kNorth, constant(360.0));
  Demand changed(5, Approach::kNorth, constant(360.0));
  const auto steady_s = arrivals_until(steady, 400.0);
  auto changed_s = arrivals_until(changed, 100.0);
  const std::size_t before = changed_s.size();
  changed.change_flow(100.0, 1440.0);
  for (Step k = 1001; k <= 1750; ++k) {
    while (const auto at_s = changed.next_until(time_s(k))) changed_s.push_back(*at_s);
  }
  // From 100 s on the integral grows four times as fast: what came at 100 + u comes at 100 + u / 4.
  ASSERT_EQ(changed_s.size(), steady_s.size());
  ASSERT_LT(before, changed_s.size());
  for (std::size_t i = 0; i < steady_s.size(); ++i) {
    const double expected_s = i < before ? steady_s[i] : 100.0 + (steady_s[i] - 100.0) / 4.0;
    EXPECT_NEAR(changed_s[i], expected_s, 1e-9);
  }
}

TEST(Demand, FollowsASeriesOfFlows) {
  DemandParameters series;
  series.flows = {{.from_s = 100.0, .flow_veh_per_h = 3600.0},
                  {.from_s = 1100.0, .flow_veh_per_h = 0.0},
                  {.from_s = 2000.05, .flow_veh_per_h = 3600.0}};
  Demand demand(6, Approach::kWest, series);
  const auto arrivals_s = arrivals_until(demand, 3000.05);
  const auto within = [&](double from_s, double to_s) {
    return static_cast<double>(
        std::ranges::count_if(arrivals_s, [&](double at_s) { return at_s >= from_s && at_s < to_s; }));
  };
  EXPECT_EQ(within(0.0, 100.0), 0.0);
  EXPECT_NEAR(within(100.0, 1100.0), 1000.0, 4.0 * std::sqrt(1000.0));
  EXPECT_EQ(within(1100.0, 2000.05), 0.0);
  EXPECT_NEAR(within(2000.05, 3000.05), 1000.0, 4.0 * std::sqrt(1000.0));
}

TEST(Demand, TakesAListAsItIs) {
  DemandParameters listed;
  listed.listed = true;
  listed.arrivals_s = {0.3, 0.3, 7.25};
  Demand demand(7, Approach::kWest, listed);
  EXPECT_EQ(arrivals_until(demand, 7.2), (std::vector<double>{0.3, 0.3}));
  EXPECT_EQ(demand.next_until(7.3), 7.25);
  EXPECT_EQ(demand.next_until(1e6), std::nullopt);
  EXPECT_EQ(demand.taken(), 3U);
}

TEST(Entrance, ChoosesSafeLanesEquallyByDefault) {
  std::array<double, 3> counts{};
  for (std::uint32_t vehicle = 0; vehicle < 30000; ++vehicle) {
    const double uniform = uniform01({.run_seed = 1, .purpose = Purpose::kLane, .entity = vehicle, .index = 0});
    ++counts[static_cast<std::size_t>(*chosen_lane({true, true, true}, {1.0, 1.0, 1.0}, uniform))];
  }
  double chi_square = 0.0;
  for (const double count : counts) chi_square += (count - 10000.0) * (count - 10000.0) / 10000.0;
  EXPECT_LT(chi_square, 13.8);  // 0.1 % level, 2 degrees of freedom
}

TEST(Entrance, SharesTheWeightOfBlockedLanes) {
  EXPECT_EQ(chosen_lane({false, true, true}, {5.0, 1.0, 3.0}, 0.24), 1);
  EXPECT_EQ(chosen_lane({false, true, true}, {5.0, 1.0, 3.0}, 0.26), 2);
  EXPECT_EQ(chosen_lane({false, false, false}, {1.0, 1.0, 1.0}, 0.5), std::nullopt);
  EXPECT_EQ(chosen_lane({true, false, false}, {0.0, 1.0, 1.0}, 0.5), std::nullopt);
}

TEST(Entrance, AsksForTheSafeDistanceBehindTheLastCar) {
  const FollowLaw law{VehicleParameters{}, DrivingParameters{}};
  EXPECT_TRUE(lane_is_safe(law, std::nullopt));
  EXPECT_TRUE(lane_is_safe(law, Motion{19.8, 10.0, 0.0}));
  EXPECT_FALSE(lane_is_safe(law, Motion{19.7, 10.0, 0.0}));
}

TEST(Entrance, CapsTheSpeedBehindAStandingCar) {
  const EngineParameters parameters;
  const FollowLaw law{parameters.vehicles, parameters.driving};
  // 30 m ahead, standing: v^2 <= 3 * (30 - 5.5) is the stricter of the two caps, the other is 6 * 24.5.
  EXPECT_NEAR(capped_initial_speed_mps(parameters, law, 15.0, Motion{30.0, 0.0, 0.0}), std::sqrt(73.5), 1e-12);
  EXPECT_DOUBLE_EQ(capped_initial_speed_mps(parameters, law, 15.0, std::nullopt), 15.0);
  EXPECT_DOUBLE_EQ(capped_initial_speed_mps(parameters, law, 15.0, Motion{5.5, 0.0, 0.0}), 0.0);
}

TEST(Entrance, DrawsDriversWithinTheirBounds) {
  const EngineParameters parameters;
  double sum_mps = 0.0;
  for (std::uint32_t vehicle = 0; vehicle < 4000; ++vehicle) {
    const Driver driver = drawn_driver(parameters, vehicle);
    ASSERT_GE(driver.desired_speed_mps, 0.75 * 60.0 / 3.6);
    ASSERT_LE(driver.desired_speed_mps, 60.0 / 3.6);
    ASSERT_GE(driver.initial_speed_mps, 0.5 * 60.0 / 3.6);
    sum_mps += driver.desired_speed_mps;
  }
  // Mean 0.9 of 16.667 = 15 m/s (the truncation at +2 and -3 deviations moves it by -0.04); deviation 0.83 /
  // sqrt(4000).
  EXPECT_NEAR(sum_mps / 4000.0, 14.96, 0.055);
}

TEST(Entrance, EquipsTheShareThatIsAsked) {
  int equipped = 0;
  for (std::uint32_t vehicle = 0; vehicle < 10000; ++vehicle) equipped += drawn_equipped(1, vehicle, 0.7) ? 1 : 0;
  EXPECT_NEAR(equipped, 7000, 4.0 * std::sqrt(10000 * 0.21));
  EXPECT_TRUE(drawn_equipped(1, 5, 1.0));
  EXPECT_FALSE(drawn_equipped(1, 5, 0.0));
}

}  // namespace
}  // namespace lukou::traffic
