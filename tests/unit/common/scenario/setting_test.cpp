#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "common/scenario/scenario.hpp"
#include "scenario.pb.h"

namespace lukou::scenario {
namespace {

Expected<Resolved> loaded(const std::string& text, const std::vector<std::string>& sets) {
  return load_text(text, "my.textproto", "/nowhere", sets);
}

struct BadSet {
  const char* set;
  const char* error;  // after "--set ... (1st --set): "
};

constexpr BadSet kBadSets[] = {
    {"traffic.west.flow_veh_per_h=abc", "`abc` is no value of traffic.west.flow_veh_per_h; expected a number [veh/h]"},
    {"traffic.west.flow_veh_per_h=1 2", "`1 2` is no value of traffic.west.flow_veh_per_h; expected a number [veh/h]"},
    {"traffic.west.flow_veh_per_h=", "`` is no value of traffic.west.flow_veh_per_h; expected a number [veh/h]"},
    {"traffic.west.flow_veh_per_h=20000",
     "traffic.west.flow_veh_per_h is 20000 veh/h, must be within [0, 10800] veh/h"},
    {"trafic.west.flow_veh_per_h=1", "a scenario has no field `trafic`; did you mean `traffic`?"},
    {"traffic.west.flow=1",
     "traffic.west has no field `flow`; it has flow_veh_per_h, flow_series, arrivals_csv, shares"},
    {"rsus.algorithm=x", "rsus is a list; name one of its entries, rsus[0]"},
    {"rsus[2].algorithm=x", "rsus has 1 entry; the next one is rsus[1]"},
    {"rsus[-1].algorithm=x", "`rsus[-1].algorithm` is no path; write it as in a.b[0].c"},
    {"run..seed=1", "`run..seed` is no path; write it as in a.b[0].c"},
    {"=1", "`` is no path; write it as in a.b[0].c"},
    {"run[0].seed=1", "run is no list; leave the index out"},
    {"run.seed.x=1", "run.seed is a value; it has no field `x`"},
    {"run.seed", "has no `=`; write path=value"},
    {"traffic.west=5", "`5` is no value of traffic.west: expected \"{\", found \"5\"; expected {field: value ...}"},
    {"signals.preset=LEFT",
     "`LEFT` is no value of signals.preset; expected one of PAPER, PAPER_YELLOW, PROTECTED_LEFT"},
    {"signals.allow_conflicts=perhaps", "`perhaps` is no value of signals.allow_conflicts; expected true or false"},
    {"traffic.west.flow_series[0]={from_s: 0}",
     "traffic.west.flow_series[0].flow_veh_per_h is missing; it takes a number within [0, 10800] veh/h"},
};

TEST(Setting, NamesTheSetThatIsWrongAndWhatWouldBeRight) {
  for (const BadSet& bad : kBadSets) {
    const auto result = loaded("", {bad.set});
    ASSERT_FALSE(result.ok()) << bad.set;
    EXPECT_EQ(result.error().text(), std::string("--set ") + bad.set + " (1st --set): " + bad.error);
  }
}

TEST(Setting, OverridesTheFileAndTheLaterOneWins) {
  const auto result = loaded("run { seed: 1 }", {"run.seed=2", "run.seed=3"});
  ASSERT_TRUE(result.ok());
  EXPECT_EQ(result.value().message().run().seed(), 3U);
}

TEST(Setting, ReachesFieldsOfEveryKind) {
  const auto result =
      loaded("", {"run.on_overflow=CONTINUE", "run.on_rsu_loss=\"WAIT\"", "signals.allow_conflicts=true",
                  "run.signal_promise_steps=20", "rsus[0].algorithm=mine", "rsus[1].algorithm='other one'",
                  "traffic.west.shares={left: 0}", "traffic.east.flow_veh_per_h=1e3"});
  ASSERT_TRUE(result.ok()) << result.error().text();
  const Scenario& scenario = result.value().message();
  EXPECT_EQ(scenario.run().on_overflow(), Overflow::CONTINUE);
  EXPECT_EQ(scenario.run().on_rsu_loss(), RsuLoss::WAIT);
  EXPECT_TRUE(scenario.signals().allow_conflicts());
  EXPECT_EQ(scenario.run().signal_promise_steps(), 20U);
  ASSERT_EQ(scenario.rsus_size(), 2);
  EXPECT_EQ(scenario.rsus(0).algorithm(), "mine");
  EXPECT_EQ(scenario.rsus(1).algorithm(), "other one");
  EXPECT_EQ(scenario.rsus(1).arrive_on_green().headway_s(), 1.98);
  EXPECT_EQ(scenario.traffic().west().shares().left(), 0.0);
  EXPECT_EQ(scenario.traffic().west().shares().center(), 1.0);
  EXPECT_EQ(scenario.traffic().east().flow_veh_per_h(), 1000.0);
}

TEST(Setting, ReplacesAnEntryOfAListInItsPlace) {
  const auto result = loaded(
      "traffic { west { flow_series { from_s: 0 flow_veh_per_h: 100 } flow_series { from_s: 60 flow_veh_per_h: 200 } } "
      "}",
      {"traffic.west.flow_series[0]={from_s: 10 flow_veh_per_h: 300}", "traffic.west.flow_series[1].flow_veh_per_h=400",
       "traffic.west.flow_series[2]={from_s: 90 flow_veh_per_h: 500}"});
  ASSERT_TRUE(result.ok()) << result.error().text();
  const Demand& west = result.value().message().traffic().west();
  ASSERT_EQ(west.flow_series_size(), 3);
  EXPECT_EQ(west.flow_series(0).from_s(), 10.0);
  EXPECT_EQ(west.flow_series(0).flow_veh_per_h(), 300.0);
  EXPECT_EQ(west.flow_series(1).from_s(), 60.0);
  EXPECT_EQ(west.flow_series(1).flow_veh_per_h(), 400.0);
  EXPECT_EQ(west.flow_series(2).flow_veh_per_h(), 500.0);
}

TEST(Setting, RefusesASecondArmOfADemand) {
  const auto result = loaded("traffic { west { flow_veh_per_h: 3 } }", {"traffic.west.flow_series[0].from_s=0"});
  ASSERT_FALSE(result.ok());
  EXPECT_EQ(result.error().text(),
            "--set traffic.west.flow_series[0].from_s=0 (1st --set): traffic.west already has flow_veh_per_h; a demand "
            "is one of flow_veh_per_h, flow_series and arrivals_csv (to replace it: traffic.west={...})");
}

TEST(Setting, MayChooseASeriesWhereOnlyTheDefaultFlowStood) {
  const auto result = loaded("", {"traffic.west.flow_series[0]={from_s: 0 flow_veh_per_h: 900}"});
  ASSERT_TRUE(result.ok()) << result.error().text();
  EXPECT_FALSE(result.value().message().traffic().west().has_flow_veh_per_h());
}

TEST(Setting, OfAPresetReplacesTheFilesPlan) {
  const auto result = loaded("signals { plan { cycle_s: 10 } }", {"signals.preset=PAPER_YELLOW"});
  ASSERT_TRUE(result.ok()) << result.error().text();
  EXPECT_FALSE(result.value().message().signals().has_plan());
  EXPECT_EQ(result.value().message().signals().preset(), PAPER_YELLOW);
}

TEST(Setting, ThatMendsTheFileIsNotBlamed) {
  const auto result = loaded("vehicles { equipped_ratio: 7 }", {"vehicles.equipped_ratio=0.7"});
  EXPECT_TRUE(result.ok());
}

}  // namespace
}  // namespace lukou::scenario
