#include "services/lukou/study/plan.hpp"

#include <gtest/gtest.h>

namespace lukou::studies {
namespace {

Level level(const std::string& path, double number, const std::string& text) {
  return {text, number, {{path + "=" + text, "label"}}};
}

/// Two arms over latency x ratio; "off" does not care for the latency.
Study study() {
  Study study;
  study.name = "test";
  study.base_text = "run { duration_s: 10 }";
  study.base_origin = "base";
  study.sets = {{"run.warmup_s=0", "label"}};
  study.arms = {{"on", {}, {}}, {"off", {{"rsus[0].algorithm=none", "label"}}, {"latency"}}};
  study.baseline = 1;
  study.grids = {
      {"grid",
       {{"latency",
         "ms",
         {level("radio.downlink.latency.constant_ms", 100, "100"),
          level("radio.downlink.latency.constant_ms", 200, "200"),
          level("radio.downlink.latency.constant_ms", 300, "300")}},
        {"ratio", "", {level("vehicles.equipped_ratio", 0.3, "0.3"), level("vehicles.equipped_ratio", 0.7, "0.7")}}}}};
  study.seeds = 2;
  study.measures = {"mean_delay_s"};
  return study;
}

TEST(Plan, CrossesTheFactorsOfAGridTheLastOneFastest) {
  const Plan plan = plan_of(study());
  ASSERT_EQ(plan.cells.size(), 6U);
  EXPECT_EQ(plan.cells[0].levels, (std::vector<std::size_t>{0, 0}));
  EXPECT_EQ(plan.cells[1].levels, (std::vector<std::size_t>{0, 1}));
  EXPECT_EQ(plan.cells[5].levels, (std::vector<std::size_t>{2, 1}));
}

TEST(Plan, SharesThePointsOfAnArmThatIgnoresAFactor) {
  const Plan plan = plan_of(study());
  EXPECT_EQ(plan.points.size(), 6U + 2U);
  EXPECT_EQ(plan.cells[0].points[1], plan.cells[2].points[1]);
  EXPECT_NE(plan.cells[0].points[1], plan.cells[1].points[1]);
  ASSERT_EQ(plan.points[plan.cells[0].points[1]].coordinates.size(), 1U);
  EXPECT_EQ(plan.points[plan.cells[0].points[1]].coordinates[0].factor, "ratio");
}

TEST(Plan, PutsGridsBesideEachOther) {
  Study two = study();
  two.grids.push_back({"other", {{"seconds", "s", {level("run.duration_s", 20, "20")}}}});
  two.arms[1].ignores.push_back("ratio");
  const Plan plan = plan_of(two);
  EXPECT_EQ(plan.cells.size(), 6U + 1U);
  EXPECT_EQ(plan.cells.back().grid, 1U);
}

TEST(Plan, RunsEveryPointWithASeedBeforeTheNextSeed) {
  const Study two = study();
  const Plan plan = plan_of(two);
  const auto runs = runs_of(two, plan, 2);
  ASSERT_EQ(runs.size(), 16U);
  EXPECT_EQ(runs[7].seed, 1U);
  EXPECT_EQ(runs[8].seed, 2U);
  EXPECT_EQ(id_of(plan, runs[9]), "p001-s2");
}

TEST(ScenarioOf, SetsTheStudyThenTheCellThenTheArmThenTheSeed) {
  const Study two = study();
  const Plan plan = plan_of(two);
  const auto on = scenario_of(two, plan.points[plan.cells[2].points[0]], 7);
  ASSERT_TRUE(on) << on.error().text();
  const std::string text = scenario::text(on.value());
  EXPECT_NE(text.find("seed: 7"), std::string::npos);
  EXPECT_NE(text.find("constant_ms: 200"), std::string::npos);
  EXPECT_NE(text.find("equipped_ratio: 0.3"), std::string::npos);
  EXPECT_NE(text.find("duration_s: 10"), std::string::npos);
  const auto off = scenario_of(two, plan.points[plan.cells[2].points[1]], 7);
  ASSERT_TRUE(off);
  EXPECT_EQ(scenario::text(off.value()).find("constant_ms"), std::string::npos);
  EXPECT_NE(scenario::text(off.value()).find("algorithm: \"none\""), std::string::npos);
}

TEST(Text, NamesCellsAndPointsByTheirFactors) {
  const Study two = study();
  const Plan plan = plan_of(two);
  EXPECT_EQ(text(two, plan.cells[1]), "latency 100 ms, ratio 0.7");
  EXPECT_EQ(text(two, plan.points[plan.cells[1].points[1]]), "off at ratio 0.7");
}

}  // namespace
}  // namespace lukou::studies
