#include "services/rsu/algorithms/stages.hpp"

#include <gtest/gtest.h>

#include "common/intersection/conflicts.hpp"
#include "tests/unit/services/rsu/algorithms/junction.hpp"

namespace lukou {
namespace {

TEST(Stages, HoldEveryLaneAndNoHardConflict) {
  for (const Staging staging : {Staging::kAxes, Staging::kProtectedLefts}) {
    LaneSet all;
    for (const LaneSet lanes : stages_of(staging)) {
      for (const Lane a : lanes) {
        for (const Lane b : lanes) EXPECT_NE(conflict(a, b), Conflict::kHard) << name(a) << name(b);
      }
      all = all | lanes;
    }
    EXPECT_EQ(all, kAllLanes);
  }
}

TEST(Stages, ProtectedLeftsMeetNobody) {
  for (const LaneSet lanes : stages_of(Staging::kProtectedLefts)) {
    for (const Lane a : lanes) {
      for (const Lane b : lanes) EXPECT_EQ(conflict(a, b), Conflict::kNone) << name(a) << name(b);
    }
  }
}

TEST(StageControl, BeginsWithTheStageThatShows) {
  test::Junction junction;
  junction.heads(test::kSouthNorth, 0);
  StageControl control(Staging::kAxes);
  control.see(junction.view(0));
  EXPECT_EQ(control.stages()[control.current()], test::kSouthNorth);
}

TEST(StageControl, MayChangeWhenTheMinimumGreenWillBeOverAsTheRequestActs) {
  // Green since step 100: 8 s are over at step 180; a request of step 169 acts at step 180.
  test::Junction junction;
  junction.heads(test::kWestEast, 100);
  StageControl control(Staging::kAxes);
  control.see(junction.view(168));
  EXPECT_FALSE(control.may_change());
  control.see(junction.view(169));
  EXPECT_TRUE(control.may_change());
  EXPECT_DOUBLE_EQ(control.green_s(), 8.0);
  EXPECT_DOUBLE_EQ(control.lead_s(), 1.1);
}

TEST(StageControl, WaitsWhileTheControllerShowsSomethingElse) {
  test::Junction junction;
  junction.heads(test::kWestEast, 0);
  StageControl control(Staging::kAxes);
  control.see(junction.view(200));
  control.go_to(1);
  control.see(junction.view(201));
  EXPECT_FALSE(control.may_change());
  EXPECT_DOUBLE_EQ(control.green_s(), 0.0);
  RsuAnswer answer;
  control.ask(answer);
  EXPECT_EQ(answer.request()->green, test::kSouthNorth);
  // The other stage was never green: at step 201 + 11, counted from the step before the first.
  EXPECT_DOUBLE_EQ(control.red_s(1), 21.3);
}

TEST(StageControl, ChangesNothingUnderAFixedPlan) {
  test::Junction junction;
  junction.heads(test::kWestEast, 0);
  RsuView view = junction.view(500);
  view.actuation.reset();
  StageControl control(Staging::kAxes);
  control.see(view);
  EXPECT_FALSE(control.may_change());
}

}  // namespace
}  // namespace lukou
