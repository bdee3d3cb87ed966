#include "services/traffic_engine/model/engine.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "common/measures/free_motion.hpp"
#include "tests/unit/services/traffic_engine/model/rides.hpp"

namespace lukou::traffic {
namespace {

EngineParameters with_flow(double flow_veh_per_h, std::uint64_t seed = 1) {
  EngineParameters parameters;
  parameters.seed = seed;
  for (DemandParameters& demand : parameters.demand) demand.flows = {{.from_s = 0.0, .flow_veh_per_h = flow_veh_per_h}};
  return parameters;
}

Heads heads_at(const SignalPlan& plan, Step step) {
  Heads heads{};
  for (int i = 0; i < kLanes; ++i) heads[index(Lane(i))] = aspect_at(plan, Lane(i), step);
  return heads;
}

TEST(Engine, IsEmptyAtStepZero) {
  Engine engine(with_arrivals(calm_parameters(), {0.0}));
  engine.step(0, all_heads(Aspect::kGreen), {});
  EXPECT_TRUE(engine.entries().empty());
  EXPECT_EQ(engine.arrived(Approach::kWest), 0U);
}

TEST(Engine, AdmitsACarAtTheFirstStepAfterItsArrival) {
  Ride ride(with_arrivals(calm_parameters(), {0.31}));
  ride.run_to(3);
  EXPECT_TRUE(ride.cars().empty());
  ride.step();
  ASSERT_EQ(ride.engine().entries().size(), 1U);
  const Entry& entry = ride.engine().entries()[0];
  EXPECT_EQ(entry.vehicle, 0U);  // 4 * 0 + west
  EXPECT_EQ(entry.lane, kWestCenter);
  EXPECT_DOUBLE_EQ(entry.speed_mps, 15.0);
  EXPECT_EQ(ride.cars()[0].motion.position_m, 0.0);
}

TEST(Engine, LetsALoneCarDriveInTheTimeOfTheLaw) {
  EngineParameters parameters = calm_parameters();
  parameters.driving.initial_speed_min = 0.5;
  Ride ride(with_arrivals(parameters, {0.0}));
  ride.run_to(500);
  ASSERT_EQ(ride.crossings().size(), 1U);
  // Enters at 0.1 s with its desired 15 m/s: 500 m take 33.333 s.
  EXPECT_NEAR(ride.crossings()[0].time_s, 0.1 + 500.0 / 15.0, 1e-6);
}

TEST(Engine, LetsDriversReachTheirOwnSpeedInTheTimeOfTheLaw) {
  EngineParameters parameters = calm_parameters();
  parameters.driving.desired_speed_deviation = 0.05;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    parameters.seed = seed;
    Ride ride(with_arrivals(parameters, {0.0}));
    ride.step();
    const Entry entry = ride.engine().entries().at(0);
    ride.run_to(600);
    ASSERT_EQ(ride.crossings().size(), 1U);
    const double free_s = free_time_s({.initial_mps = entry.speed_mps, .desired_mps = entry.desired_speed_mps}, 500.0);
    EXPECT_NEAR(ride.crossings()[0].time_s - 0.1, free_s, 0.15);
  }
}

TEST(Engine, StopsALoneCarComfortablyBeforeRed) {
  Ride ride(with_arrivals(calm_parameters(), {0.0}), Aspect::kRed);
  double hardest_mps2 = 0.0;
  while (ride.now() < 1200) {
    ride.step();
    if (ride.cars()[0].motion.speed_mps > 0.3)
      hardest_mps2 = std::min(hardest_mps2, ride.cars()[0].motion.acceleration_mps2);
  }
  EXPECT_GE(hardest_mps2, -0.8);
  EXPECT_EQ(ride.cars()[0].motion.speed_mps, 0.0);
  EXPECT_GE(ride.cars()[0].motion.position_m, 499.2);
  EXPECT_LE(ride.cars()[0].motion.position_m, 499.8);
}

TEST(Engine, StopsASecondCarAtTheStandstillSpacing) {
  Ride ride(with_arrivals(calm_parameters(), {0.0, 4.0}), Aspect::kRed);
  ride.run_to(1500);
  ASSERT_EQ(ride.cars().size(), 2U);
  EXPECT_EQ(ride.cars()[1].motion.speed_mps, 0.0);
  EXPECT_EQ(ride.cars()[1].stage, Stage::kBlock);
  const double spacing_m = ride.cars()[0].motion.position_m - ride.cars()[1].motion.position_m;
  EXPECT_GE(spacing_m, 5.5);
  EXPECT_LE(spacing_m, 6.0);
}

TEST(Engine, LetsAStoppedCarStandToTheBitInSpiteOfNoise) {
  EngineParameters parameters = with_arrivals(calm_parameters(), {0.0, 4.0});
  parameters.vehicles.actuation_noise_mps2 = 0.5;
  Ride ride(parameters, Aspect::kRed);
  ride.run_to(1500);
  ASSERT_EQ(ride.cars()[1].stage, Stage::kBlock);
  const double first_m = ride.cars()[0].motion.position_m;
  const double second_m = ride.cars()[1].motion.position_m;
  ride.run_to(4000);
  EXPECT_EQ(ride.cars()[0].motion.position_m, first_m);
  EXPECT_EQ(ride.cars()[1].motion.position_m, second_m);
  ride.show(Aspect::kGreen);
  ride.step();
  EXPECT_GT(ride.cars()[0].motion.position_m, first_m);
  EXPECT_GT(ride.cars()[1].motion.position_m, second_m);
}

TEST(Engine, StartsTheWholeBlockTogetherAtTheDischargeSpeed) {
  Ride ride(with_arrivals(calm_parameters(), {0.0, 4.0, 8.0}), Aspect::kRed);
  ride.run_to(2000);
  ride.show(Aspect::kGreen);
  ride.run_to(2003);
  for (const Car& car : ride.cars()) EXPECT_NEAR(car.motion.speed_mps, 0.9, 1e-12);  // 3 m/s2 for 0.3 s
  ride.run_to(2015);
  EXPECT_NEAR(ride.cars().back().motion.speed_mps, 10.0 / 3.6, 1e-12);
}

TEST(Engine, CommitsACarThatCannotStopWhenTheGreenEnds) {
  Ride ride(with_arrivals(calm_parameters(), {0.0}));
  ride.run_to(312);  // 15 m/s * 31.1 s = 466.5 m, stops at 504 m
  ride.show(Aspect::kRed);
  ride.step();
  EXPECT_EQ(ride.cars()[0].stage, Stage::kCommitted);
  ride.run_to(345);
  ASSERT_EQ(ride.crossings().size(), 1U);
  EXPECT_TRUE(ride.crossings()[0].committed);
  EXPECT_EQ(ride.crossings()[0].aspect, Aspect::kRed);
  EXPECT_LT(ride.crossings()[0].time_s, 31.2 + 3.0);
}

TEST(Engine, HoldsACarThatCanJustStopWhenTheGreenEnds) {
  Ride ride(with_arrivals(calm_parameters(), {0.0}));
  ride.run_to(309);  // 15 m/s * 30.8 s = 462 m, stops at 499.5 m
  ride.show(Aspect::kYellow);
  ride.run_to(600);
  EXPECT_TRUE(ride.crossings().empty());
  EXPECT_LT(ride.cars()[0].motion.position_m, 500.0);
}

TEST(Engine, TellsOfCarsThatWaitOutsideTooLong) {
  EngineParameters parameters = with_arrivals(calm_parameters(), {0.0});
  std::vector<double>& arrivals_s = parameters.demand[index(Approach::kWest)].arrivals_s;
  arrivals_s.assign(200, 0.0);  // a lane of 500 m holds about 89
  parameters.overflow_wait_s = 60.0;
  Ride ride(parameters, Aspect::kRed);
  ride.run_to(600);
  EXPECT_FALSE(ride.engine().overflows());  // at 60.0 s they have waited no longer than 60 s
  ride.step();
  EXPECT_TRUE(ride.engine().overflows());
  EXPECT_EQ(ride.engine().arrived(Approach::kWest), 200U);
}

TEST(Engine, ReactsLaterWithALongerReactionTime) {
  EngineParameters parameters = with_arrivals(calm_parameters(), {0.0});
  parameters.driving.reaction_time_s = 0.5;
  Ride quick(with_arrivals(calm_parameters(), {0.0}), Aspect::kRed);
  Ride slow(parameters, Aspect::kRed);
  const auto first_braking = [](Ride& ride) {
    while (ride.cars().empty() || ride.cars()[0].motion.acceleration_mps2 >= 0.0) ride.step();
    return ride.now();
  };
  EXPECT_EQ(first_braking(slow) - first_braking(quick), 4);  // 0.5 s less the step itself
}

TEST(Engine, GivesTheSameForTheSameSeed) {
  Engine first(with_flow(1800.0));
  Engine second(with_flow(1800.0));
  const SignalPlan plan = paper_plan();
  for (Step k = 0; k <= 3000; ++k) {
    first.step(k, heads_at(plan, k - 1), {});
    second.step(k, heads_at(plan, k - 1), {});
  }
  for (int i = 0; i < kLanes; ++i) {
    const auto& a = first.lane(Lane(i)).cars();
    const auto& b = second.lane(Lane(i)).cars();
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t n = 0; n < a.size(); ++n) {
      EXPECT_EQ(a[n].vehicle, b[n].vehicle);
      EXPECT_EQ(a[n].motion.position_m, b[n].motion.position_m);
    }
  }
}

