#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "common/scenario/scenario.hpp"
#include "scenario.pb.h"

namespace lukou::scenario {
namespace {

Expected<Resolved> loaded(const std::string& text) { return load_text(text, "my.textproto", "/nowhere"); }

/// Two phases of 10 s: west and east, then south and north; starts 5 s late.
constexpr const char* kTwoPhases = R"(signals {
  plan {
    cycle_s: 20
    offset_s: 5
    lane_plans {
      lanes: ["WL", "WC", "WR", "EL", "EC", "ER"]
      aspects { aspect: GREEN duration_s: 8.5 }
      aspects { aspect: YELLOW duration_s: 1.5 }
      aspects { aspect: RED duration_s: 10 }
    }
    lane_plans {
      lanes: ["SL", "SC", "SR", "NL", "NC", "NR"]
      aspects { aspect: RED duration_s: 10 }
      aspects { aspect: GREEN duration_s: 10 }
    }
  }
})";

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

TEST(SignalPlan, OfAPresetIsThePresets) {
  const auto yellow = loaded("signals { preset: PAPER_YELLOW }");
  const auto paper = loaded("");
  const auto left = loaded("signals { preset: PROTECTED_LEFT }");
  ASSERT_TRUE(yellow.ok() && paper.ok() && left.ok());
  EXPECT_EQ(signal_plan(yellow.value()).value(), paper_yellow_plan());
  EXPECT_EQ(signal_plan(paper.value()).value(), paper_plan());
  EXPECT_EQ(signal_plan(left.value()).value(), protected_left_plan());
}

TEST(SignalPlan, OfAUserIsCountedInSteps) {
  const auto scenario = loaded(kTwoPhases);
  ASSERT_TRUE(scenario.ok()) << scenario.error().text();
  const auto plan = signal_plan(scenario.value());
  ASSERT_TRUE(plan.ok());
  EXPECT_EQ(plan.value().cycle, 200);
  EXPECT_EQ(plan.value().offset, 50);
  const auto& west = plan.value().lanes[index(*lane_named("WC"))];
  ASSERT_EQ(west.size(), 3U);
  EXPECT_EQ(west[0], (lukou::TimedAspect{lukou::Aspect::kGreen, 85}));
  EXPECT_EQ(west[1], (lukou::TimedAspect{lukou::Aspect::kYellow, 15}));
  EXPECT_EQ(plan.value().lanes[index(*lane_named("NR"))][1], (lukou::TimedAspect{lukou::Aspect::kGreen, 100}));
}

TEST(SignalPlan, MeansTheSameAfterARoundTrip) {
  const auto scenario = loaded(kTwoPhases);
  ASSERT_TRUE(scenario.ok());
  const auto again = loaded(text(scenario.value()));
  ASSERT_TRUE(again.ok()) << again.error().text();
  EXPECT_FALSE(again.value().message().signals().has_preset());
  EXPECT_EQ(signal_plan(again.value()).value(), signal_plan(scenario.value()).value());
}

struct BadPlan {
  const char* from;
  const char* to;
  const char* error;
};

constexpr BadPlan kBadPlans[] = {
    {"\"WL\", ", "", "my.textproto:2:3: signals.plan leaves out WL; every lane must stand in it once"},
    {"\"SL\"", "\"WL\"",
     "my.textproto:2:3: signals.plan leaves out SL; every lane must stand in it once\n"
     "my.textproto:12:7: signals.plan.lane_plans[1].lanes[0] is WL again; every lane must stand here once"},
    {"\"WL\"", "\"WL\", \"XL\"",
     "my.textproto:6:7: signals.plan.lane_plans[0].lanes[1] is `XL`, must be one of WL WC WR SL SC SR EL EC ER NL NC "
     "NR"},
    {"8.5", "8.4",
     "my.textproto:5:5: signals.plan.lane_plans[0] adds up to 19.9 s, must be signals.plan.cycle_s, 20 s"},
    {"8.5", "8.45",
     "my.textproto:5:5: signals.plan.lane_plans[0] adds up to 19.95 s, must be signals.plan.cycle_s, 20 s\n"
     "my.textproto:7:31: signals.plan.lane_plans[0].aspects[0].duration_s is 8.45 s, must be a multiple of 0.1 s, the "
     "length of a step"},
    {"cycle_s: 20", "", "my.textproto:2:3: signals.plan.cycle_s is missing; it takes a number within [1, 3600] s"},
    {"offset_s: 5", "offset_s: -5", "my.textproto:4:5: signals.plan.offset_s is -5 s, must be within [0, 3600] s"},
    {"aspect: YELLOW ", "",
     "my.textproto:8:7: signals.plan.lane_plans[0].aspects[1].aspect is missing; it takes one of RED, YELLOW, GREEN"},
    {"signals {", "signals { preset: PAPER",
     "my.textproto:2:3: signals has preset and plan; a plan stands in place of a preset, give one of them alone"},
};

TEST(SignalPlan, ThatIsWrongIsExplained) {
  for (const BadPlan& bad : kBadPlans) {
    const auto result = loaded(replaced(kTwoPhases, bad.from, bad.to));
    ASSERT_FALSE(result.ok()) << bad.to;
    EXPECT_EQ(result.error().text(), bad.error);
  }
}

/// As above, but the second phase begins while the first is still green.
std::string overlapping() {
  std::string text = replaced(kTwoPhases, "aspect: RED duration_s: 10 }\n      aspects { aspect: GREEN duration_s: 10",
                              "aspect: RED duration_s: 8 }\n      aspects { aspect: GREEN duration_s: 12");
  return text;
}

TEST(SignalPlan, ThatLetsCrossingStreamsGoTogetherIsRefused) {
  const auto result = loaded(overlapping());
  ASSERT_FALSE(result.ok());
  // The crossing streams straight on are both free from 8 s after the cycle's start, which is at 5 s.
  const std::string error = result.error().text();
  EXPECT_EQ(error.find("my.textproto:2:3: signals.plan lets crossing streams go together: "), 0U) << error;
  EXPECT_NE(error.find("WC and SC at 13.0 s"), std::string::npos) << error;
  EXPECT_NE(error.find("separate them, or set signals.allow_conflicts: true"), std::string::npos) << error;
}

TEST(SignalPlan, MayLetCrossingStreamsGoTogetherIfTheScenarioSaysSo) {
  const auto result = loaded(overlapping() + " signals { allow_conflicts: true }");
  ASSERT_FALSE(result.ok()) << "signals stand twice";
  const auto allowed = loaded(replaced(overlapping(), "signals {", "signals { allow_conflicts: true"));
  ASSERT_TRUE(allowed.ok()) << allowed.error().text();
  const auto said = warnings(allowed.value());
  ASSERT_FALSE(said.empty());
  EXPECT_NE(said.front().find("crossing streams go together, as signals.allow_conflicts permits"), std::string::npos);
}

}  // namespace
}  // namespace lukou::scenario
