#include "common/measures/run_measures.hpp"

#include <gtest/gtest.h>

#include <tuple>

#include "common/measures/free_motion.hpp"
#include "tests/unit/common/measures/measures_script.hpp"

namespace lukou {
namespace {

using test::kWestCenter;
using test::Script;

constexpr double kKmh = 1.0 / 3.6;
TEST(RunMeasures, CountsAStopOnceUntilTheCarIsFastAgain) {
  Script script;
  script.enter(0);
  script.drive(0, 0.0, 15.0);
  script.next();
  // Below 5 km/h, above it but below 8, below again: one stop. Above 8 and below again: a second.
  for (const double speed_kmh : {4.9, 7.9, 4.0, 0.0, 8.1, 4.0}) {
    script.drive(0, 10.0, speed_kmh * kKmh);
    script.next();
  }
  const LaneTotals& lane = script.measures().lanes()[kWestCenter];
  EXPECT_EQ(lane.stops, 2U);
  EXPECT_EQ(lane.standing_steps, 4U);
  EXPECT_DOUBLE_EQ(lane.stop_time_s(), 0.4);
  EXPECT_EQ(lane.standing_now, 1U);
  EXPECT_EQ(script.measures().lanes()[0].stops, 0U);
}

TEST(RunMeasures, DoesNotCountStopsWhileTheCarStands) {
  Script script;
  script.enter(0);
  script.drive(0, 0.0, 15.0);
  script.next();
  for (int i = 0; i < 50; ++i) {
    script.drive(0, 10.0, 0.0);
    script.next();
  }
  EXPECT_EQ(script.measures().lanes()[kWestCenter].stops, 1U);
  EXPECT_DOUBLE_EQ(script.measures().lanes()[kWestCenter].stop_time_s(), 5.0);
}

TEST(RunMeasures, LeavesStandingAfterTheLineOut) {
  Script script;
  script.enter(0);
  script.drive(0, 0.0, 15.0);
  script.next();
  script.drive(0, 501.0, 0.0, CarState::kExit);
  script.next();
  EXPECT_EQ(script.measures().lanes()[kWestCenter].standing_steps, 0U);
  EXPECT_EQ(script.measures().lanes()[kWestCenter].standing_now, 0U);
}

TEST(RunMeasures, WritesTheRowOfACar) {
  Script script;
  for (int k = 0; k < 10; ++k) script.next();
  script.enter(1, true, 10.0);  // at 1.0 s
  script.drive(1, 0.0, 10.0);
  script.next();
  script.drive(1, 400.0, 1.0);
  script.next();
  script.cross(1, 61.25);
  script.drive(1, 501.0, 1.0, CarState::kExit);
  script.next();
  script.leave(1, 70.5);
  EXPECT_TRUE(script.finished().empty());
  script.next();
  ASSERT_EQ(script.finished().size(), 1U);
  const FinishedCar& car = script.finished()[0];
  EXPECT_EQ(car.vehicle, 1U);
  EXPECT_EQ(car.lane, Lane(kWestCenter));
  EXPECT_TRUE(car.equipped);
  EXPECT_DOUBLE_EQ(car.entered_s, 1.0);
  EXPECT_DOUBLE_EQ(car.initial_speed_mps, 10.0);
  const double limit_mps = 60.0 / 3.6;
  const double ramp_m = (limit_mps * limit_mps - 100.0) / 6.0;
  EXPECT_NEAR(car.theoretical_time_s, (limit_mps - 10.0) / 3.0 + (500.0 - ramp_m) / limit_mps, 1e-12);
  EXPECT_DOUBLE_EQ(car.act_time_s, 60.25);
  EXPECT_DOUBLE_EQ(car.delta_s, 60.25 - car.theoretical_time_s);
  // 5 m/s below the desired speed: 2 m/s at 3 m/s2, then the relaxation.
  EXPECT_NEAR(car.delay_s, 69.5 - free_time_s({.initial_mps = 10.0, .desired_mps = 15.0}, 600.0), 1e-12);
  EXPECT_EQ(car.stops, 1U);
  EXPECT_EQ(car.standing_steps, 1U);
  EXPECT_DOUBLE_EQ(car.left_s, 70.5);
}

TEST(RunMeasures, GivesCarsInTheOrderInWhichTheyLeft) {
  Script script;
  script.enter(0);
  script.enter(4);
  script.drive(0, 10.0, 15.0);
  script.drive(4, 0.0, 15.0);
  script.next();
  script.cross(0, 0.11), script.cross(4, 0.12);
  script.next();
  script.leave(4, 0.25), script.leave(0, 0.21);
  script.next();
  ASSERT_EQ(script.finished().size(), 2U);
  EXPECT_EQ(script.finished()[0].vehicle, 0U);
  EXPECT_EQ(script.finished()[1].vehicle, 4U);
}

TEST(RunMeasures, HasNoMeansWithoutCars) {
  Script script(10.0);
  script.next();
  const RunFigures figures = script.measures().figures();
  EXPECT_FALSE(figures.all.mean_delta_s);
  EXPECT_FALSE(figures.all.mean_delay_s);
  EXPECT_FALSE(figures.all.stops_per_vehicle);
  EXPECT_FALSE(figures.all.mean_queue_veh);
  EXPECT_FALSE(figures.all.throughput_veh_per_h);
  EXPECT_FALSE(figures.min_head_distance_m);
}

TEST(RunMeasures, SpeaksOnlyOfCarsThatEnteredAfterTheWarmUp) {
  Script script(1.0);
  script.enter(0);
  script.drive(0, 0.0, 0.0);
  script.next();
  while (script.step() < 10) script.next();
  script.enter(4, true);  // at 1.0 s: the first that counts
  script.drive(0, 10.0, 0.0), script.drive(4, 0.0, 0.0);
  script.next();
  script.cross(0, 1.1), script.cross(4, 1.1);
  script.next();
  script.leave(0, 1.15), script.leave(4, 1.2);
  script.next();
  const RunFigures figures = script.measures().figures();
  EXPECT_EQ(figures.all.cars, 1U);
  EXPECT_EQ(figures.equipped.cars, 1U);
  EXPECT_EQ(figures.unequipped.cars, 0U);
  EXPECT_FALSE(figures.unequipped.mean_delta_s);
  EXPECT_DOUBLE_EQ(*figures.all.stops_per_vehicle, 1.0);
  EXPECT_DOUBLE_EQ(*figures.all.mean_stop_time_s, 0.1);
  EXPECT_NEAR(*figures.equipped.mean_delay_s, 0.2 - 40.0, 1e-9);
  EXPECT_EQ(figures.all.vehicles_entered, 2U);
  EXPECT_EQ(figures.all.vehicles_left, 2U);
  // Two crossings in the 0.2 s after the warm-up.
  EXPECT_NEAR(*figures.all.throughput_intersection_veh_per_h, 2.0 / 0.2 * 3600.0, 1e-6);
  EXPECT_NEAR(*figures.all.throughput_veh_per_h, 2.0 / 0.2 * 900.0, 1e-6);
}

TEST(RunMeasures, AveragesTheSizeOfTheAccelerationOverCarsAndSteps) {
  Script script(0.1);
  script.enter(0, true), script.enter(4);
  script.next();
  script.drive(0, 10.0, 15.0, CarState::kIn, 3.0), script.drive(4, 0.0, 15.0);  // the last step of the warm-up
  script.next();
  script.drive(0, 12.0, 15.0, CarState::kExit, -2.0), script.drive(4, 1.0, 15.0, CarState::kIn, 1.0);
  script.next();
  script.drive(4, 2.0, 15.0, CarState::kIn, -0.5);
  script.next();
  const RunFigures figures = script.measures().figures();
  EXPECT_DOUBLE_EQ(*figures.all.mean_abs_acceleration_mps2, 3.5 / 3);
  EXPECT_DOUBLE_EQ(*figures.equipped.mean_abs_acceleration_mps2, 2.0);
  EXPECT_DOUBLE_EQ(*figures.unequipped.mean_abs_acceleration_mps2, 1.5 / 2);
}

TEST(RunMeasures, AveragesTheQueueOverStepsAndLanes) {
  Script script(0.1);
  script.enter(0, true), script.enter(4);
  script.next();
  script.drive(0, 10.0, 0.0), script.drive(4, 0.0, 0.0);  // the last step of the warm-up
  script.next();
  script.drive(0, 10.0, 0.0), script.drive(4, 0.0, 0.0);
  script.next();
  script.drive(0, 10.0, 0.0), script.drive(4, 0.0, 15.0);
  script.next();
  const RunFigures figures = script.measures().figures();
  EXPECT_DOUBLE_EQ(*figures.all.mean_queue_veh, 3.0 / (2 * 12));
  EXPECT_DOUBLE_EQ(*figures.equipped.mean_queue_veh, 2.0 / (2 * 12));
  EXPECT_DOUBLE_EQ(*figures.unequipped.mean_queue_veh, 1.0 / (2 * 12));
}

TEST(RunMeasures, CountsEachAdviceByItsLastFate) {
  Script script;
  script.fate(AdviceFate::kApplied), script.fate(AdviceFate::kApplied), script.fate(AdviceFate::kExpired);
  script.next();
  script.fate(AdviceFate::kChangedGuard, true), script.fate(AdviceFate::kChangedRed);
  script.next();
  const RunFigures figures = script.measures().figures();
  EXPECT_EQ(figures.advice_sent, 4U);
  EXPECT_EQ(figures.advice(AdviceFate::kApplied), 1U);
  EXPECT_EQ(figures.advice(AdviceFate::kChangedGuard), 1U);
  EXPECT_EQ(figures.advice(AdviceFate::kChangedRed), 1U);
  EXPECT_EQ(figures.advice(AdviceFate::kExpired), 1U);
}

TEST(RunMeasures, CountsADuplicateApartFromItsAdvice) {
  Script script;
  script.fate(AdviceFate::kApplied), script.fate(AdviceFate::kDuplicate), script.fate(AdviceFate::kLostBurst);
  script.next();
  const RunFigures figures = script.measures().figures();
  EXPECT_EQ(figures.advice_sent, 2U);
  EXPECT_EQ(figures.advice(AdviceFate::kDuplicate), 1U);
  EXPECT_EQ(figures.advice(AdviceFate::kLostBurst), 1U);
}

TEST(RunMeasures, SeesCollisionsReversalsAndCrossingsOnRed) {
  Script script;
  script.enter(0), script.enter(4);
  script.drive(0, 5.0, 1.0), script.drive(4, 0.0, 1.0);
  script.next();
  script.drive(0, 5.0, 1.0), script.drive(4, 0.6, 1.0);  // 4.4 m apart: a collision
  script.next();
  script.drive(0, 5.0, 1.0), script.drive(4, 0.6, 1.0);  // the same one
  script.next();
  script.drive(0, 5.0, 1.0), script.drive(4, 0.1, 1.0);  // moved backwards
  script.cross(0, 0.3, Aspect::kRed), script.cross(4, 0.3, Aspect::kYellow);
  script.next();
  const RunFigures figures = script.measures().figures();
  EXPECT_EQ(figures.collisions, 1U);
  EXPECT_EQ(figures.reversals, 1U);
  EXPECT_EQ(figures.red_crossings, 1U);
  EXPECT_NEAR(*figures.min_head_distance_m, 4.4, 1e-12);
}

TEST(RunMeasures, CopiesTheNewestCountsOfArrivals) {
  Script script;
  script.counts(3, 1, 1);
  script.next();
  script.counts(5, 2, 2);
  script.next();
  const RunFigures figures = script.measures().figures();
  EXPECT_EQ(figures.all.vehicles_arrived, 5U);
  EXPECT_EQ(figures.equipped.vehicles_arrived, 2U);
  EXPECT_EQ(figures.unequipped.vehicles_arrived, 3U);
  EXPECT_EQ(figures.all.vehicles_waiting, 2U);
  EXPECT_EQ(figures.unequipped.vehicles_waiting, 2U);
}

TEST(RunMeasures, CountsTheDelayOfEveryCarThatArrivedAfterTheWarmUpWhereverItIs) {
  Script script(1.0);
  script.enter(0);  // before the warm-up: counts nowhere
  script.drive(0, 0.0, 15.0);
  for (int k = 0; k < 10; ++k) script.next();
  // At 1.0 s three cars arrive: one enters at once, one at 3.0 s, one never.
  script.enter(4);
  script.arrive(8, true);
  script.arrive(12);
  for (int k = 10; k < 30; ++k) script.next();
  script.enter_waiting(8, true);
  script.next();  // 3.0 s
  script.leave(4, 43.5);
  script.drive(8, 150.0, 15.0);
  for (int k = 31; k < 151; ++k) script.next();  // 15.0 s
  const RunFigures figures = script.measures().figures();
  // At 15 m/s, the desired speed, 600 m take 40 s and 150 m take 10 s.
  const double left_s = 42.5 - 40.0;
  const double on_road_s = 2.0 + (12.0 - 10.0);
  const double outside_s = 14.0;
  EXPECT_EQ(figures.all.cars_arrived, 3U);
  EXPECT_NEAR(*figures.all.mean_delay_all_s, (left_s + on_road_s + outside_s) / 3.0, 1e-9);
  EXPECT_NEAR(*figures.all.mean_entry_wait_s, (0.0 + 2.0 + 14.0) / 3.0, 1e-9);
  EXPECT_EQ(figures.equipped.cars_arrived, 1U);
  EXPECT_NEAR(*figures.equipped.mean_delay_all_s, on_road_s, 1e-9);
  EXPECT_NEAR(*figures.unequipped.mean_entry_wait_s, 7.0, 1e-9);
}

TEST(RunMeasures, TellsAStopWhenItIsOver) {
  Script script;
  script.enter(0, true);
  script.drive_guided(0, 0.0, 15.0, GuidanceState::kNeverAdvised);
  script.next();
  // Below 5 km/h in the steps 1 ... 4, between 5 and 8 in step 5, below 5 in step 6, fast in step 7: one stop of 0.5 s.
  // What holds when it begins counts, not what comes later.
  script.drive_guided(0, 470.25, 4.0 * kKmh, GuidanceState::kExpired, BoundBy::kLight,
                      static_cast<std::uint8_t>(AdviceFate::kLostBurst));
  script.next();
  for (const double speed_kmh : {0.0, 0.0, 4.0, 7.0, 4.0}) {
    script.drive_guided(0, 471.0, speed_kmh * kKmh, GuidanceState::kInForce, BoundBy::kAdvice);
    script.next();
  }
  EXPECT_TRUE(script.stops().empty());
  ASSERT_EQ(script.measures().lasting_stops().size(), 1U);
  EXPECT_EQ(script.measures().lasting_stops()[0].ended, 6);
  script.drive_guided(0, 480.0, 9.0 * kKmh, GuidanceState::kInForce, BoundBy::kAdvice);
  script.next();
  ASSERT_EQ(script.stops().size(), 1U);
  const FinishedStop& stop = script.stops()[0];
  EXPECT_EQ(stop.vehicle, 0U);
  EXPECT_TRUE(stop.equipped);
  EXPECT_EQ(stop.began, 1);
  EXPECT_EQ(stop.ended, 7);
  EXPECT_EQ(stop.standing_steps, 5U);
  EXPECT_DOUBLE_EQ(stop.distance_m, 29.75);
  EXPECT_EQ(stop.cause, "lost_burst");
  EXPECT_EQ(stop.guidance, "expired");
  EXPECT_EQ(stop.missed, "lost_burst");
  EXPECT_TRUE(script.measures().lasting_stops().empty());
}

TEST(RunMeasures, EndsAStopAtTheStopLine) {
  Script script;
  script.enter(0);
  script.drive(0, 0.0, 15.0);
  script.next();
  script.drive(0, 499.9, 1.0);
  script.next();
  script.drive(0, 500.1, 1.3, CarState::kExit);
  script.cross(0, 0.15);
  script.next();
  ASSERT_EQ(script.stops().size(), 1U);
  EXPECT_EQ(script.stops()[0].standing_steps, 1U);
  EXPECT_EQ(script.stops()[0].ended, 2);
}

TEST(RunMeasures, SeesTheCarAheadOfAStopOnlyIfItStandsBeforeTheLine) {
  for (const auto& [speed_mps, state, cause] : {std::tuple(0.5, CarState::kIn, "queue_ahead"),
                                                {3.0, CarState::kIn, "overridden_red"},
                                                {0.5, CarState::kExit, "overridden_red"}}) {
    Script script;
    script.enter(0);
    script.drive(0, 10.0, 15.0);
    script.next();
    script.enter(4, true);
    script.drive(0, 490.0, speed_mps, state);
    script.drive_guided(4, 480.0, 1.0, GuidanceState::kInForce);
    script.next();
    ASSERT_FALSE(script.measures().lasting_stops().empty());
    EXPECT_EQ(script.measures().lasting_stops().back().cause, cause);
  }
}

TEST(RunMeasures, CountsEveryStopUnderOneCause) {
  Script script;
  for (const std::uint32_t vehicle : {0U, 4U, 8U}) script.enter(vehicle, vehicle != 0);
  for (int round = 0; round < 3; ++round) {
    for (const double speed_mps : {10.0, 0.0}) {
      script.drive(0, 300.0, speed_mps);
      script.drive_guided(4, 200.0, speed_mps, GuidanceState::kReleased, BoundBy::kCarAhead);
      script.drive_guided(8, 100.0, speed_mps, GuidanceState::kInForce, BoundBy::kAdvice);
      script.next();
    }
  }
  const RunFigures figures = script.measures().figures();
  EXPECT_EQ(figures.stops_total, 9U);
  const auto of = [&](StopCause cause) { return figures.stops_by_cause[static_cast<std::size_t>(cause)]; };
  EXPECT_EQ(of(StopCause::kUnequipped), 3U);
  EXPECT_EQ(of(StopCause::kQueueAhead), 3U);
  EXPECT_EQ(of(StopCause::kAdvised), 3U);
  EXPECT_EQ(script.stops().size() + script.measures().lasting_stops().size(), 9U);
}

TEST(RunMeasures, AddUpFuelAndKeepStandingApart) {
  Script script;
  script.enter(0, true);
  script.drive(0, 0.0, 10.0);
  script.next();
  for (int i = 0; i < 20; ++i) {
    script.drive(0, 100.0, 0.0);
    script.next();
  }
  script.drive(0, 101.0, 10.0, CarState::kIn, 2.0);
  script.next();
  script.cross(0, 2.2);
  script.next();
  script.leave(0, 2.3);
  script.next();
  // Idle: 20 steps of 0.01569 mL. At 10 m/s 0.1569 + 0.245 - 0.07415 + 0.05975 = 0.3875 mL/s, twice for 0.1 s; the
  // second time with 2 m/s2 on top: 2 * (0.07224 + 0.9681 + 0.1075) = 2.29568 mL/s.
  ASSERT_EQ(script.finished().size(), 1U);
  const FinishedCar& car = script.finished()[0];
  EXPECT_NEAR(car.fuel_standing_ml, 0.3138, 1e-12);
  EXPECT_NEAR(car.fuel_ml, 0.3138 + 2 * 0.03875 + 0.229568, 1e-12);
  const RunFigures figures = script.measures().figures();
  EXPECT_NEAR(figures.equipped.fuel.accelerating_ml, 0.229568, 1e-12);
  EXPECT_NEAR(figures.all.fuel.standing_ml, 0.3138, 1e-12);
  EXPECT_DOUBLE_EQ(figures.all.fuel.fuel_ml, car.fuel_ml);
  EXPECT_DOUBLE_EQ(*figures.all.mean_fuel_ml, car.fuel_ml);
  EXPECT_DOUBLE_EQ(figures.unequipped.fuel.fuel_ml, 0.0);
  EXPECT_FALSE(figures.unequipped.mean_fuel_ml);
}

}  // namespace
}  // namespace lukou
