#include "services/rsu/algorithms/actuated.hpp"

#include <gtest/gtest.h>

#include "tests/unit/services/rsu/algorithms/junction.hpp"

namespace lukou {
namespace {

using test::kSC;
using test::kSouthNorth;
using test::kWC;
using test::kWestEast;

/// Gap 2 s, detection 40 m, at most 20 s of green. West and east have been green for long enough.
class ActuatedTest : public testing::Test {
 protected:
  ActuatedTest() { junction_.heads(kWestEast, 0); }
  LaneSet asked(Step now) { return junction_.asked(actuated_, now); }

  Actuated actuated_{{.gap_s = 2.0, .detection_m = 40.0, .max_green_s = 20.0}};
  test::Junction junction_;
};

TEST_F(ActuatedTest, RestsInGreenWhileNobodyWaitsElsewhere) {
  for (Step now = 100; now < 2000; ++now) ASSERT_EQ(asked(now), kWestEast);
}

TEST_F(ActuatedTest, GapsOutTwoSecondsAfterTheLastCar) {
  junction_.sensed(kSC, {{0.2, 0.0}});
  junction_.sensed(kWC, {{39.0, 14.0}});
  EXPECT_EQ(asked(100), kWestEast);
  junction_.sensed(kWC, {});
  for (Step now = 101; now < 120; ++now) ASSERT_EQ(asked(now), kWestEast) << now;
  EXPECT_EQ(asked(120), kSouthNorth);
}

TEST_F(ActuatedTest, TakesACarBeyondTheDetectorForNoCar) {
  junction_.sensed(kSC, {{0.2, 0.0}});
  junction_.sensed(kWC, {{40.5, 14.0}});
  EXPECT_EQ(asked(100), kSouthNorth);
}

TEST_F(ActuatedTest, HearsACarThatNoSensorSees) {
  junction_.heard(kSC, {{0.2, 0.0}});
  EXPECT_EQ(asked(100), kSouthNorth);
}

TEST_F(ActuatedTest, MaxesOutTwentySecondsAfterTheFirstCall) {
  junction_.sensed(kWC, {{20.0, 14.0}});
  EXPECT_EQ(asked(500), kWestEast);
  junction_.sensed(kSC, {{0.2, 0.0}});
  for (Step now = 501; now < 701; ++now) ASSERT_EQ(asked(now), kWestEast) << now;
  EXPECT_EQ(asked(701), kSouthNorth);
}

TEST_F(ActuatedTest, KeepsTheMinimumGreen) {
  junction_.heads(kWestEast, 100);
  junction_.sensed(kSC, {{0.2, 0.0}});
  EXPECT_EQ(asked(168), kWestEast);
  EXPECT_EQ(asked(169), kSouthNorth);
}

TEST_F(ActuatedTest, LeavesOutAStageWhereNobodyWaits) {
  Actuated four({.staging = Staging::kProtectedLefts});
  const std::vector<LaneSet> stages = stages_of(Staging::kProtectedLefts);
  junction_.heads(stages[0], 0);
  junction_.sensed(test::kNL, {{0.2, 0.0}});
  EXPECT_EQ(junction_.asked(four, 100), stages[3]);
}

}  // namespace
}  // namespace lukou
