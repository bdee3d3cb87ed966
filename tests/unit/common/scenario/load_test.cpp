#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "common/scenario/scenario.hpp"
#include "scenario.pb.h"

namespace lukou::scenario {
namespace {

Expected<Resolved> loaded(const std::string& text, const std::vector<std::string>& sets = {}) {
  return load_text(text, "my.textproto", "/nowhere", sets);
}

struct BadFile {
  const char* text;
  const char* error;
};

/// What a user reads for each mistake, to the letter: file, line and column of the field, and what would be right.
constexpr BadFile kBadFiles[] = {
    {"traffic {\n  west { flow_veh_per_h: 20000 }\n}\n",
     "my.textproto:2:10: traffic.west.flow_veh_per_h is 20000 veh/h, must be within [0, 10800] veh/h"},
    {"traffic {\n  west { flow_veh_h: 1800 }\n}\n",
     "my.textproto:2:10: Demand has no field `flow_veh_h`; did you mean `flow_veh_per_h`?"},
    {"weather { }",
     "my.textproto:1:1: Scenario has no field `weather`; it has run, traffic, vehicles, driving, signals, "
     "radio, rsus, record"},
    {"run { duration_s: long }", "my.textproto:1:19: expected a number, got: long"},
    {"run { seed: -1 }", "my.textproto:1:13: expected a whole number, got: -"},
    {"run { duration_s: 10", "my.textproto:1:21: the text ends here, but a `}` is missing"},
    {"run { seed: 1 seed: 2 }", "my.textproto:1:15: `seed` stands here a second time; it may be given once"},
    {"signals { preset: PAPPER }",
     "my.textproto:1:19: `PAPPER` is no value of preset: signals.preset takes PAPER, PAPER_YELLOW, PROTECTED_LEFT; "
     "radio.preset takes IDEAL, PC5_MODE4, DSRC_SNS, UU_4G_EDGE, UU_5G_EDGE, HARSH, NR_V2X"},
    {"signals { preset: 0 }",
     "my.textproto:1:11: signals.preset is SIGNAL_PRESET_UNSPECIFIED, must be one of PAPER, PAPER_YELLOW, "
     "PROTECTED_LEFT"},
    {"signals { preset: 9 }",
     "my.textproto:1:11: signals.preset is 9, must be one of PAPER, PAPER_YELLOW, PROTECTED_LEFT"},
    {"run { warmup_s: nan }", "my.textproto:1:7: run.warmup_s is nan s, must be within [0, 1000000] s"},
    {"run { duration_s: inf }", "my.textproto:1:7: run.duration_s is inf s, must be within [0.1, 1000000] s"},
    {"run { duration_s: 10.05 }",
     "my.textproto:1:7: run.duration_s is 10.05 s, must be a multiple of 0.1 s, the length of a step"},
    {"run { signal_promise_steps: 1 }",
     "my.textproto:1:7: run.signal_promise_steps is 1 steps, must be within [2, 100] steps"},
    {"vehicles { equipped_ratio: -0.1 }", "my.textproto:1:12: vehicles.equipped_ratio is -0.1, must be within [0, 1]"},
    {"rsus { }\nrsus { arrive_on_green { headway_s: 9 } }",
     "my.textproto:2:26: rsus[1].arrive_on_green.headway_s is 9 s, must be within [0.5, 5] s"},
    {"rsus { glosa { speed_min_kmh: 500 } }",
     "my.textproto:1:16: rsus[0].glosa.speed_min_kmh is 500 km/h, must be within [1, 60] km/h"},
    {"driving { desired_speed_min: 0.9 desired_speed_max: 0.8 }",
     "my.textproto:1:11: driving.desired_speed_min is 0.9, must not be above desired_speed_max, 0.8"},
    // Only the upper bound stands in the file: the error points at it.
    {"driving { desired_speed_max: 0.7 }",
     "my.textproto:1:11: driving.desired_speed_min is 0.75, must not be above desired_speed_max, 0.7"},
    {"driving { desired_speed_max: 0.8 }",
     "my.textproto:1:11: driving.desired_speed_mean is 0.9, must be within [desired_speed_min, desired_speed_max], "
     "[0.75, 0.8]"},
    {"driving { desired_speed_min: 0.9 desired_speed_max: 0.9 }",
     "my.textproto:1:11: driving.desired_speed_deviation is 0.05, must not be above 20 times the width of "
     "[desired_speed_min, desired_speed_max]"},
    {"driving { stop_rearm_kmh: 5 }",
     "my.textproto:1:11: driving.stop_rearm_kmh is 5 km/h, must be above stop_speed_kmh, 5 km/h"},
    {"traffic { west { flow_veh_per_h: 3 flow_series { from_s: 0 flow_veh_per_h: 4 } } }",
     "my.textproto:1:36: traffic.west has flow_veh_per_h and flow_series; give one of them alone"},
    {"traffic { west { shares { left: 0 center: 0 right: 0 } } }",
     "my.textproto:1:18: traffic.west.shares are all 0, at least one lane must have a share"},
    {"traffic { west { flow_series { from_s: 5 } } }",
     "my.textproto:1:18: traffic.west.flow_series[0].flow_veh_per_h is missing; it takes a number within [0, 10800] "
     "veh/h"},
    {"traffic {\n west {\n flow_series { from_s: 5 flow_veh_per_h: 1 }\n flow_series { from_s: 5 flow_veh_per_h: 2 "
     "}\n}}",
     "my.textproto:4:16: traffic.west.flow_series[1].from_s is 5 s, must be after the point before it, 5 s"},
    {"traffic { west { arrivals_csv: \"none.csv\" } }",
     "my.textproto:1:18: traffic.west.arrivals_csv: cannot read /nowhere/none.csv: No such file or directory"},
};

TEST(Load, SaysWhereAFileIsWrongAndWhatWouldBeRight) {
  for (const BadFile& bad : kBadFiles) {
    const auto result = loaded(bad.text);
    ASSERT_FALSE(result.ok()) << bad.text;
    EXPECT_EQ(result.error().text(), bad.error) << bad.text;
  }
}

TEST(Load, ReportsEveryMistakeInTheOrderOfTheFile) {
  const auto result =
      loaded("vehicles { equipped_ratio: 2 }\nrun { duration_s: 0 }\n", {"run.seed=x", "run.warmup_s=-1"});
  ASSERT_FALSE(result.ok());
  EXPECT_EQ(result.error().text(),
            "my.textproto:1:12: vehicles.equipped_ratio is 2, must be within [0, 1]\n"
            "my.textproto:2:7: run.duration_s is 0 s, must be within [0.1, 1000000] s\n"
            "--set run.seed=x (1st --set): `x` is no value of run.seed; expected a whole number of at least 0\n"
            "--set run.warmup_s=-1 (2nd --set): run.warmup_s is -1 s, must be within [0, 1000000] s");
}

TEST(Load, ReportsEveryUnknownFieldAtOnce) {
  const auto result = loaded("run { sead: 1 }\ntraffic { sooth { } }");
  ASSERT_FALSE(result.ok());
  EXPECT_EQ(result.error().text(),
            "my.textproto:1:7: Run has no field `sead`; did you mean `seed`?\n"
            "my.textproto:2:11: Traffic has no field `sooth`; did you mean `south`?");
}

TEST(Load, GivesAnEmptyFileThePapersDefaults) {
  const auto result = loaded("");
  ASSERT_TRUE(result.ok());
  const Scenario& scenario = result.value().message();
  EXPECT_EQ(scenario.run().duration_s(), 7200.0);
  EXPECT_EQ(scenario.run().on_overflow(), Overflow::STOP);
  EXPECT_EQ(scenario.traffic().north().flow_veh_per_h(), 1800.0);
  EXPECT_EQ(scenario.traffic().north().shares().left(), 1.0);
  EXPECT_EQ(scenario.signals().preset(), PAPER);
  EXPECT_FALSE(scenario.signals().has_plan());
  ASSERT_EQ(scenario.rsus_size(), 1);
  EXPECT_EQ(scenario.rsus(0).algorithm(), "arrive_on_green");
  EXPECT_EQ(scenario.rsus(0).arrive_on_green().headway_s(), 1.98);
}

TEST(Load, GivesTheChosenAlgorithmItsParametersAndNoOther) {
  const auto result = loaded("rsus { algorithm: \"eco\" eco { headway_s: 3 } platoon { gap_s: 2 } }");
  ASSERT_TRUE(result.ok()) << result.error().text();
  const Rsu& rsu = result.value().message().rsus(0);
  EXPECT_EQ(rsu.eco().headway_s(), 3.0);
  EXPECT_EQ(rsu.eco().speed_min_kmh(), 18.0);
  EXPECT_EQ(rsu.platoon().gap_s(), 2.0) << "what the user gave stays";
  EXPECT_FALSE(rsu.has_glosa());
  const auto glosa = loaded("rsus { algorithm: \"glosa\" }");
  ASSERT_TRUE(glosa.ok());
  EXPECT_EQ(glosa.value().message().rsus(0).glosa().speed_min_kmh(), 18.0);
}

TEST(Load, KeepsWhatIsGivenEvenIfItIsZero) {
  const auto result = loaded("traffic { west { flow_veh_per_h: 0 } } vehicles { equipped_ratio: 0 }");
  ASSERT_TRUE(result.ok());
  EXPECT_EQ(result.value().message().traffic().west().flow_veh_per_h(), 0.0);
  EXPECT_EQ(result.value().message().vehicles().equipped_ratio(), 0.0);
}

TEST(Load, GivesNoDefaultFlowBesideASeries) {
  const auto result = loaded("traffic { west { flow_series { from_s: 60 flow_veh_per_h: 900 } } }");
  ASSERT_TRUE(result.ok());
  EXPECT_FALSE(result.value().message().traffic().west().has_flow_veh_per_h());
  EXPECT_TRUE(result.value().message().traffic().south().has_flow_veh_per_h());
}

TEST(Load, ReadsItsOwnCanonicalTextBackToTheSameText) {
  const auto first =
      loaded("run { duration_s: 0.3 seed: 18446744073709551615 } driving { safe_time_s: 1.0000000000000002 }");
  ASSERT_TRUE(first.ok());
  const std::string canonical = text(first.value());
  EXPECT_NE(canonical.find("seed: 18446744073709551615\n"), std::string::npos);
  EXPECT_NE(canonical.find("safe_time_s: 1.0000000000000002\n"), std::string::npos);
  const auto second = loaded(canonical);
  ASSERT_TRUE(second.ok());
  EXPECT_EQ(text(second.value()), canonical);
  EXPECT_EQ(hash(second.value()), hash(first.value()));
}

TEST(Load, HashesTheMeaningNotTheSpelling) {
  const auto implied = loaded("");
  const auto spelled = loaded("# a comment\nvehicles { equipped_ratio: 7e-1 }");
  const auto other = loaded("run { seed: 2 }");
  ASSERT_TRUE(implied.ok() && spelled.ok() && other.ok());
  EXPECT_EQ(hash(implied.value()), hash(spelled.value()));
  EXPECT_NE(hash(implied.value()), hash(other.value()));
}

TEST(Load, SurvivesTextThatIsNestedWithoutEnd) {
  std::string text = "unknown ";
  for (int i = 0; i < 100000; ++i) text += "{ a ";
  EXPECT_FALSE(loaded(text).ok());
}

TEST(Resolved, IsCopiedByValue) {
  const auto first = loaded("");
  ASSERT_TRUE(first.ok());
  Resolved copy = first.value();
  ASSERT_TRUE(change(copy, "vehicles.equipped_ratio=0.25").ok());
  EXPECT_EQ(copy.message().vehicles().equipped_ratio(), 0.25);
  EXPECT_EQ(first.value().message().vehicles().equipped_ratio(), 0.7);
}

TEST(Load, RefusesSharesOfDriversThatAddUpToMoreThanAll) {
  const auto result =
      load_text("vehicles { compliance { human_share: 0.7 ignoring_share: 0.4 } }", "my.textproto", "/");
  ASSERT_FALSE(result.ok());
  EXPECT_EQ(
      result.error().text(),
      "my.textproto:1:25: vehicles.compliance.human_share is 0.7, must be within [0, 1 - ignoring_share], [0, 0.6]");
  EXPECT_TRUE(load_text("vehicles { compliance { human_share: 0.6 ignoring_share: 0.4 } }", "my.textproto", "/").ok());
}

}  // namespace
}  // namespace lukou::scenario