/// What was drawn for cars: arrivals per approach, desired speeds, noise by car and step.
struct Draws {
  std::array<std::uint32_t, kApproaches> arrived{};
  std::map<std::uint32_t, double> desired_mps;
  std::map<std::pair<std::uint32_t, Step>, double> noise_mps2;
};

Draws draws_with(double ratio, bool advised) {
  EngineParameters parameters = with_flow(1500.0, 9);
  parameters.equipped_ratio = ratio;
  Engine engine(parameters);
  const SignalPlan plan = paper_plan();
  Draws draws;
  std::vector<Advice> advice;
  for (Step k = 0; k <= 2000; ++k) {
    engine.step(k, heads_at(plan, k - 1), advice);
    advice.clear();
    for (const Entry& entry : engine.entries()) draws.desired_mps[entry.vehicle] = entry.desired_speed_mps;
    for (int i = 0; i < kLanes; ++i) {
      for (const Car& car : engine.lane(Lane(i)).cars()) {
        if (car.noise_mps2 != 0.0) draws.noise_mps2[{car.vehicle, k}] = car.noise_mps2;
        if (!advised || !car.equipped || k % 7 != 0) continue;
        advice.push_back({.target = car.temporary_id,
                          .acceleration_mps2 = -0.5,
                          .binding = AdviceBinding::kFollowing,
                          .release = false,
                          .issued = k,
                          .lifetime = 5});
      }
    }
  }
  for (const Approach approach : kAllApproaches) draws.arrived[index(approach)] = engine.arrived(approach);
  return draws;
}

