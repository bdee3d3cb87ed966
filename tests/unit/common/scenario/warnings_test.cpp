#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "common/scenario/scenario.hpp"

namespace lukou::scenario {
namespace {

std::vector<std::string> warned(const std::string& text) {
  const auto result = load_text(text, "my.textproto", "/nowhere");
  EXPECT_TRUE(result.ok()) << result.error().text();
  return warnings(result.value());
}

bool has_line(const std::vector<std::string>& lines, const std::string& part) {
  return std::any_of(lines.begin(), lines.end(),
                     [&](const std::string& line) { return line.find(part) != std::string::npos; });
}

TEST(Capacity, IsThatOfTheLaneThatSaturatesFirst) {
  const lukou::SignalPlan plan = paper_plan();
  // Half of the cycle is green: 1803 / 2 veh/h a lane, three lanes.
  EXPECT_NEAR(capacity_veh_per_h(plan, Approach::kWest, {1.0, 1.0, 1.0}), 2704.5, 1e-9);
  // Half of the cars take the centre lane: it is full at twice its own capacity.
  EXPECT_NEAR(capacity_veh_per_h(plan, Approach::kWest, {1.0, 2.0, 1.0}), 1803.0, 1e-9);
  // A lane that nobody takes does not count.
  EXPECT_NEAR(capacity_veh_per_h(plan, Approach::kWest, {0.0, 1.0, 0.0}), 901.5, 1e-9);
}

TEST(Capacity, CountsNoYellow) {
  // 42 s of 90 s.
  EXPECT_NEAR(capacity_veh_per_h(paper_yellow_plan(), Approach::kNorth, {1.0, 1.0, 1.0}), 3.0 * 1803.0 * 42.0 / 90.0,
              1e-9);
}

TEST(Warnings, NameApproachDemandAndCapacity) {
  const auto said = warned("traffic { south { flow_veh_per_h: 2800 } }");
  EXPECT_TRUE(has_line(said, "traffic.south: the demand of 2800 veh/h is above the capacity of 2705 veh/h"));
  EXPECT_FALSE(has_line(said, "traffic.west"));
}

TEST(Warnings, LookAtThePeakOfASeriesThatFallsIntoTheRun) {
  const std::string series =
      "traffic { south { flow_series { from_s: 0 flow_veh_per_h: 100 } flow_series { from_s: 600 flow_veh_per_h: 3000 "
      "} "
      "flow_series { from_s: 700 flow_veh_per_h: 100 } } }";
  EXPECT_TRUE(has_line(warned(series), "traffic.south: the demand of 3000 veh/h"));
  EXPECT_FALSE(has_line(warned(series + " run { duration_s: 600 warmup_s: 100 }"), "traffic.south"));
}

TEST(Warnings, SayThatOpposedLeftTurnsDoNotYield) {
  EXPECT_TRUE(has_line(warned(""), "(WL-EC, WC-EL, SL-NC, SC-NL); they do not wait for a gap"));
  EXPECT_FALSE(has_line(warned("signals { preset: PROTECTED_LEFT }"), "wait for a gap"));
}

TEST(Warnings, SayThatAWarmUpLeavesNothingToMeasure) {
  EXPECT_TRUE(has_line(warned("run { duration_s: 100 warmup_s: 100 }"),
                       "run.warmup_s: the warm-up of 100 s does not end before the run does, after 100 s"));
  EXPECT_FALSE(has_line(warned("run { duration_s: 100 warmup_s: 99.9 }"), "warmup"));
}

TEST(Warnings, SayThatTheApproachIsShorterThanDriversLook) {
  EXPECT_TRUE(has_line(warned("traffic { approach_length_m: 200 } driving { reaction_distance_m: 250 }"),
                       "from 250 m on, but the approach is only 200 m long"));
}

TEST(Warnings, SayThatTwoSensorsOfAnRsuSeeTheSameCars) {
  const std::string near = "sensors { approach: WEST to_m: 120 }";
  EXPECT_TRUE(has_line(warned("rsus { " + near + " sensors { approach: WEST from_m: 100 to_m: 250 } }"),
                       "rsus[0].sensors: [0] and [1] both see the cars 100 to 120 m before the line"));
  EXPECT_FALSE(has_line(warned("rsus { " + near + " sensors { approach: WEST from_m: 120 to_m: 250 } }"), "both see"));
  EXPECT_FALSE(has_line(warned("rsus { " + near + " sensors { approach: EAST } }"), "both see"));
  EXPECT_FALSE(has_line(warned("rsus { " + near + " } rsus { " + near + " }"), "both see"));
}

}  // namespace
}  // namespace lukou::scenario
