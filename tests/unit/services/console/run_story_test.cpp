#include "services/console/run_story.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "console.pb.h"

namespace lukou::console {
namespace {

RunStory story(const std::string& scenario = "") {
  auto made = RunStory::of("paper-1", scenario);
  EXPECT_TRUE(made.ok()) << made.error().text();
  return std::move(made).value();
}

TEST(RunStory, IsNoneWithoutAScenario) { EXPECT_FALSE(RunStory::of("r", "nonsense {").ok()); }

TEST(RunStory, DrawsEachLaneFromEntranceToExit) {
  const Hello hello = story().hello();
  ASSERT_EQ(hello.lanes_size(), 12);
  for (const LanePath& lane : hello.lanes()) {
    ASSERT_EQ(lane.points_size(), lane.distance_m_size());
    EXPECT_EQ(lane.distance_m(0), 0.0);
    EXPECT_EQ(lane.stop_line_m(), 500.0);
    EXPECT_EQ(lane.distance_m(lane.distance_m_size() - 1), 600.0) << "100 m past the line";
    for (int i = 1; i < lane.points_size(); ++i) {
      // A chord is no longer than the way along the path, and on a curve in pieces of 1 m hardly shorter.
      const double dx = lane.points(i).x_m() - lane.points(i - 1).x_m();
      const double dy = lane.points(i).y_m() - lane.points(i - 1).y_m();
      const double way_m = lane.distance_m(i) - lane.distance_m(i - 1);
      EXPECT_NEAR(std::sqrt(dx * dx + dy * dy), way_m, 0.01) << lane.name();
    }
  }
  EXPECT_EQ(hello.lanes(1).name(), "WC");
  EXPECT_EQ(hello.lanes(1).points(0).x_m(), -515.5) << "500 m before the line, which is 15.5 m before the centre";
}

TEST(RunStory, SaysWhichLanesConflict) {
  const std::string matrix = story().hello().conflicts();
  ASSERT_EQ(matrix.size(), 144U);
  const auto between = [&](int a, int b) { return static_cast<int>(matrix[static_cast<std::size_t>(12 * a + b)]); };
  EXPECT_EQ(between(1, 4), 2) << "WC crosses SC";
  EXPECT_EQ(between(4, 1), 2);
  EXPECT_EQ(between(0, 7), 1) << "WL turns before EC";
  EXPECT_EQ(between(1, 7), 0) << "WC passes EC";
  EXPECT_EQ(between(3, 3), 0);
}

TEST(RunStory, TellsLiveValuesWithTheChangesMadeSoFar) {
  RunStory run = story();
  run.change({100, "traffic.west.flow_veh_per_h=700"});
  run.change({120, "no such field=1"});
  const Hello hello = run.hello();
  bool found = false;
  for (const LiveField& field : hello.live()) {
    if (field.path() != "traffic.west.flow_veh_per_h") continue;
    found = true;
    EXPECT_EQ(field.value(), "700");
    EXPECT_EQ(field.max(), 10800.0);
  }
  EXPECT_TRUE(found);
  EXPECT_EQ(hello.seed(), "1");
  EXPECT_EQ(hello.presets_size(), 3);
}

TEST(RunStory, KnowsThePlanThatTheHeadsFollow) {
  RunStory run = story("run { signal_promise_steps: 10 }");
  EXPECT_EQ(run.program_at(0).running->plan, paper_plan());
  EXPECT_EQ(run.program_at(0).cycle_start, 0);
  run.change({895, "signals.preset=PAPER_YELLOW"});
  // From 905 on it may take over; the paper's plan starts its cycles at 0, 900, 1800.
  EXPECT_EQ(run.program_at(1799).running->plan, paper_plan());
  const RunStory::Program after = run.program_at(1800);
  EXPECT_EQ(after.running->plan.lanes, paper_yellow_plan().lanes);
  EXPECT_EQ(after.running->offset, 0);
  EXPECT_EQ(after.cycle_start, 1800);
}

TEST(RunStory, FindsACycleUnderWayOfAPlanWithAnOffset) {
  const std::string lanes =
      "lanes: [\"WL\", \"WC\", \"WR\", \"SL\", \"SC\", \"SR\", \"EL\", \"EC\", \"ER\", \"NL\", \"NC\", \"NR\"]";
  RunStory run = story("signals { plan { cycle_s: 60 offset_s: 20 lane_plans { " + lanes +
                       " aspects { aspect: RED duration_s: 60 } } } }");
  // Cycles start at 200 + n * 600 steps; the one under way at step 0 began at -400.
  EXPECT_EQ(run.program_at(0).cycle_start, -400);
  EXPECT_EQ(run.program_at(0).running->offset, 200);
}

TEST(RunStory, PutsAProgramIntoWholeSteps) {
  const SignalProgram program = message_of(paper_yellow_plan(), 30);
  EXPECT_EQ(program.cycle_steps(), 900U);
  EXPECT_EQ(program.offset_steps(), 30U);
  ASSERT_EQ(program.lanes_size(), 12);
  ASSERT_GE(program.lanes(0).aspect_size(), 2);
  EXPECT_EQ(program.lanes(0).aspect(0), 3U) << "green first";
  EXPECT_EQ(program.lanes(0).steps(0), 420U);
  EXPECT_EQ(program.lanes(0).steps(1), 30U) << "3 s of yellow";
}

}  // namespace
}  // namespace lukou::console
