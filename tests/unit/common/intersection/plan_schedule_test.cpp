#include "common/intersection/plan_schedule.hpp"

#include <gtest/gtest.h>

#include <optional>

namespace lukou {
namespace {

constexpr Lane kWC = lane_of(Approach::kWest, Turn::kCenter);
constexpr Lane kSC = lane_of(Approach::kSouth, Turn::kCenter);

/// W and E green for `green` steps, then S and N for as long.
SignalPlan axes(Step green) {
  SignalPlan plan;
  plan.cycle = 2 * green;
  for (int i = 0; i < kLanes; ++i) {
    const auto lane = static_cast<Lane>(i);
    const bool first = approach_of(lane) == Approach::kWest || approach_of(lane) == Approach::kEast;
    plan.lanes[index(lane)] = {{first ? Aspect::kGreen : Aspect::kRed, green},
                               {first ? Aspect::kRed : Aspect::kGreen, green}};
  }
  return plan;
}

Heads heads_of(const SignalPlan& plan, Step step) {
  Heads heads{};
  for (std::size_t i = 0; i < kLanes; ++i) heads[i] = aspect_at(plan, static_cast<Lane>(i), step);
  return heads;
}

/// The first step in [0, limit) at which the schedule does not show `plan`, shifted to start at `from`.
std::optional<Step> departs(const PlanSchedule& schedule, const SignalPlan& plan, Step from, Step begin, Step limit) {
  for (Step step = begin; step < limit; ++step) {
    if (schedule.heads(step) != heads_of(plan, step - from)) return step;
  }
  return std::nullopt;
}

TEST(PlanSchedule, RunsTheFirstPlanFromEverAndForEver) {
  const PlanSchedule schedule(paper_plan());
  EXPECT_EQ(departs(schedule, paper_plan(), 0, -1000, 5000), std::nullopt);
  EXPECT_EQ(schedule.cycle_at(123), 900);
}

TEST(PlanSchedule, ChangesAtTheNextStartOfACycle) {
  PlanSchedule schedule(axes(100));
  schedule.change(axes(30), 250);
  EXPECT_EQ(departs(schedule, axes(100), 0, 0, 2000), 430)
      << "the new plan is red where the old one is green only there";
  EXPECT_EQ(departs(schedule, axes(100), 0, 0, 400), std::nullopt);
  EXPECT_EQ(departs(schedule, axes(30), 400, 400, 2000), std::nullopt);
  EXPECT_EQ(schedule.cycle_at(399), 200);
  EXPECT_EQ(schedule.cycle_at(400), 60);
}

TEST(PlanSchedule, ChangesAtOnceIfACycleStartsThere) {
  PlanSchedule schedule(axes(100));
  schedule.change(axes(30), 400);
  EXPECT_EQ(schedule.cycle_at(399), 200);
  EXPECT_EQ(schedule.cycle_at(400), 60);
  PlanSchedule later(axes(100));
  later.change(axes(30), 401);
  EXPECT_EQ(later.cycle_at(599), 200);
  EXPECT_EQ(later.cycle_at(600), 60);
}

TEST(PlanSchedule, CountsCyclesFromTheOffsetOfThePlan) {
  SignalPlan first = axes(100);
  first.offset = 50;
  PlanSchedule schedule(first);
  SignalPlan second = axes(30);
  second.offset = 7;
  schedule.change(second, 240);  // cycles start at 50, 250, 450
  EXPECT_EQ(schedule.cycle_at(249), 200);
  EXPECT_EQ(schedule.cycle_at(250), 60);
  // Its own cycle starts 7 steps later; before that it shows the end of the one before: S and N green.
  EXPECT_EQ(schedule.heads(256)[index(kSC)], Aspect::kGreen);
  EXPECT_EQ(departs(schedule, axes(30), 257, 250, 2000), std::nullopt);
}

TEST(PlanSchedule, ReplacesAChangeThatHasNotTakenEffect) {
  PlanSchedule schedule(axes(100));
  schedule.change(axes(30), 250);  // would take effect at 400
  schedule.change(axes(45), 260);
  EXPECT_EQ(departs(schedule, axes(100), 0, 0, 400), std::nullopt);
  EXPECT_EQ(departs(schedule, axes(45), 400, 400, 3000), std::nullopt);
}

TEST(PlanSchedule, KeepsAChangeThatIsDecidedAlready) {
  PlanSchedule schedule(axes(100));
  schedule.change(axes(30), 250);  // takes effect at 400: decided when the next one may act at 401 at the earliest
  schedule.change(axes(45), 401);  // cycles of 60 from 400 on: 460
  EXPECT_EQ(departs(schedule, axes(30), 400, 400, 460), std::nullopt);
  EXPECT_EQ(departs(schedule, axes(45), 460, 460, 3000), std::nullopt);
}

struct Change {
  Step at;
  Aspect to;
  friend bool operator==(const Change&, const Change&) = default;
};

std::vector<Change> changes(const PlanSchedule& schedule, Lane lane, Step from, Step to) {
  std::vector<Change> found;
  for (const HeadChange& change : schedule.changes(lane, from, to)) found.push_back({change.at, change.to});
  return found;
}

/// By looking at every step.
std::vector<Change> seen(const PlanSchedule& schedule, Lane lane, Step from, Step to) {
  std::vector<Change> found;
  for (Step step = from + 1; step <= to; ++step) {
    const Aspect now = schedule.heads(step)[index(lane)];
    if (now != schedule.heads(step - 1)[index(lane)]) found.push_back({step, now});
  }
  return found;
}

TEST(PlanScheduleChanges, AreThoseAfterFromThroughTo) {
  const PlanSchedule schedule(axes(100));
  const std::vector<Change> expected = {{100, Aspect::kRed}, {200, Aspect::kGreen}, {300, Aspect::kRed}};
  EXPECT_EQ(changes(schedule, kWC, 0, 300), expected);
  EXPECT_EQ(changes(schedule, kWC, 99, 300), expected);
  EXPECT_EQ(changes(schedule, kWC, 100, 299), (std::vector<Change>{{200, Aspect::kGreen}}));
  EXPECT_TRUE(changes(schedule, kWC, 100, 199).empty());
}

TEST(PlanScheduleChanges, CrossAHandOverWithoutTellingOneThatIsNone) {
  PlanSchedule schedule(axes(100));
  schedule.change(axes(30), 150);  // at 200
  // WC: red at 100, green with the new plan at 200, red 230, green 260.
  EXPECT_EQ(
      changes(schedule, kWC, 0, 260),
      (std::vector<Change>{{100, Aspect::kRed}, {200, Aspect::kGreen}, {230, Aspect::kRed}, {260, Aspect::kGreen}}));
  // A new plan that starts with red for WC: nothing changes at 200.
  SignalPlan turned = axes(30);
  turned.offset = 30;
  PlanSchedule other(axes(100));
  other.change(turned, 150);
  EXPECT_EQ(changes(other, kWC, 0, 260),
            (std::vector<Change>{{100, Aspect::kRed}, {230, Aspect::kGreen}, {260, Aspect::kRed}}));
}

TEST(PlanScheduleChanges, SayNothingOfAPlanThatTakesOverLater) {
  PlanSchedule schedule(axes(100));
  SignalPlan stays = axes(30);
  for (auto& lane : stays.lanes) lane = {{Aspect::kYellow, 60}};
  schedule.change(stays, 150);  // at 200
  EXPECT_TRUE(changes(schedule, kWC, 100, 199).empty());
  EXPECT_EQ(changes(schedule, kWC, 100, 200), (std::vector<Change>{{200, Aspect::kYellow}}));
}

TEST(PlanScheduleChanges, AreWhatOneSeesStepByStep) {
  PlanSchedule schedule(paper_yellow_plan());
  schedule.change(protected_left_plan(), 400);  // at 900
  schedule.change(axes(7), 950);                // at 1800
  SignalPlan last = paper_plan();
  last.offset = 33;
  schedule.change(last, 1801);  // at 1814
  for (int i = 0; i < kLanes; ++i) {
    const auto lane = static_cast<Lane>(i);
    for (Step from = 0; from < 2800; from += 13) {
      for (const Step length : {1, 10, 90, 1000}) {
        ASSERT_EQ(changes(schedule, lane, from, from + length), seen(schedule, lane, from, from + length))
            << name(lane) << " from " << from << " for " << length;
      }
    }
  }
}

TEST(PlanSchedule, ForgetsOnlyWhatHasEnded) {
  PlanSchedule schedule(axes(100));
  schedule.change(axes(30), 150);  // at 200
  schedule.forget_before(199);
  EXPECT_EQ(schedule.cycle_at(199), 200);
  EXPECT_EQ(departs(schedule, axes(30), 200, 200, 1000), std::nullopt);
  schedule.forget_before(200);
  EXPECT_EQ(departs(schedule, axes(30), 200, 200, 1000), std::nullopt);
  EXPECT_EQ(schedule.cycle_at(199), 60) << "the plan that ended at 200 is gone";
}

}  // namespace
}  // namespace lukou
