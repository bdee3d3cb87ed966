#include <gtest/gtest.h>

#include <string>

#include "common/scenario/scenario.hpp"
#include "scenario.pb.h"

namespace lukou::scenario {
namespace {

Resolved resolved(const std::string& text) {
  auto result = load_text(text, "my.textproto", "/nowhere");
  EXPECT_TRUE(result.ok()) << result.error().text();
  return std::move(result).value();
}

TEST(Change, SetsALiveField) {
  Resolved scenario = resolved("");
  ASSERT_TRUE(change(scenario, "traffic.west.flow_veh_per_h=900").ok());
  EXPECT_EQ(scenario.message().traffic().west().flow_veh_per_h(), 900.0);
}

TEST(Change, OfAnotherFieldIsRefusedWithTheListOfLiveFields) {
  Resolved scenario = resolved("");
  const std::string before = text(scenario);
  const auto result = change(scenario, "vehicles.length_m=4");
  ASSERT_FALSE(result.ok());
  EXPECT_EQ(result.error().text(),
            "vehicles.length_m=4: vehicles.length_m cannot change while a run goes on; these can: "
            "traffic.west.flow_veh_per_h, traffic.south.flow_veh_per_h, traffic.east.flow_veh_per_h, "
            "traffic.north.flow_veh_per_h, vehicles.equipped_ratio, vehicles.on_board_unit.fallback_s, "
            "vehicles.on_board_unit.rsu_lost_after_s, vehicles.on_board_unit.speed_gain_time_s, "
            "vehicles.on_board_unit.speed_acceleration_mps2, vehicles.on_board_unit.speed_deceleration_mps2, "
            "vehicles.compliance.human_share, "
            "vehicles.compliance.ignoring_share, vehicles.compliance.reaction_s, "
            "vehicles.compliance.gain_deviation, vehicles.compliance.threshold_mps2, vehicles.positioning, "
            "vehicles.clock_offset_ms, signals.preset, signals.plan, "
            "radio.uplink.latency, radio.uplink.loss.rate, radio.uplink.loss.burst, radio.uplink.range_m, "
            "radio.uplink.duplicate_rate, radio.uplink.path_loss, radio.uplink.half_duplex, "
            "radio.uplink.collisions, radio.downlink.latency, radio.downlink.loss.rate, "
            "radio.downlink.loss.burst, radio.downlink.range_m, radio.downlink.duplicate_rate, "
            "radio.downlink.path_loss, radio.downlink.half_duplex, radio.downlink.collisions, radio.load, "
            "radio.vehicle_to_vehicle.latency, radio.vehicle_to_vehicle.loss.rate, "
            "radio.vehicle_to_vehicle.loss.burst, radio.vehicle_to_vehicle.range_m, "
            "radio.vehicle_to_vehicle.duplicate_rate, radio.vehicle_to_vehicle.path_loss, "
            "radio.vehicle_to_vehicle.half_duplex, radio.vehicle_to_vehicle.collisions, radio.awareness_m, "
            "radio.reservation, radio.outages[], rsus[].sensors[].miss_rate, rsus[].sensors[].position_noise_m, "
            "rsus[].sensors[].speed_noise_mps, rsus[].sensors[].latency_ms");
  EXPECT_EQ(text(scenario), before);
}

TEST(Change, OfAWholeMessageThatHoldsALiveFieldIsRefused) {
  Resolved scenario = resolved("");
  EXPECT_FALSE(change(scenario, "traffic.west={flow_veh_per_h: 100}").ok());
}

TEST(Change, OutOfRangeLeavesTheScenarioAsItWas) {
  Resolved scenario = resolved("");
  const std::string before = text(scenario);
  const auto result = change(scenario, "vehicles.equipped_ratio=1.5");
  ASSERT_FALSE(result.ok());
  EXPECT_EQ(result.error().text(),
            "vehicles.equipped_ratio=1.5: vehicles.equipped_ratio is 1.5, must be within [0, 1]");
  EXPECT_EQ(text(scenario), before);
}

TEST(Change, OfTheFlowIsRefusedWhereASeriesSaysIt) {
  Resolved scenario = resolved("traffic { west { flow_series { from_s: 0 flow_veh_per_h: 100 } } }");
  EXPECT_FALSE(change(scenario, "traffic.west.flow_veh_per_h=900").ok());
  EXPECT_TRUE(change(scenario, "traffic.east.flow_veh_per_h=900").ok());
}

TEST(Change, OfThePlanReplacesThePresetAndBack) {
  Resolved scenario = resolved("");
  ASSERT_TRUE(change(scenario,
                     "signals.plan={cycle_s: 30 lane_plans {lanes: ['WL','WC','WR','EL','EC','ER'] "
                     "aspects {aspect: GREEN duration_s: 15} aspects {aspect: RED duration_s: 15}} "
                     "lane_plans {lanes: ['SL','SC','SR','NL','NC','NR'] "
                     "aspects {aspect: RED duration_s: 15} aspects {aspect: GREEN duration_s: 15}}}")
                  .ok());
  EXPECT_FALSE(scenario.message().signals().has_preset());
  EXPECT_EQ(signal_plan(scenario).value().cycle, 300);
  EXPECT_FALSE(change(scenario, "signals.plan.cycle_s=40").ok()) << "the lanes still add up to 30 s";
  EXPECT_EQ(signal_plan(scenario).value().cycle, 300);
  ASSERT_TRUE(change(scenario, "signals.preset=PAPER").ok());
  EXPECT_EQ(signal_plan(scenario).value(), paper_plan());
}

}  // namespace
}  // namespace lukou::scenario
