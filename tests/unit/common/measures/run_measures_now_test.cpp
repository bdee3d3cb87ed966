#include <gtest/gtest.h>

#include "tests/unit/common/measures/measures_script.hpp"

namespace lukou {
namespace {

using test::Script;

TEST(RunMeasuresNow, CountsFromTheFirstStepWhateverTheWarmUp) {
  Script script(1000.0);
  script.counts(5, 3, 1);
  script.enter_waiting(0, true);
  script.enter_waiting(4);
  script.drive(0, 20.0, 15.0);
  script.drive(4, 5.0, 15.0);
  script.next();
  for (int i = 0; i < 3; ++i) {
    script.drive(0, 20.0, 0.0);
    script.drive(4, 5.0, 15.0);
    script.next();
  }
  const RunNow now = script.measures().now();
  EXPECT_EQ(now.all.arrived, 5U);
  EXPECT_EQ(now.all.waiting, 1U);
  EXPECT_EQ(now.all.in_system, 2U);
  EXPECT_EQ(now.equipped.arrived, 3U);
  EXPECT_EQ(now.equipped.standing, 1U);
  EXPECT_EQ(now.unequipped.standing, 0U);
  EXPECT_EQ(now.all.stops, 1U);
  EXPECT_EQ(now.all.standing_steps, 3U);
  EXPECT_EQ(now.all.stops_per_vehicle, 0.5) << "one stop, two cars on the road";
  EXPECT_EQ(now.equipped.mean_stop_time_s, 0.3);
  EXPECT_EQ(now.unequipped.mean_stop_time_s, 0.0);
  EXPECT_FALSE(now.all.mean_delay_s.has_value()) << "nobody has left";
  EXPECT_EQ(script.measures().now(0).standing_steps, 3U);
  EXPECT_EQ(script.measures().now(4).standing_steps, 0U);
}

TEST(RunMeasuresNow, KnowsTheThroughputOfTheLastMinute) {
  Script script;
  script.enter(0);
  script.enter(4, true);
  script.drive(0, 499.0, 15.0);
  script.drive(4, 490.0, 15.0);
  script.next();
  script.cross(0, 0.1);
  script.cross(4, 0.1);
  script.next();  // step 1: two crossings in 0.1 s
  EXPECT_EQ(script.measures().now().all.throughput_veh_per_h, 72000.0);
  while (script.step() <= 600) script.next();
  // Two in the whole first minute, steps 1 to 600.
  EXPECT_EQ(script.measures().now().all.throughput_veh_per_h, 120.0);
  EXPECT_EQ(script.measures().now().equipped.throughput_veh_per_h, 60.0);
  script.next();  // step 601: step 1 is a minute ago
  EXPECT_EQ(script.measures().now().all.throughput_veh_per_h, 0.0);
}

TEST(RunMeasuresNow, TellsTheNewestAdviceThatReachedACar) {
  Script script;
  script.enter(0, true);
  script.drive(0, 10.0, 15.0);
  script.next();
  EXPECT_EQ(script.measures().now(0).newest_advice, -1);
  script.drive(0, 11.0, 15.0);
  script.fate(AdviceFate::kApplied, false, 0, 7);
  script.fate(AdviceFate::kStale, false, 0, 5);
  script.fate(AdviceFate::kLostRandom, false, 0, 9);
  script.fate(AdviceFate::kApplied, false, 4, 8);
  script.next();
  EXPECT_EQ(script.measures().now(0).newest_advice, 7) << "one was older, one lost, one for a car that is not there";
}

}  // namespace
}  // namespace lukou