TEST(Engine, LeavesEveryDrawAloneWhenRatioAndGuidanceChange) {
  const Draws plain = draws_with(0.0, false);
  const Draws guided = draws_with(0.8, true);
  EXPECT_EQ(plain.arrived, guided.arrived);
  std::size_t compared = 0;
  for (const auto& [vehicle, desired_mps] : guided.desired_mps) {
    const auto same = plain.desired_mps.find(vehicle);
    if (same == plain.desired_mps.end()) continue;
    EXPECT_EQ(same->second, desired_mps);
    ++compared;
  }
  EXPECT_GT(compared, 200U);
  compared = 0;
  for (const auto& [key, noise_mps2] : guided.noise_mps2) {
    const auto same = plain.noise_mps2.find(key);
    if (same == plain.noise_mps2.end()) continue;
    EXPECT_EQ(same->second, noise_mps2);
    ++compared;
  }
  EXPECT_GT(compared, 10000U);
}

TEST(Engine, ChangesTheFlowWithoutTouchingTheOtherApproaches) {
  Engine steady(with_flow(900.0));
  Engine changed(with_flow(900.0));
  const SignalPlan plan = paper_plan();
  for (Step k = 0; k <= 6000; ++k) {
    if (k == 1001) changed.change_flow(Approach::kSouth, 1800.0);
    steady.step(k, heads_at(plan, k - 1), {});
    changed.step(k, heads_at(plan, k - 1), {});
  }
  EXPECT_EQ(steady.arrived(Approach::kWest), changed.arrived(Approach::kWest));
  // 25 + 500 s * 0.5 / s = 275 against 150.
  EXPECT_NEAR(changed.arrived(Approach::kSouth), 275.0, 4.0 * std::sqrt(275.0));
  EXPECT_GT(changed.arrived(Approach::kSouth), steady.arrived(Approach::kSouth) + 50U);
}

