#include "common/scenario/radio.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "common/scenario/scenario.hpp"
#include "scenario.pb.h"

namespace lukou::scenario {
namespace {

Expected<Resolved> loaded(const std::string& text, const std::vector<std::string>& sets = {}) {
  return load_text(text, "my.textproto", "/nowhere", sets);
}

RadioParameters radio_of(const std::string& text, const std::vector<std::string>& sets = {}) {
  const auto result = loaded(text, sets);
  EXPECT_TRUE(result.ok()) << result.error().text();
  return radio_parameters(result.value().message());
}

std::string error_of(const std::string& text, const std::vector<std::string>& sets = {}) {
  const auto result = loaded(text, sets);
  return result.ok() ? "" : result.error().text();
}

TEST(Radio, IsIdealUnlessTheScenarioSaysOtherwise) {
  EXPECT_FALSE(radio_of("").modelled);
  EXPECT_FALSE(radio_of("radio { preset: IDEAL }").modelled);
  const auto result = loaded("");
  ASSERT_TRUE(result.ok());
  EXPECT_FALSE(result.value().message().radio().has_uplink());
  EXPECT_FALSE(result.value().message().radio().has_downlink());
}

TEST(Radio, TakesOneLinkAndLeavesTheOtherIdeal) {
  const RadioParameters radio = radio_of("run { seed: 9 } radio { downlink { loss { rate: 0.25 } range_m: 300 } }");
  EXPECT_TRUE(radio.modelled);
  EXPECT_EQ(radio.seed, 9U);
  EXPECT_EQ(radio.downlink.loss_rate, 0.25);
  EXPECT_EQ(radio.downlink.range_m, 300.0);
  EXPECT_EQ(radio.downlink.burst_rate, 0.0);
  EXPECT_EQ(radio.downlink.latency.min_ms, 0.0);
  EXPECT_EQ(radio.uplink.loss_rate, 0.0);
  EXPECT_TRUE(std::isinf(radio.uplink.range_m));
}

TEST(Radio, PresetsHoldWhatTheirSourcesSay) {
  // v2x: mode 4 U(4, 100) ms; SNS 0.4 ... 2.4 ms and 509.4 m; 4G edge 15/30 ms; 5G edge 5/12 ms.
  const LinkModel mode4 = radio_of("radio { preset: PC5_MODE4 }").uplink;
  EXPECT_EQ(mode4.latency.law, LatencyModel::Law::kUniform);
  EXPECT_EQ(mode4.latency.min_ms, 4.0);
  EXPECT_EQ(mode4.latency.max_ms, 100.0);
  EXPECT_TRUE(mode4.latency.per_reservation);
  EXPECT_TRUE(mode4.half_duplex);
  EXPECT_TRUE(mode4.collisions);
  EXPECT_EQ(mode4.path_loss.law, PathLossModel::Law::kTr37885);
  const LoadModel load = radio_of("radio { preset: PC5_MODE4 }").load;
  EXPECT_TRUE(load.counted);
  EXPECT_EQ(load.sub_channels, 4U);
  EXPECT_EQ(load.bytes_per_sub_channel, 190U);
  EXPECT_EQ(load.path_loss, mode4.path_loss);
  const LinkModel mode2 = radio_of("radio { preset: NR_V2X }").downlink;
  EXPECT_EQ(mode2.latency.min_ms, 2.0);
  EXPECT_EQ(mode2.latency.max_ms, 20.0);
  EXPECT_TRUE(mode2.collisions);
  const LinkModel sns = radio_of("radio { preset: DSRC_SNS }").downlink;
  EXPECT_EQ(sns.latency.min_ms, 0.4);
  EXPECT_EQ(sns.latency.max_ms, 2.4);
  EXPECT_EQ(sns.range_m, 509.4);
  const LinkModel lte = radio_of("radio { preset: UU_4G_EDGE }").downlink;
  EXPECT_EQ(lte.latency.law, LatencyModel::Law::kGamma);
  EXPECT_EQ(lte.latency.min_ms, 15.0);
  EXPECT_EQ(lte.latency.mean_ms, 30.0);
  const LinkModel nr = radio_of("radio { preset: UU_5G_EDGE }").uplink;
  EXPECT_EQ(nr.latency.min_ms, 5.0);
  EXPECT_EQ(nr.latency.mean_ms, 12.0);
  const RadioParameters harsh = radio_of("radio { preset: HARSH }");
  for (const LinkModel& link : {harsh.uplink, harsh.downlink}) {
    EXPECT_EQ(link.latency.min_ms, 50.0);
    EXPECT_EQ(link.latency.mean_ms, 150.0);
    EXPECT_EQ(link.burst_rate, 0.2);
    EXPECT_EQ(link.burst_mean_length, 8.0);
    EXPECT_EQ(link.loss_rate, 0.0);
    EXPECT_EQ(link.duplicate_rate, 0.01);
  }
}

TEST(Radio, PutsTheFileBeforeThePresetAndTheSetsBeforeTheFile) {
  const std::string file = "radio { preset: PC5_MODE4 downlink { loss { rate: 0.1 } duplicate_rate: 0.5 } }";
  const RadioParameters radio = radio_of(file, {"radio.downlink.loss.rate=0.3", "radio.preset=HARSH"});
  EXPECT_EQ(radio.downlink.loss_rate, 0.3);
  EXPECT_EQ(radio.downlink.duplicate_rate, 0.5);
  EXPECT_EQ(radio.downlink.burst_rate, 0.2);
  EXPECT_EQ(radio.uplink.duplicate_rate, 0.01);
  EXPECT_EQ(radio.uplink.latency.mean_ms, 150.0);
}

TEST(Radio, LetsALatencyOfAnotherFormReplaceThePresets) {
  const RadioParameters radio = radio_of(
      "radio { preset: HARSH }", {"radio.uplink.latency.constant_ms=20", "radio.downlink.latency.gamma.mean_ms=90"});
  EXPECT_EQ(radio.uplink.latency.law, LatencyModel::Law::kConstant);
  EXPECT_EQ(radio.uplink.latency.min_ms, 20.0);
  EXPECT_EQ(radio.uplink.burst_rate, 0.2);
  EXPECT_EQ(radio.downlink.latency.law, LatencyModel::Law::kGamma);
  EXPECT_EQ(radio.downlink.latency.min_ms, 50.0);  // of the preset
  EXPECT_EQ(radio.downlink.latency.mean_ms, 90.0);
}

TEST(Radio, TakesCarToCarFromThePresetWhereTheScenarioSpeaksOfIt) {
  EXPECT_FALSE(radio_of("radio { preset: PC5_MODE4 }").vehicle_to_vehicle.has_value());
  const RadioParameters radio =
      radio_of("radio { preset: PC5_MODE4 vehicle_to_vehicle { path_loss { law: WINNER_B1 antenna_height_m: 0.5 } } }");
  ASSERT_TRUE(radio.vehicle_to_vehicle.has_value());
  EXPECT_TRUE(radio.vehicle_to_vehicle->half_duplex);
  EXPECT_EQ(radio.vehicle_to_vehicle->path_loss.law, PathLossModel::Law::kWinnerB1);
  EXPECT_EQ(radio.load.path_loss.antenna_height_m, 0.5);  // the load is what cars hear of each other
  EXPECT_EQ(radio.awareness_m, 150.0);
  EXPECT_EQ(radio_of("radio { vehicle_to_vehicle {} awareness_m: 80 }").awareness_m, 80.0);
  EXPECT_TRUE(radio_of("radio { vehicle_to_vehicle {} }").modelled);
}

TEST(Radio, TakesOutagesInSteps) {
  const RadioParameters radio = radio_of(
      "radio { outages { from_s: 10.3 to_s: 20 approach: SOUTH direction: UPLINK rsu: 0 } "
      "outages { from_s: 0 to_s: 1 area { x_min_m: -5 } } }");
  EXPECT_TRUE(radio.modelled);
  ASSERT_EQ(radio.outages.size(), 2U);
  EXPECT_EQ(radio.outages[0].from, 103);
  EXPECT_EQ(radio.outages[0].to, 200);
  EXPECT_EQ(radio.outages[0].arm, Arm::kSouth);
  EXPECT_EQ(radio.outages[0].rsu, 0U);
  EXPECT_TRUE(radio.outages[0].uplink);
  EXPECT_FALSE(radio.outages[0].downlink);
  EXPECT_FALSE(radio.outages[0].area.has_value());
  EXPECT_TRUE(radio.outages[1].uplink && radio.outages[1].downlink);
  EXPECT_FALSE(radio.outages[1].arm || radio.outages[1].rsu);
  ASSERT_TRUE(radio.outages[1].area.has_value());
  EXPECT_EQ(radio.outages[1].area->x_min_m, -5.0);
  EXPECT_EQ(radio.outages[1].area->y_max_m, 10'000.0);
}

TEST(Radio, ReadsItsOwnCanonicalTextBackToTheSameText) {
  for (const char* preset : {"IDEAL", "PC5_MODE4", "DSRC_SNS", "UU_4G_EDGE", "UU_5G_EDGE", "HARSH", "NR_V2X"}) {
    const auto first = loaded(std::string("radio { preset: ") + preset + " }", {"radio.uplink.latency.constant_ms=3"});
    ASSERT_TRUE(first.ok()) << first.error().text();
    const std::string canonical = text(first.value());
    const auto second = loaded(canonical);
    ASSERT_TRUE(second.ok()) << second.error().text();
    EXPECT_EQ(text(second.value()), canonical);
  }
}

struct BadRadio {
  const char* text;
  const char* error;
};

constexpr BadRadio kBadRadios[] = {
    {"radio {\n  downlink { loss { rate: 1.5 } }\n}",
     "my.textproto:2:21: radio.downlink.loss.rate is 1.5, must be within [0, 1]"},
    {"radio { uplink { loss { burst { rate: 0.2 mean_length: 0.5 } } } }",
     "my.textproto:1:43: radio.uplink.loss.burst.mean_length is 0.5 steps, must be within [1, 1000] steps"},
    {"radio { uplink { loss { burst { rate: 0.75 mean_length: 2 } } } }",
     "my.textproto:1:44: radio.uplink.loss.burst.mean_length is 2 steps, must be at least 1 / (1 - rate), 4 steps: "
     "the "
     "length that independent losses have"},
    {"radio { uplink { loss { burst { rate: 0.2 } } } }",
     "my.textproto:1:25: radio.uplink.loss.burst.mean_length is missing; it takes a number within [1, 1000] steps"},
    {"radio { uplink { latency { gamma { min_ms: 50 mean_ms: 40 } } } }",
     "my.textproto:1:47: radio.uplink.latency.gamma.mean_ms is 40 ms, must be within [min_ms, 5000] ms, [50, 5000] ms"},
    {"radio { uplink { latency { uniform { min_ms: 50 max_ms: 40 } } } }",
     "my.textproto:1:49: radio.uplink.latency.uniform.max_ms is 40 ms, must be within [min_ms, 5000] ms, [50, 5000] "
     "ms"},
    {"radio { uplink { latency { constant_ms: 3 gamma { min_ms: 1 mean_ms: 2 } } } }",
     "my.textproto:1:43: radio.uplink.latency has constant_ms and gamma; give one of them alone"},
    {"radio { uplink { range_m: 0 } }", "my.textproto:1:18: radio.uplink.range_m is 0 m, must be within [1, 100000] m"},
    {"radio { downlink { duplicate_rate: -1 } }",
     "my.textproto:1:20: radio.downlink.duplicate_rate is -1, must be within [0, 1]"},
    {"radio { uplink { collisions: true } }",
     "my.textproto:1:18: radio.uplink.collisions is true, but nothing counts the load: give radio.load={}"},
    {"radio { load { sub_channels: 4 } }",
     "my.textproto:1:9: radio.load counts what stations hear of each other: give vehicle_to_vehicle or uplink a "
     "path_loss"},
    {"radio { reservation { keep_probability: 0.9 } }",
     "my.textproto:1:23: radio.reservation.keep_probability is 0.9, must be within [0, 0.8]"},
    {"radio { uplink { path_loss { law: TR_36885 } } }",
     "my.textproto:1:35: `TR_36885` is no value of law: radio.uplink.path_loss.law takes TR_37885, WINNER_B1"},
    {"radio { outages { from_s: 5 to_s: 5 } }",
     "my.textproto:1:29: radio.outages[0].to_s is 5 s, must be after from_s, 5 s"},
    {"radio { outages { to_s: 5 } }",
     "my.textproto:1:9: radio.outages[0].from_s is missing; it takes a number within [0, 1000000] s"},
    {"radio { outages { from_s: 1 to_s: 5 rsu: 1 } }",
     "my.textproto:1:37: radio.outages[0].rsu is 1, must be below 1, the number of RSUs"},
    {"radio { outages { from_s: 1 to_s: 5.05 } }",
     "my.textproto:1:29: radio.outages[0].to_s is 5.05 s, must be a multiple of 0.1 s, the length of a step"},
    {"radio { outages { from_s: 1 to_s: 5 area { x_min_m: 3 x_max_m: 2 } } }",
     "my.textproto:1:55: radio.outages[0].area.x_max_m is 2 m, must not be below x_min_m, 3 m"},
    {"radio {\n  preset: HARSHER\n  # nothing more\n}\n",
     "my.textproto:2:11: `HARSHER` is no value of preset: signals.preset takes PAPER, PAPER_YELLOW, PROTECTED_LEFT; "
     "radio.preset takes IDEAL, PC5_MODE4, DSRC_SNS, UU_4G_EDGE, UU_5G_EDGE, HARSH, NR_V2X"},
    {"radio { preset: HARSHER }",
     "my.textproto:1:17: `HARSHER` is no value of preset: signals.preset takes PAPER, PAPER_YELLOW, PROTECTED_LEFT; "
     "radio.preset takes IDEAL, PC5_MODE4, DSRC_SNS, UU_4G_EDGE, UU_5G_EDGE, HARSH, NR_V2X"},
};

TEST(Radio, SaysWhereItIsWrongAndWhatWouldBeRight) {
  for (const BadRadio& bad : kBadRadios) EXPECT_EQ(error_of(bad.text), bad.error) << bad.text;
}

TEST(Radio, RefusesASecondFormOfLatencyInASetting) {
  EXPECT_EQ(error_of("radio { uplink { latency { constant_ms: 3 } } }", {"radio.uplink.latency.gamma.mean_ms=9"}),
            "--set radio.uplink.latency.gamma.mean_ms=9 (1st --set): radio.uplink.latency already has constant_ms; a "
            "latency is one of constant_ms, uniform and gamma (to replace it: radio.uplink.latency={...})");
  const RadioParameters radio = radio_of("radio { uplink { latency { constant_ms: 3 } } }",
                                         {"radio.uplink.latency={gamma {min_ms: 5 mean_ms: 9}}"});
  EXPECT_EQ(radio.uplink.latency.law, LatencyModel::Law::kGamma);
}

TEST(Radio, ChangesWhileARunGoesOnButNotItsPreset) {
  auto scenario = loaded("");
  ASSERT_TRUE(scenario.ok());
  Resolved live = std::move(scenario).value();
  ASSERT_TRUE(change(live, "radio.downlink.loss.rate=0.3").ok());
  EXPECT_EQ(radio_parameters(live.message()).downlink.loss_rate, 0.3);
  ASSERT_TRUE(change(live, "radio.downlink.loss.burst={rate: 0.1 mean_length: 5}").ok());
  ASSERT_TRUE(change(live, "radio.uplink.latency.constant_ms=200").ok());
  ASSERT_TRUE(change(live, "radio.uplink.latency={uniform {min_ms: 1 max_ms: 2}}").ok());
  EXPECT_EQ(radio_parameters(live.message()).uplink.latency.law, LatencyModel::Law::kUniform);
  ASSERT_TRUE(change(live, "radio.uplink.path_loss={power_dbm: 10}").ok());
  ASSERT_TRUE(change(live, "radio.load={}").ok());
  ASSERT_TRUE(change(live, "radio.uplink.collisions=true").ok());
  ASSERT_TRUE(change(live, "radio.outages[0]={from_s: 20 to_s: 30}").ok());
  ASSERT_TRUE(change(live, "radio.outages[1]={from_s: 40 to_s: 50 direction: UPLINK}").ok());
  const RadioParameters changed = radio_parameters(live.message());
  EXPECT_EQ(changed.load.path_loss.power_dbm, 10.0);
  EXPECT_TRUE(changed.uplink.collisions);
  EXPECT_EQ(changed.outages.size(), 2U);
  EXPECT_FALSE(change(live, "radio.outages[2]={from_s: 20 to_s: 10}").ok());
  EXPECT_FALSE(change(live, "radio.preset=HARSH").ok());
  EXPECT_FALSE(change(live, "radio.uplink.loss.rate=2").ok());
}

}  // namespace
}  // namespace lukou::scenario
