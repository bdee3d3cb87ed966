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

TEST(Radio, ReadsItsOwnCanonicalTextBackToTheSameText) {
  for (const char* preset : {"IDEAL", "PC5_MODE4", "DSRC_SNS", "UU_4G_EDGE", "UU_5G_EDGE", "HARSH"}) {
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
     "my.textproto:1:43: radio.uplink.loss.burst.mean_length is 0.5 frames, must be within [1, 1000] frames"},
    {"radio { uplink { loss { burst { rate: 0.75 mean_length: 2 } } } }",
     "my.textproto:1:44: radio.uplink.loss.burst.mean_length is 2 frames, must be at least 1 / (1 - rate), 4 frames: "
     "the "
     "length that independent losses have"},
    {"radio { uplink { loss { burst { rate: 0.2 } } } }",
     "my.textproto:1:25: radio.uplink.loss.burst.mean_length is missing; it takes a number within [1, 1000] frames"},
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
    {"radio { preset: HARSHER }",
     "my.textproto:1:17: `HARSHER` is no value of preset: signals.preset takes PAPER, PAPER_YELLOW, PROTECTED_LEFT; "
     "radio.preset takes IDEAL, PC5_MODE4, DSRC_SNS, UU_4G_EDGE, UU_5G_EDGE, HARSH"},
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
  EXPECT_FALSE(change(live, "radio.preset=HARSH").ok());
  EXPECT_FALSE(change(live, "radio.uplink.loss.rate=2").ok());
}

}  // namespace
}  // namespace lukou::scenario
