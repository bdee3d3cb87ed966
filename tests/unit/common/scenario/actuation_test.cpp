#include "common/scenario/actuation.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "common/scenario/scenario.hpp"
#include "scenario.pb.h"

namespace lukou::scenario {
namespace {

Expected<Resolved> with(const std::vector<std::string>& sets) { return load_text("", "empty", "/nowhere", sets); }

std::string refused(const std::vector<std::string>& sets) {
  const auto loaded = with(sets);
  return loaded ? "" : loaded.error().text();
}

TEST(ActuationOfAScenario, IsAbsentUnlessOneOfItsFieldsIsGiven) {
  EXPECT_FALSE(actuation(with({}).value().message()));
  EXPECT_EQ(text(with({}).value()).find("actuation {"), std::string::npos);
  const auto one = with({"signals.actuation.min_green_s=8"});
  ASSERT_TRUE(one.ok()) << one.error().text();
  EXPECT_EQ(actuation(one.value().message()),
            (lukou::Actuation{.min_green = 80, .yellow = 30, .all_red = 10, .max_wait = 1200}));
  EXPECT_TRUE(with({"signals.actuation={}"}).ok());
}

TEST(ActuationOfAScenario, TakesWholeSteps) {
  EXPECT_EQ(actuation(with({"signals.actuation.yellow_s=3.3"}).value().message())->yellow, 33);
  EXPECT_NE(refused({"signals.actuation.yellow_s=3.33"}).find("must be a multiple of 0.1 s"), std::string::npos);
}

TEST(ActuationOfAScenario, NamesTheRangeOfABadValue) {
  EXPECT_NE(refused({"signals.actuation.yellow_s=0.5"}).find("must be within [1, 10] s"), std::string::npos);
  EXPECT_NE(
      refused({"signals.actuation.min_green_s=30", "signals.actuation.max_wait_s=20"})
          .find("signals.actuation.max_wait_s is 20 s, must be at least min_green_s + yellow_s + all_red_s, 34 s"),
      std::string::npos);
}

TEST(ActuationOfAScenario, KeepsCrossingStreamsApart) {
  EXPECT_NE(refused({"signals.actuation={}", "signals.allow_conflicts=true"})
                .find("take it away, or signals.allow_conflicts"),
            std::string::npos);
}

TEST(ActuationOfAScenario, NeedsARunThatEndsWithItsRsus) {
  for (const char* policy : {"CONTINUE", "WAIT"}) {
    const std::string why = refused({"signals.actuation={}", std::string("run.on_rsu_loss=") + policy});
    EXPECT_NE(why.find("run.on_rsu_loss is " + std::string(policy) + ", must be ABORT"), std::string::npos) << why;
  }
}

TEST(ActuationOfAScenario, DoesNotChangeWhileARunGoesOn) {
  auto scenario = with({"signals.actuation={}"});
  ASSERT_TRUE(scenario.ok());
  EXPECT_FALSE(change(scenario.value(), "signals.actuation.min_green_s=9").ok());
  EXPECT_TRUE(change(scenario.value(), "signals.preset=PROTECTED_LEFT").ok());
}

TEST(ActuationOfAScenario, WarnsOfAPlanThatIsRedForLongerThanTheMaximumWait) {
  const auto found = [](const std::vector<std::string>& sets) {
    for (const std::string& warning : warnings(with(sets).value())) {
      if (warning.find("longer than the maximum wait") != std::string::npos) return true;
    }
    return false;
  };
  // PAPER: red for 45 s, and 1 s of all-red.
  EXPECT_FALSE(found({"signals.actuation.max_wait_s=46"}));
  EXPECT_TRUE(found({"signals.actuation.max_wait_s=45.9"}));
  EXPECT_FALSE(found({}));
}

}  // namespace
}  // namespace lukou::scenario
