#include "common/intersection/signal_plan.hpp"

#include <gtest/gtest.h>

#include <string>

namespace lukou {
namespace {

constexpr Lane kWC = lane_of(Approach::kWest, Turn::kCenter);
constexpr Lane kWL = lane_of(Approach::kWest, Turn::kLeft);
constexpr Lane kSC = lane_of(Approach::kSouth, Turn::kCenter);
constexpr Lane kSL = lane_of(Approach::kSouth, Turn::kLeft);

/// Aspects of a lane over a cycle, one letter a second.
std::string picture(const SignalPlan& plan, Lane lane) {
  std::string letters;
  for (Step step = 0; step < plan.cycle; step += kStepsPerSecond) {
    letters += "?RYG"[static_cast<std::size_t>(aspect_at(plan, lane, step))];
  }
  return letters;
}

std::string times(std::size_t count, char letter) { return std::string(count, letter); }

TEST(SignalPlan, OfThePaperGivesEachAxisHalfOfNinetySeconds) {
  const SignalPlan plan = paper_plan();
  for (int i = 0; i < kLanes; ++i) {
    const auto lane = static_cast<Lane>(i);
    const bool west_east = approach_of(lane) == Approach::kWest || approach_of(lane) == Approach::kEast;
    EXPECT_EQ(picture(plan, lane), west_east ? times(45, 'G') + times(45, 'R') : times(45, 'R') + times(45, 'G'));
  }
}

TEST(SignalPlan, OfThePaperWithYellowTakesItFromTheGreen) {
  const SignalPlan plan = paper_yellow_plan();
  EXPECT_EQ(picture(plan, kWC), times(42, 'G') + "YYY" + times(45, 'R'));
  EXPECT_EQ(picture(plan, kSL), times(45, 'R') + times(42, 'G') + "YYY");
}

TEST(SignalPlan, WithProtectedLeftTurnsHasFourPhasesWithYellowAndAllRed) {
  const SignalPlan plan = protected_left_plan();
  // Straight and right 18 + 3 + 1 s, left 19 + 3 + 1 s: 45 s an axis.
  EXPECT_EQ(picture(plan, kWC), times(18, 'G') + "YYY" + times(69, 'R'));
  EXPECT_EQ(picture(plan, kWL), times(22, 'R') + times(19, 'G') + "YYY" + times(46, 'R'));
  EXPECT_EQ(picture(plan, kSC), times(45, 'R') + times(18, 'G') + "YYY" + times(24, 'R'));
  EXPECT_EQ(picture(plan, kSL), times(67, 'R') + times(19, 'G') + "YYY" + "R");
  EXPECT_EQ(picture(plan, lane_of(Approach::kEast, Turn::kRight)), picture(plan, kWC));
}

TEST(SignalPlan, OfEveryPresetIsValid) {
  for (const SignalPlan& plan : {paper_plan(), paper_yellow_plan(), protected_left_plan()}) {
    const auto checked = validated(plan);
    ASSERT_TRUE(checked.ok());
    EXPECT_EQ(checked.value(), plan);
    EXPECT_EQ(plan.cycle, 900);
  }
}

TEST(SignalPlan, IsRefusedWithTheLaneAndTheFault) {
  SignalPlan plan = paper_plan();
  plan.cycle = 0;
  EXPECT_EQ(validated(plan).error().text(), "cycle_s: must be at least 0.1 s");

  plan = paper_plan();
  plan.lanes[index(kSC)].clear();
  EXPECT_EQ(validated(plan).error().text(), "lane SC: has no aspects; every lane must stand in the plan once");

  plan = paper_plan();
  plan.lanes[index(kWL)][0].duration = 0;
  EXPECT_EQ(validated(plan).error().text(), "lane WL: every duration must be at least 0.1 s");

  plan = paper_plan();
  plan.lanes[index(kWL)][0].duration = 453;
  EXPECT_EQ(validated(plan).error().text(),
            "lane WL: durations add up to 90.3 s, the cycle is 90.0 s; they must be equal");
}

TEST(SignalPlan, ChangesTheHeadsExactlyAtTheBoundaries) {
  const SignalPlan plan = paper_yellow_plan();
  EXPECT_EQ(aspect_at(plan, kWC, 0), Aspect::kGreen);
  EXPECT_EQ(aspect_at(plan, kWC, 419), Aspect::kGreen);
  EXPECT_EQ(aspect_at(plan, kWC, 420), Aspect::kYellow);
  EXPECT_EQ(aspect_at(plan, kWC, 449), Aspect::kYellow);
  EXPECT_EQ(aspect_at(plan, kWC, 450), Aspect::kRed);
  EXPECT_EQ(aspect_at(plan, kWC, 899), Aspect::kRed);
  EXPECT_EQ(aspect_at(plan, kWC, 900), Aspect::kGreen);
}

TEST(SignalPlan, RepeatsForEverInBothDirectionsOfTime) {
  SignalPlan plan = paper_yellow_plan();
  plan.offset = 137;
  for (Step step = -2000; step < 2000; ++step) {
    ASSERT_EQ(aspect_at(plan, kSL, step), aspect_at(plan, kSL, step + 900)) << step;
    ASSERT_EQ(aspect_at(plan, kSL, step + 137), aspect_at(paper_yellow_plan(), kSL, step)) << step;
  }
  EXPECT_EQ(aspect_at(paper_plan(), kWC, -1), Aspect::kRed) << "the end of the cycle before";
  EXPECT_EQ(aspect_at(paper_plan(), kWC, -900 * 1'000'000LL), Aspect::kGreen);
}

TEST(NextChange, IsTheFirstStepWithAnotherAspect) {
  SignalPlan plan = protected_left_plan();
  for (const Step offset : {0, 33, -250, 4000}) {
    plan.offset = offset;
    for (int i = 0; i < kLanes; ++i) {
      const auto lane = static_cast<Lane>(i);
      for (Step step = -950; step < 950; ++step) {
        Step sought = step + 1;  // by trying every step
        while (aspect_at(plan, lane, sought) == aspect_at(plan, lane, step)) ++sought;
        ASSERT_EQ(next_change(plan, lane, step), sought) << name(lane) << " at " << step;
      }
    }
  }
}

TEST(NextChange, PassesOverBoundariesThatChangeNothing) {
  SignalPlan plan = paper_plan();
  // Red at the end and at the beginning of the cycle, and two greens in a row: changes at 10, 40, 910 only.
  plan.lanes[index(kWC)] = {{Aspect::kRed, 10}, {Aspect::kGreen, 10}, {Aspect::kGreen, 20}, {Aspect::kRed, 860}};
  EXPECT_EQ(next_change(plan, kWC, 10), 40);
  EXPECT_EQ(next_change(plan, kWC, 19), 40);
  EXPECT_EQ(next_change(plan, kWC, 40), 910);
  EXPECT_EQ(next_change(plan, kWC, 899), 910);
}

TEST(NextChange, IsNeverForAHeadThatStays) {
  SignalPlan plan = paper_plan();
  plan.lanes[index(kWC)] = {{Aspect::kGreen, 900}};
  EXPECT_EQ(next_change(plan, kWC, 0), -1);
  plan.lanes[index(kWC)] = {{Aspect::kGreen, 400}, {Aspect::kGreen, 500}};
  EXPECT_EQ(next_change(plan, kWC, 450), -1);
}

TEST(NextCycleStart, IsAtOrAfterTheStep) {
  SignalPlan plan = paper_plan();
  EXPECT_EQ(next_cycle_start(plan, 0), 0);
  EXPECT_EQ(next_cycle_start(plan, 1), 900);
  EXPECT_EQ(next_cycle_start(plan, 900), 900);
  EXPECT_EQ(next_cycle_start(plan, -1), 0);
  plan.offset = 100;
  EXPECT_EQ(next_cycle_start(plan, 0), 100);
  EXPECT_EQ(next_cycle_start(plan, 101), 1000);
  EXPECT_EQ(next_cycle_start(plan, -800), -800);
}

TEST(GreenShare, IsTheGreenPartOfTheCycle) {
  EXPECT_EQ(green_share(paper_plan(), kWC), 0.5);
  EXPECT_EQ(green_share(paper_yellow_plan(), kSL), 42.0 / 90.0) << "yellow is not green";
  EXPECT_EQ(green_share(protected_left_plan(), kWL), 19.0 / 90.0);
  EXPECT_EQ(green_share(protected_left_plan(), kWC), 18.0 / 90.0);
}

}  // namespace
}  // namespace lukou
