#include "services/rsu/algorithms/max_pressure.hpp"

#include <gtest/gtest.h>

#include "tests/unit/services/rsu/algorithms/junction.hpp"

namespace lukou {
namespace {

using test::kNL;
using test::kSC;
using test::kSouthNorth;
using test::kWC;
using test::kWestEast;

class MaxPressureTest : public testing::Test {
 protected:
  MaxPressureTest() { junction_.heads(kWestEast, 0); }
  LaneSet asked(Step now) { return junction_.asked(algorithm_, now); }

  MaxPressure algorithm_{MaxPressureParameters{}};  // 100 m, every second, two cars of hysteresis
  test::Junction junction_;
};

TEST_F(MaxPressureTest, ChangesWhenAnotherStageHasThreeCarsMore) {
  junction_.sensed(kWC, {{20.0, 10.0}});
  junction_.sensed(kSC, {{0.2, 0.0}, {5.8, 0.0}});
  junction_.sensed(kNL, {{0.2, 0.0}});
  EXPECT_EQ(asked(100), kWestEast) << "3 is not more than 1 + 2";
  junction_.sensed(kNL, {{0.2, 0.0}, {5.8, 0.0}});
  EXPECT_EQ(asked(110), kSouthNorth);
}

TEST_F(MaxPressureTest, DecidesOnceASecond) {
  junction_.sensed(kSC, {{0.2, 0.0}});
  for (Step now = 101; now < 110; ++now) ASSERT_EQ(asked(now), kWestEast);
  EXPECT_EQ(asked(110), kSouthNorth);
}

TEST_F(MaxPressureTest, GivesASingleCarGreenWhereNobodyElseIs) {
  junction_.sensed(kSC, {{0.2, 0.0}});
  EXPECT_EQ(asked(100), kSouthNorth);
}

TEST_F(MaxPressureTest, StaysWhereItIsOnAnEmptyRoad) {
  for (Step now = 100; now < 500; ++now) ASSERT_EQ(asked(now), kWestEast);
}

TEST_F(MaxPressureTest, CountsCarsWithinAHundredMetresOnly) {
  junction_.sensed(kWC, {{90.0, 14.0}});
  junction_.sensed(kSC, {{0.2, 0.0}, {5.8, 0.0}, {60.0, 14.0}, {100.5, 14.0}});
  EXPECT_EQ(asked(100), kWestEast);
}

TEST_F(MaxPressureTest, KeepsTheMinimumGreen) {
  junction_.heads(kWestEast, 101);
  junction_.sensed(kSC, {{0.2, 0.0}});
  EXPECT_EQ(asked(160), kWestEast);  // a request of step 170 acts at 181 = 101 + 80
  EXPECT_EQ(asked(170), kSouthNorth);
}

}  // namespace
}  // namespace lukou
