#include "common/scenario/scenario_steps.hpp"

#include <gtest/gtest.h>

#include "common/core/directive.hpp"

namespace lukou::scenario {
namespace {

Resolved loaded(const std::string& text) {
  auto scenario = load_text(text, "t.textproto", "/nowhere");
  EXPECT_TRUE(scenario.ok()) << scenario.error().text();
  return std::move(scenario).value();
}

TEST(Protocol, HasTheSchemasDefaults) {
  const Protocol protocol = lukou::scenario::protocol(loaded(""));
  EXPECT_EQ(protocol.seed, 1U);
  EXPECT_EQ(protocol.end, 72000) << "7200 s";
  EXPECT_EQ(protocol.signal_promise, 10);
  EXPECT_EQ(protocol.rsus, 1U);
  EXPECT_EQ(protocol.on_rsu_loss, "ABORT");
}

TEST(Protocol, IsTheScenariosInSteps) {
  const Resolved scenario = loaded(
      "run { seed: 18446744073709551615 duration_s: 0.3 warmup_s: 0 signal_promise_steps: 7 on_rsu_loss: WAIT }\n"
      "rsus { } rsus { }");
  const Protocol protocol = lukou::scenario::protocol(scenario);
  EXPECT_EQ(protocol.seed, 18446744073709551615U);
  EXPECT_EQ(protocol.end, 3) << "0.3 s is step 3, though 0.3 / 0.1 is not 3";
  EXPECT_EQ(protocol.signal_promise, 7);
  EXPECT_EQ(protocol.rsus, 2U);
  EXPECT_EQ(protocol.on_rsu_loss, "WAIT");
  EXPECT_EQ(signal_promise(scenario), 7);
  EXPECT_EQ(lukou::scenario::protocol(loaded("run { on_rsu_loss: CONTINUE }")).on_rsu_loss, "CONTINUE");
}

TEST(ApplyDirectives, ChangesTheScenarioInTheirOrder) {
  Resolved scenario = loaded("");
  EXPECT_FALSE(lukou::scenario::apply(scenario, std::vector<Directive>{}));
  EXPECT_TRUE(lukou::scenario::apply(
      scenario, std::vector<Directive>{{1, "vehicles.equipped_ratio=0.1"}, {1, "vehicles.equipped_ratio=0.4"}}));
  EXPECT_EQ(text(scenario), text(loaded("vehicles { equipped_ratio: 0.4 }")));
}

TEST(ApplyDirectivesDeathTest, TakesAChangeThatTheClockWouldRefuseForABug) {
  Resolved scenario = loaded("");
  EXPECT_DEATH(lukou::scenario::apply(scenario, std::vector<Directive>{{1, "run.seed=2"}}), "does not hold");
}

}  // namespace
}  // namespace lukou::scenario
