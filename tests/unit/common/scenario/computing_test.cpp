#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "common/scenario/scenario.hpp"
#include "common/scenario/scenario_steps.hpp"
#include "scenario.pb.h"

namespace lukou::scenario {
namespace {

Expected<Resolved> with(const std::vector<std::string>& sets) { return load_text("", "test.textproto", "", sets); }

TEST(Computing, IsFreeAndNotWrittenUnlessTheScenarioSpeaksOfIt) {
  const auto scenario = with({});
  ASSERT_TRUE(scenario) << scenario.error().text();
  EXPECT_FALSE(protocol(scenario.value()).measures_time());
  EXPECT_EQ(text(scenario.value()).find("computing"), std::string::npos);
}

TEST(Computing, IsDeclaredOrMeasuredForEachRsuByItself) {
  const auto scenario = with({"rsus[0].computing={mode: DECLARED declared_ms: 20}", "rsus[1].computing.mode=REAL"});
  ASSERT_TRUE(scenario) << scenario.error().text();
  EXPECT_EQ(scenario.value().message().rsus(0).computing().declared_ms(), 20U);
  EXPECT_EQ(protocol(scenario.value()).rsu_measured, (std::vector<bool>{false, true}));
  EXPECT_TRUE(protocol(scenario.value()).measures_time());
}

TEST(Computing, IsRefusedIfModeAndTimeDoNotFit) {
  const auto missing = with({"rsus[0].computing.mode=DECLARED"});
  ASSERT_FALSE(missing);
  EXPECT_NE(missing.error().text().find("declared_ms is missing; it takes a number within [1, 5000] ms"),
            std::string::npos)
      << missing.error().text();
  const auto idle = with({"rsus[0].computing={mode: REAL declared_ms: 20}"});
  ASSERT_FALSE(idle);
  EXPECT_NE(idle.error().text().find("is read with mode: DECLARED alone"), std::string::npos) << idle.error().text();
  EXPECT_FALSE(with({"rsus[0].computing={mode: DECLARED declared_ms: 0}"}));
  const auto lights = with({"rsus[0].computing.mode=REAL", "signals.actuation={}"});
  ASSERT_FALSE(lights);
  EXPECT_NE(lights.error().text().find("must be FREE or DECLARED in a run with signals.actuation"), std::string::npos);
  EXPECT_FALSE(with({"rsus[0].computing={mode: DECLARED declared_ms: 5001}"}));
}

}  // namespace
}  // namespace lukou::scenario
