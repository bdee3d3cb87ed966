#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/unit/services/traffic_engine/model/rides.hpp"

namespace lukou::traffic {
namespace {

void expect_one(const std::vector<OutcomeEvent>& outcomes, AdviceOutcome outcome, bool again = false) {
  ASSERT_EQ(outcomes.size(), 1U);
  EXPECT_EQ(outcomes[0].outcome, outcome);
  EXPECT_EQ(outcomes[0].again, again);
}

void send(Ride& ride, Advice advice) { ride.step({&advice, 1}); }

TEST(Advice, IsUsedAsCommandedForItsWholeLife) {
  Ride ride(with_arrivals(calm_parameters(), {0.0}));
  ride.run_to(50);
  send(ride, ride.advise(0, -0.37, 3));
  for (int step = 0; step < 3; ++step) {
    if (step > 0) ride.step();
    EXPECT_NEAR(ride.cars()[0].motion.acceleration_mps2, -0.37, 1e-12);
    EXPECT_DOUBLE_EQ(ride.cars()[0].commanded_mps2, -0.37);
  }
  ride.run_to(63);  // the life has ended, and a second has passed: 15 m/s is wanted again
  EXPECT_GT(ride.cars()[0].motion.acceleration_mps2, 0.0);
  EXPECT_TRUE(std::isnan(ride.cars()[0].commanded_mps2));
  expect_one(ride.take_outcomes(), AdviceOutcome::kApplied);
}

TEST(Advice, GetsTheActuationNoiseOfEveryDriver) {
  EngineParameters parameters = with_arrivals(calm_parameters(), {0.0});
  parameters.vehicles.actuation_noise_mps2 = 0.2;
  Ride ride(parameters);
  ride.run_to(50);
  send(ride, ride.advise(0, -1.0, 20));
  double noise_mps2 = 0.0;
  for (int step = 0; step < 20; ++step) {
    if (step > 0) ride.step();
    const Car& car = ride.cars()[0];
    EXPECT_NEAR(car.motion.acceleration_mps2, -1.0 + car.noise_mps2, 1e-12);
    noise_mps2 += std::abs(car.noise_mps2);
  }
  EXPECT_GT(noise_mps2, 1.0);  // 20 draws with a mean of 0.16
  expect_one(ride.take_outcomes(), AdviceOutcome::kApplied);
}

TEST(Advice, ReachesACarThatApproachesARedLight) {
  // 450 m after 30 s at 15 m/s: braking would be natural, the command is to hold the speed.
  Ride ride(with_arrivals(calm_parameters(), {0.0}), Aspect::kRed);
  ride.run_to(260);
  ASSERT_LT(ride.cars()[0].motion.acceleration_mps2, -0.5);
  send(ride, ride.advise(0, 0.0));
  EXPECT_EQ(ride.cars()[0].motion.acceleration_mps2, 0.0);
  expect_one(ride.take_outcomes(), AdviceOutcome::kApplied);
}

TEST(Advice, IsChangedByTheGuardBeforeTheLineAndSaysSoOnce) {
  Ride ride(with_arrivals(calm_parameters(), {0.0}), Aspect::kRed);
  ride.run_to(260);
  send(ride, ride.advise(0, 3.0, 200));
  ride.run_to(500);
  const auto outcomes = ride.take_outcomes();
  // First applied, then cut at the speed limit: 16.667 m/s is reached before the guard has to brake.
  ASSERT_EQ(outcomes.size(), 2U);
  EXPECT_EQ(outcomes[0].outcome, AdviceOutcome::kApplied);
  EXPECT_FALSE(outcomes[0].again);
  EXPECT_EQ(outcomes[1].outcome, AdviceOutcome::kChangedLimit);
  EXPECT_TRUE(outcomes[1].again);
  EXPECT_LT(ride.cars()[0].motion.position_m, 500.0);
  EXPECT_TRUE(ride.crossings().empty());
}

TEST(Advice, OfACarThatClosesInIsChangedByTheGuard) {
  Ride ride(with_arrivals(calm_parameters(), {0.0, 3.0}));
  ride.run_to(60);
  send(ride, ride.advise(0, -3.0, 120));  // stands after 5 s
  ride.take_outcomes();
  std::size_t guarded = 0;
  for (int i = 0; i < 100; ++i) {
    send(ride, ride.advise(1, 0.0, 1));
    ASSERT_GE(ride.cars()[0].motion.position_m - ride.cars()[1].motion.position_m, 5.495);
    for (const OutcomeEvent& outcome : ride.take_outcomes()) {
      if (outcome.vehicle != 4) continue;
      EXPECT_TRUE(outcome.outcome == AdviceOutcome::kApplied || outcome.outcome == AdviceOutcome::kChangedGuard);
      if (outcome.outcome == AdviceOutcome::kChangedGuard) ++guarded;
    }
  }
  EXPECT_GT(guarded, 20U);
  EXPECT_EQ(ride.cars()[1].motion.speed_mps, 0.0);
}

TEST(Advice, IsCutAtTheLimitOfSpeed) {
  Ride ride(with_arrivals(calm_parameters(), {0.0}));
  ride.run_to(50);
  send(ride, ride.advise(0, 3.0, 10));  // 15 + 0.3 * 5 = 16.5, the sixth step would reach 16.8
  ride.run_to(60);
  const auto outcomes = ride.take_outcomes();
  ASSERT_EQ(outcomes.size(), 2U);
  EXPECT_EQ(outcomes[1].outcome, AdviceOutcome::kChangedLimit);
  EXPECT_DOUBLE_EQ(ride.cars()[0].motion.speed_mps, 60.0 / 3.6);
}

TEST(Advice, BeyondTheLimitOrNotANumberIsRefused) {
  Ride ride(with_arrivals(calm_parameters(), {0.0}));
  ride.run_to(50);
  const double speed_mps = ride.cars()[0].motion.speed_mps;
  send(ride, ride.advise(0, 3.01));
  expect_one(ride.take_outcomes(), AdviceOutcome::kOutOfLimit);
  send(ride, ride.advise(0, std::numeric_limits<double>::quiet_NaN()));
  expect_one(ride.take_outcomes(), AdviceOutcome::kMalformed);
  send(ride, ride.advise(0, -std::numeric_limits<double>::infinity()));
  expect_one(ride.take_outcomes(), AdviceOutcome::kMalformed);
  EXPECT_EQ(ride.cars()[0].motion.speed_mps, speed_mps);
}

TEST(Advice, ForNobodyIsRefused) {
  Ride ride(with_arrivals(calm_parameters(), {0.0}));
  ride.run_to(50);
  Advice advice = ride.advise(0, 1.0);
  advice.target ^= 1U;
  send(ride, advice);
  const auto outcomes = ride.take_outcomes();
  expect_one(outcomes, AdviceOutcome::kUnknownVehicle);
  EXPECT_EQ(outcomes[0].vehicle, kNoVehicle);
}

TEST(Advice, ForACarWithoutAUnitIsForNobody) {
  EngineParameters parameters = with_arrivals(calm_parameters(), {0.0});
  parameters.equipped_ratio = 0.0;
  Ride ride(parameters);
  ride.run_to(50);
  send(ride, ride.advise(0, 1.0));
  expect_one(ride.take_outcomes(), AdviceOutcome::kUnknownVehicle);
}

TEST(Advice, ForACarPastItsStopLineIsRefused) {
  Ride ride(with_arrivals(calm_parameters(), {0.0}));
  ride.run_to(345);  // 15 m/s * 34.4 s = 516 m
  ASSERT_EQ(ride.cars()[0].stage, Stage::kExit);
  send(ride, ride.advise(0, -1.0));
  expect_one(ride.take_outcomes(), AdviceOutcome::kPastStopLine);
  EXPECT_NEAR(ride.cars()[0].motion.acceleration_mps2, 0.0, 1e-9);
}

TEST(Advice, EndsAtTheStopLine) {
  Ride ride(with_arrivals(calm_parameters(), {0.0}));
  ride.run_to(320);  // 478.5 m
  send(ride, ride.advise(0, -0.5, 100));
  ride.run_to(345);
  ASSERT_EQ(ride.cars()[0].stage, Stage::kExit);
  EXPECT_GT(ride.cars()[0].motion.acceleration_mps2, 0.0);
}

TEST(Advice, ThatComesAfterItsLifeIsLate) {
  Ride ride(with_arrivals(calm_parameters(), {0.0}));
  ride.run_to(50);
  Advice late = ride.advise(0, 1.0, 3);
  late.issued = 47;  // good for the steps 48, 49, 50
  send(ride, late);
  expect_one(ride.take_outcomes(), AdviceOutcome::kLate);
  late.issued = 48;
  send(ride, late);  // step 52 > 51
  expect_one(ride.take_outcomes(), AdviceOutcome::kLate);
  late.issued = 50;
  send(ride, late);  // step 53 = 50 + 3
  expect_one(ride.take_outcomes(), AdviceOutcome::kApplied);
}

TEST(Advice, ThatANewerOneOvertakesIsSuperseded) {
  Ride ride(with_arrivals(calm_parameters(), {0.0}));
  ride.run_to(50);
  const std::vector<Advice> both = {ride.advise(0, -1.0), ride.advise(0, -2.0)};
  ride.step(both);
  const auto outcomes = ride.take_outcomes();
  ASSERT_EQ(outcomes.size(), 2U);
  EXPECT_EQ(outcomes[0].outcome, AdviceOutcome::kSuperseded);
  EXPECT_EQ(outcomes[0].sequence, 0U);
  EXPECT_EQ(outcomes[1].outcome, AdviceOutcome::kApplied);
  EXPECT_EQ(outcomes[1].sequence, 1U);
  EXPECT_NEAR(ride.cars()[0].motion.acceleration_mps2, -2.0, 1e-12);
}

TEST(Advice, ThatIsOlderThanTheOneInForceIsStale) {
  Ride ride(with_arrivals(calm_parameters(), {0.0}));
  ride.run_to(50);
  Advice older = ride.advise(0, 1.0, 20);
  older.issued = 40;
  send(ride, ride.advise(0, -1.0, 20));
  ride.take_outcomes();
  send(ride, older);
  expect_one(ride.take_outcomes(), AdviceOutcome::kStale);
  EXPECT_NEAR(ride.cars()[0].motion.acceleration_mps2, -1.0, 1e-12);
}

TEST(Advice, IsCancelledByARelease) {
  Ride ride(with_arrivals(calm_parameters(), {0.0}));
  ride.run_to(50);
  send(ride, ride.advise(0, -1.0, 50));
  ride.take_outcomes();
  Advice release = ride.advise(0, 0.0);
  release.release = true;
  send(ride, release);
  EXPECT_TRUE(ride.take_outcomes().empty());
  EXPECT_GT(ride.cars()[0].motion.acceleration_mps2, 0.0);
}

TEST(Advice, ThatAReleaseOvertakesInItsStepIsSuperseded) {
  Ride ride(with_arrivals(calm_parameters(), {0.0}));
  ride.run_to(50);
  std::vector<Advice> both = {ride.advise(0, -1.0), ride.advise(0, 0.0)};
  both[1].release = true;
  ride.step(both);
  expect_one(ride.take_outcomes(), AdviceOutcome::kSuperseded);
}

TEST(FollowingAdvice, YieldsToTheCarAhead) {
  Ride ride(with_arrivals(calm_parameters(), {0.0, 3.0}));
  ride.run_to(60);
  Advice brake = ride.advise(0, -3.0, 30);
  send(ride, brake);
  ride.run_to(75);
  ride.take_outcomes();
  Advice advice = ride.advise(1, 1.0, 1);
  advice.binding = AdviceBinding::kFollowing;
  send(ride, advice);
  const auto outcomes = ride.take_outcomes();
  ASSERT_FALSE(outcomes.empty());
  EXPECT_EQ(outcomes.back().outcome, AdviceOutcome::kChangedFollowing);
  EXPECT_LT(ride.cars()[1].motion.acceleration_mps2, 0.0);
}

TEST(FollowingAdvice, LeavesOutComfortableBrakingForRed) {
  Ride ride(with_arrivals(calm_parameters(), {0.0}), Aspect::kRed);
  ride.run_to(260);
  Advice advice = ride.advise(0, 0.0);
  advice.binding = AdviceBinding::kFollowing;
  send(ride, advice);
  // About 12 m/s and 115 m before the line: 0.6 m/s2 would do, far from 2.5.
  EXPECT_NEAR(ride.cars()[0].motion.acceleration_mps2, 0.0, 1e-12);
  expect_one(ride.take_outcomes(), AdviceOutcome::kApplied);
}

TEST(FollowingAdvice, BrakesForRedWhenItMust) {
  Ride ride(with_arrivals(calm_parameters(), {0.0}), Aspect::kRed);
  ride.run_to(260);
  const auto hold = [&] {
    Advice advice = ride.advise(0, 0.0, 1);
    advice.binding = AdviceBinding::kFollowing;
    send(ride, advice);
    return ride.take_outcomes();
  };
  std::vector<OutcomeEvent> outcomes;
  Motion before;
  do {
    before = ride.cars()[0].motion;
    outcomes = hold();
    ASSERT_EQ(outcomes.size(), 1U);
  } while (outcomes[0].outcome == AdviceOutcome::kApplied);
  EXPECT_EQ(outcomes[0].outcome, AdviceOutcome::kChangedRed);
  // The stop is 0.5 m before the line; this is the first step in which more than 2.5 m/s2 is needed.
  const double needed_mps2 = before.speed_mps * before.speed_mps / (2.0 * (499.5 - before.position_m));
  EXPECT_GT(needed_mps2, 2.5);
  EXPECT_LT(needed_mps2, 2.8);
}

TEST(AdviceInAQueue, MovesACarOutOfTheBlockUpToTheLine) {
  Ride ride(with_arrivals(calm_parameters(), {0.0, 3.0}), Aspect::kRed);
  ride.run_to(900);
  ASSERT_EQ(ride.cars()[0].stage, Stage::kBlock);
  ASSERT_EQ(ride.cars()[1].stage, Stage::kBlock);
  const double from_m = ride.cars()[0].motion.position_m;
  send(ride, ride.advise(0, 1.0, 1));
  EXPECT_NEAR(ride.cars()[0].motion.acceleration_mps2, 1.0, 1e-9);  // as commanded
  expect_one(ride.take_outcomes(), AdviceOutcome::kApplied);
  for (int i = 0; i < 60; ++i) send(ride, ride.advise(0, 1.0, 1));
  EXPECT_GT(ride.cars()[0].motion.position_m, from_m);
  EXPECT_LT(ride.cars()[0].motion.position_m, 500.0);
  EXPECT_EQ(ride.take_outcomes().back().outcome, AdviceOutcome::kChangedGuard);
}

TEST(AdviceInAQueue, ToStandLeavesTheBlockStanding) {
  Ride ride(with_arrivals(calm_parameters(), {0.0, 3.0}), Aspect::kRed);
  ride.run_to(900);
  send(ride, ride.advise(0, 0.0, 1));
  expect_one(ride.take_outcomes(), AdviceOutcome::kApplied);
  send(ride, ride.advise(0, -1.0, 1));  // a standing car cannot slow down
  expect_one(ride.take_outcomes(), AdviceOutcome::kChangedLimit);
  EXPECT_EQ(ride.cars()[0].stage, Stage::kBlock);
}

TEST(AdviceInAQueue, HoldsACarBackThatHasGreen) {
  Ride ride(with_arrivals(calm_parameters(), {0.0, 3.0}), Aspect::kRed);
  ride.run_to(900);
  ride.show(Aspect::kGreen);
  const double from_m = ride.cars()[1].motion.position_m;
  for (int i = 0; i < 30; ++i) send(ride, ride.advise(1, 0.0, 1));
  EXPECT_EQ(ride.cars().back().vehicle, 4U);
  EXPECT_EQ(ride.cars().back().motion.position_m, from_m);
  EXPECT_EQ(ride.crossings().size(), 1U);
  for (const OutcomeEvent& outcome : ride.take_outcomes()) EXPECT_EQ(outcome.outcome, AdviceOutcome::kApplied);
}

TEST(AdviceInAQueue, BoundByFollowingGoesWithTheBlock) {
  Ride ride(with_arrivals(calm_parameters(), {0.0, 3.0}), Aspect::kRed);
  ride.run_to(900);
  Advice advice = ride.advise(1, 3.0, 1);
  advice.binding = AdviceBinding::kFollowing;
  send(ride, advice);
  EXPECT_EQ(ride.cars()[1].motion.speed_mps, 0.0);
  expect_one(ride.take_outcomes(), AdviceOutcome::kChangedFollowing);
}

}  // namespace
}  // namespace lukou::traffic
