#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "common/scenario/scenario.hpp"

namespace lukou::scenario {
namespace {

Resolved resolved(const std::string& text) {
  auto result = load_text(text, "my.textproto", "/nowhere");
  EXPECT_TRUE(result.ok()) << result.error().text();
  return std::move(result).value();
}

std::optional<LiveValue> value_of(const Resolved& scenario, const std::string& path) {
  for (const LiveValue& value : live_values(scenario)) {
    if (value.path == path) return value;
  }
  return std::nullopt;
}

TEST(LiveValues, ShowANumberAsItIsNow) {
  Resolved scenario = resolved("");
  const auto before = value_of(scenario, "traffic.west.flow_veh_per_h");
  ASSERT_TRUE(before);
  EXPECT_EQ(before->value, "1800");
  EXPECT_EQ(before->unit, "veh/h");
  EXPECT_EQ(before->min, 0.0);
  EXPECT_EQ(before->max, 10800.0);
  ASSERT_TRUE(change(scenario, "traffic.west.flow_veh_per_h=900").ok());
  EXPECT_EQ(value_of(scenario, "traffic.west.flow_veh_per_h")->value, "900");
}

TEST(LiveValues, ShowWhatCouldBeSetAndIsNot) {
  const auto absent = value_of(resolved(""), "radio.uplink.latency.constant_ms");
  ASSERT_TRUE(absent);
  EXPECT_EQ(absent->value, "");
  EXPECT_EQ(absent->max, 5000.0);
}

TEST(LiveValues, TellTheWordsOfAnEnum) {
  const auto preset = value_of(resolved(""), "signals.preset");
  ASSERT_TRUE(preset);
  EXPECT_EQ(preset->value, "PAPER");
  EXPECT_EQ(preset->words, (std::vector<std::string>{"PAPER", "PAPER_YELLOW", "PROTECTED_LEFT"}));
}

TEST(LiveValues, NumberTheEntriesOfLists) {
  const Resolved scenario = resolved("rsus { sensors { approach: WEST } sensors { approach: EAST miss_rate: 0.5 } }");
  EXPECT_EQ(value_of(scenario, "rsus[0].sensors[1].miss_rate")->value, "0.5");
  EXPECT_FALSE(value_of(scenario, "rsus[0].sensors[2].miss_rate"));
}

TEST(LiveValues, HoldNothingThatStaysAsItIs) {
  const auto values = live_values(resolved(""));
  EXPECT_TRUE(std::ranges::none_of(values, [](const LiveValue& v) { return v.path == "vehicles.length_m"; }));
  // And each of them can be set to what it is.
  Resolved scenario = resolved("");
  for (const LiveValue& value : values) {
    if (value.value.empty()) continue;
    EXPECT_TRUE(change(scenario, value.path + "=" + value.value).ok()) << value.path << "=" << value.value;
  }
}

TEST(LiveValues, ShowAPlanAsAWhole) {
  Resolved scenario = resolved("");
  EXPECT_EQ(value_of(scenario, "signals.plan")->value, "");
  const std::string plan =
      "signals.plan={cycle_s: 40 lane_plans {lanes: [\"WL\",\"WC\",\"WR\",\"EL\",\"EC\",\"ER\"] aspects {aspect: GREEN "
      "duration_s: 20} aspects {aspect: RED duration_s: 20}} lane_plans {lanes: [\"SL\",\"SC\",\"SR\",\"NL\",\"NC\","
      "\"NR\"] aspects {aspect: RED duration_s: 20} aspects {aspect: GREEN duration_s: 20}}}";
  ASSERT_TRUE(change(scenario, plan).ok());
  const std::string value = value_of(scenario, "signals.plan")->value;
  EXPECT_TRUE(value.starts_with("{")) << value;
  EXPECT_TRUE(change(scenario, "signals.plan=" + value).ok()) << value;
}

TEST(SignalPresets, AreThoseOfTheSchema) {
  const auto presets = signal_presets();
  ASSERT_EQ(presets.size(), 3U);
  EXPECT_EQ(presets[0].name, "PAPER");
  EXPECT_EQ(presets[0].plan, paper_plan());
  EXPECT_EQ(presets[2].name, "PROTECTED_LEFT");
}

}  // namespace
}  // namespace lukou::scenario
