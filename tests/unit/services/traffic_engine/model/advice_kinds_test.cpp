#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/services/traffic_engine/model/rides.hpp"

namespace lukou::traffic {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

void send(Ride& ride, Advice advice) { ride.step({&advice, 1}); }

Advice as_profile(Advice advice, std::vector<LaterCommand> later) {
  advice.kind = AdviceKind::kProfile;
  advice.later = std::move(later);
  return advice;
}

Advice as_speed(Advice advice, double speed_mps, AdviceKind kind = AdviceKind::kSpeed) {
  advice.kind = kind;
  advice.speed_mps = speed_mps;
  advice.acceleration_mps2 = kNaN;
  return advice;
}

double acceleration_mps2(const Ride& ride) { return ride.cars()[0].motion.acceleration_mps2; }

TEST(Profile, IsDrivenSegmentBySegment) {
  Ride ride(with_arrivals(calm_parameters(), {0.0}));
  ride.run_to(50);
  // 2 steps of -1.37, 3 of 0.5, 1 of -0.2.
  send(ride, as_profile(ride.advise(0, -1.37, 6), {{.after = 2, .acceleration_mps2 = 0.5}, {5, -0.2}}));
  for (const double wanted_mps2 : {-1.37, -1.37, 0.5, 0.5, 0.5, -0.2}) {
    EXPECT_NEAR(acceleration_mps2(ride), wanted_mps2, 1e-12);
    EXPECT_EQ(ride.cars()[0].commanded_mps2, wanted_mps2);
    ride.step();
  }
  EXPECT_EQ(ride.cars()[0].unit.state(), Guidance::kExpired);
  const auto outcomes = ride.take_outcomes();
  ASSERT_EQ(outcomes.size(), 1U);
  EXPECT_EQ(outcomes[0].outcome, AdviceOutcome::kApplied);
  EXPECT_EQ(outcomes[0].kind, AdviceKind::kProfile);
}

TEST(Profile, ThatComesLateBeginsWithTheSegmentThatIsDue) {
  Ride ride(with_arrivals(calm_parameters(), {0.0}));
  ride.run_to(50);
  Advice advice = as_profile(ride.advise(0, -1.0, 6), {{2, 0.5}, {5, -0.2}});
  advice.issued -= 4;  // its fifth step is the first that can use it
  send(ride, advice);
  EXPECT_EQ(ride.cars()[0].commanded_mps2, 0.5);
  ride.step();
  EXPECT_EQ(ride.cars()[0].commanded_mps2, -0.2);
  ride.step();
  EXPECT_TRUE(std::isnan(ride.cars()[0].commanded_mps2));
}

TEST(Profile, IsRefusedWholeIfOneSegmentIsBeyondTheLimits) {
  Ride ride(with_arrivals(calm_parameters(), {0.0}));
  ride.run_to(50);
  send(ride, as_profile(ride.advise(0, -1.0, 6), {{2, 0.5}, {5, -3.01}}));
  const auto outcomes = ride.take_outcomes();
  ASSERT_EQ(outcomes.size(), 1U);
  EXPECT_EQ(outcomes[0].outcome, AdviceOutcome::kOutOfLimit);
  EXPECT_TRUE(std::isnan(ride.cars()[0].commanded_mps2));
}

TEST(AdvisedSpeed, BecomesAnAccelerationInEveryStep) {
  Ride ride(with_arrivals(calm_parameters(), {0.0}));
  ride.run_to(50);  // 15 m/s
  send(ride, as_speed(ride.advise(0, 0.0, 100), 13.0));
  double speed_mps = 15.0;
  for (int step = 0; step < 60; ++step) {
    const double wanted_mps2 = (13.0 - speed_mps) / 2.0;  // -1 at first: within the bounds
    EXPECT_NEAR(acceleration_mps2(ride), wanted_mps2, 1e-9);
    speed_mps += 0.1 * wanted_mps2;
    EXPECT_NEAR(ride.cars()[0].motion.speed_mps, speed_mps, 1e-9);
    ride.step();
  }
  EXPECT_NEAR(speed_mps, 13.0, 0.1);  // 2 m/s * 0.95^60 = 0.09
  const auto outcomes = ride.take_outcomes();
  ASSERT_EQ(outcomes.size(), 1U);
  EXPECT_EQ(outcomes[0].outcome, AdviceOutcome::kApplied);
  EXPECT_EQ(outcomes[0].speed_mps, 13.0);
  EXPECT_NEAR(outcomes[0].command_mps2, -1.0, 1e-9);
}

TEST(AdvisedSpeed, IsMadeForWithinTheBoundsOfComfort) {
  Ride ride(with_arrivals(calm_parameters(), {0.0}));
  ride.run_to(50);
  send(ride, as_speed(ride.advise(0, 0.0, 20), 5.0));
  EXPECT_NEAR(acceleration_mps2(ride), -1.5, 1e-9);  // (5 - 15) / 2 = -5
  ride.run_to(70);
  send(ride, as_speed(ride.advise(0, 0.0, 20), 16.6));  // at 12 m/s: 2.3
  EXPECT_NEAR(acceleration_mps2(ride), 2.0, 1e-9);
}

TEST(AdvisedSpeed, AboveTheLimitOfTheRoadIsCutThere) {
  EngineParameters parameters = with_arrivals(calm_parameters(), {0.0});
  Ride ride(parameters);
  ride.run_to(50);
  send(ride, as_speed(ride.advise(0, 0.0, 100), 30.0));
  ride.run_to(100);
  EXPECT_NEAR(ride.cars()[0].motion.speed_mps, parameters.vehicles.speed_limit_mps, 1e-9);
  EXPECT_EQ(ride.take_outcomes().back().outcome, AdviceOutcome::kChangedLimit);
}

TEST(LaneSpeed, BoundsWhatADriverWishesUntilItsLifeEnds) {
  Ride ride(with_arrivals(calm_parameters(), {0.0}));
  ride.run_to(50);
  send(ride, as_speed(ride.advise(0, 0.0, 80), 14.0, AdviceKind::kLaneSpeed));
  EXPECT_NEAR(acceleration_mps2(ride), -1.0, 1e-9);  // (14 - 15) / 1 s, the free law
  EXPECT_TRUE(std::isnan(ride.cars()[0].commanded_mps2));
  EXPECT_EQ(ride.cars()[0].unit.state(), Guidance::kNeverAdvised);
  ride.run_to(130);
  EXPECT_NEAR(ride.cars()[0].motion.speed_mps, 14.0, 0.01);
  ride.step();
  EXPECT_NEAR(acceleration_mps2(ride), 1.0, 0.01);
  const auto outcomes = ride.take_outcomes();
  ASSERT_EQ(outcomes.size(), 1U);
  EXPECT_EQ(outcomes[0].outcome, AdviceOutcome::kApplied);
  EXPECT_EQ(outcomes[0].kind, AdviceKind::kLaneSpeed);
}

TEST(LaneSpeed, AboveTheWishOfADriverChangesNothing) {
  Ride ride(with_arrivals(calm_parameters(), {0.0}));
  ride.run_to(50);
  send(ride, as_speed(ride.advise(0, 0.0, 80), 16.0, AdviceKind::kLaneSpeed));
  EXPECT_NEAR(acceleration_mps2(ride), 0.0, 1e-9);
}

TEST(LaneSpeed, WaitsForAdviceToTheCarItself) {
  Ride ride(with_arrivals(calm_parameters(), {0.0}));
  ride.run_to(50);
  const Advice words[] = {as_speed(ride.advise(0, 0.0, 5), 14.0, AdviceKind::kLaneSpeed), ride.advise(0, 0.3, 10)};
  ride.step(words);
  for (int i = 0; i < 9; ++i) {
    EXPECT_NEAR(acceleration_mps2(ride), 0.3, 1e-9);
    ride.step();
  }
  const auto outcomes = ride.take_outcomes();
  ASSERT_EQ(outcomes.size(), 2U);
  EXPECT_EQ(outcomes[0].outcome, AdviceOutcome::kApplied);
  EXPECT_EQ(outcomes[0].kind, AdviceKind::kAcceleration);
  EXPECT_EQ(outcomes[1].outcome, AdviceOutcome::kExpired) << "the advice was in force for all of its life";
  EXPECT_EQ(outcomes[1].kind, AdviceKind::kLaneSpeed);
}

TEST(LaneSpeed, EndsWhenItsRsuFallsSilent) {
  Ride ride(with_arrivals(calm_parameters(), {0.0}));
  ride.run_to(50);
  Advice advice = as_speed(ride.advise(0, 0.0, 500), 10.0, AdviceKind::kLaneSpeed);
  advice.rsu = 1;  // a Ride hears RSU 0 alone
  send(ride, advice);
  ride.run_to(70);
  EXPECT_LT(ride.cars()[0].motion.speed_mps, 12.0);
  ride.run_to(71);  // heard at t_50, 2 s ago
  EXPECT_GT(acceleration_mps2(ride), 0.0);
}

TEST(LaneSpeed, ThatIsOlderThanTheOneInHandIsStale) {
  Ride ride(with_arrivals(calm_parameters(), {0.0}));
  ride.run_to(50);
  send(ride, as_speed(ride.advise(0, 0.0, 80), 14.0, AdviceKind::kLaneSpeed));
  Advice old = as_speed(ride.advise(0, 0.0, 80), 3.0, AdviceKind::kLaneSpeed);
  old.issued -= 10;
  send(ride, old);
  Advice late = as_speed(ride.advise(0, 0.0, 5), 3.0, AdviceKind::kLaneSpeed);
  late.issued -= 10;
  send(ride, late);
  const auto outcomes = ride.take_outcomes();
  ASSERT_EQ(outcomes.size(), 3U);
  EXPECT_EQ(outcomes[1].outcome, AdviceOutcome::kStale);
  EXPECT_EQ(outcomes[2].outcome, AdviceOutcome::kLate);
}

TEST(LaneSpeed, IsNotCompliedWithByWhoIgnoresAdvice) {
  EngineParameters parameters = with_arrivals(calm_parameters(), {0.0});
  parameters.compliance.ignoring_share = 1.0;
  Ride ride(parameters);
  ride.run_to(50);
  send(ride, as_speed(ride.advise(0, 0.0, 80), 5.0, AdviceKind::kLaneSpeed));
  EXPECT_NEAR(acceleration_mps2(ride), 0.0, 1e-9);
  EXPECT_EQ(ride.take_outcomes().at(0).outcome, AdviceOutcome::kNotComplied);
}

TEST(WordsOfTwoRsus, TheOneIssuedLastCountsAndOfEqualOnesThatOfTheHigherRsu) {
  Ride ride(with_arrivals(calm_parameters(), {0.0}));
  ride.run_to(50);
  Advice first = ride.advise(0, -0.5);
  first.rsu = 1;
  const Advice second = ride.advise(0, 0.5);
  const Advice words[] = {first, second};
  ride.step(words);
  EXPECT_EQ(ride.cars()[0].commanded_mps2, -0.5) << "issued together: RSU 1";
  send(ride, ride.advise(0, 0.4));
  EXPECT_EQ(ride.cars()[0].commanded_mps2, 0.4) << "issued later, by RSU 0";
}

}  // namespace
}  // namespace lukou::traffic