/// Law: a queue is served at one car per safe time; the first cars of a green do not wait for each other's reactions.
TEST(Engine, DischargesASaturatedApproachAtItsCapacity) {
  EngineParameters parameters = with_flow(0.0);
  parameters.road.approach_m = 1000.0;
  parameters.demand[index(Approach::kWest)].flows = {{.from_s = 0.0, .flow_veh_per_h = 3600.0}};
  Engine engine(parameters);
  const SignalPlan plan = paper_plan();
  struct Trip {
    int lane = 0;
    int onsets_at_entry = 0;
    int stops = 0;
    bool armed = true;
  };
  std::map<std::uint32_t, Trip> trips;
  int onsets = 0;
  double crossings = 0.0;
  double cars = 0.0;
  double surplus = 0.0;  // stops less ends of green that the car saw, over all cars
  std::array<double, kLanesPerApproach> last_s{};
  std::array<int, kLanesPerApproach> in_green{};
  double headway_sum_s = 0.0;
  double headways = 0.0;
  for (Step k = 0; k <= 9000 + 20 * 900; ++k) {
    engine.step(k, heads_at(plan, k - 1), {});
    if (k % 900 == 450) ++onsets;
    if (k % 900 == 1) in_green.fill(0);
    for (const Entry& entry : engine.entries()) trips[entry.vehicle] = {int(entry.lane), onsets, 0, true};
    for (int i = 0; i < kLanesPerApproach; ++i) {
      for (const Car& car : engine.lane(Lane(i)).cars()) {
        Trip& trip = trips[car.vehicle];
        if (car.stage == Stage::kExit) continue;
        if (car.motion.speed_mps < 5.0 / 3.6 && trip.armed) ++trip.stops, trip.armed = false;
        if (car.motion.speed_mps > 8.0 / 3.6) trip.armed = true;
      }
    }
    for (const Crossing& crossing : engine.events().crossings) {
      const Trip& trip = trips[crossing.vehicle];
      const auto lane = static_cast<std::size_t>(trip.lane);
      if (crossing.time_s > 900.0) {
        ++crossings;
        ++cars;
        surplus += trip.stops - (onsets - trip.onsets_at_entry);
        if (++in_green[lane] >= 4 && crossing.aspect == Aspect::kGreen) {
          headway_sum_s += crossing.time_s - last_s[lane];
          ++headways;
        }
      }
      last_s[lane] = crossing.time_s;
    }
  }
  EXPECT_NEAR(crossings / 1800.0 * 3600.0, 2702.0, 2702.0 * 0.015);
  EXPECT_GT(headway_sum_s / headways, 1.95);
  EXPECT_LT(headway_sum_s / headways, 2.06);
  EXPECT_NEAR(surplus / cars, 0.0, 0.35);  // one stop per cycle queued; some cars enter or cross in between
}

}  // namespace
}  // namespace lukou::traffic
