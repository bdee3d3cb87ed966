#include "services/rsu/algorithms/cv_phase.hpp"

#include <gtest/gtest.h>

#include "tests/unit/services/rsu/algorithms/junction.hpp"

namespace lukou {
namespace {

using test::kSC;
using test::kSouthNorth;
using test::kWC;
using test::kWestEast;

constexpr std::size_t kWestEastStage = 0;
constexpr std::size_t kSouthNorthStage = 1;

/// Headway 2 s, first crossing 1.5 s after the begin of green, tail 2 s; every car has a unit.
class CvPhaseTest : public testing::Test {
 protected:
  CvPhaseTest() { junction_.heads(kWestEast, 0); }
  LaneSet asked(Step now) { return junction_.asked(algorithm_, now); }
  double cost_s(double end_s) { return algorithm_.cost_s(arrivals_, kWestEastStage, kSouthNorthStage, end_s, {}); }

  CvPhase algorithm_{{.equipped_share = 1.0}};
  CvPhase::Arrivals arrivals_;
  test::Junction junction_;
};

TEST_F(CvPhaseTest, CountsTheWaitOfAQueueUntilItsGreen) {
  // Green ends after 1.1 s, then 3 s yellow and 1 s all-red: crossings at 5.1 + 1.5 = 6.6 s and 8.6 s instead of 0
  // and 1.
  arrivals_[index(kSC)] = {0.0, 1.0};
  EXPECT_DOUBLE_EQ(cost_s(1.1), 6.6 + 7.6);
  EXPECT_DOUBLE_EQ(cost_s(2.1), 7.6 + 8.6);
}

TEST_F(CvPhaseTest, CountsWhatACarPaysThatMissesTheEndOfGreen) {
  // Its arrival after 5 s is beyond 1.1 + 2 s. The other green begins at 5.1 s, is 8 s long for nobody, and 4 s later
  // the car's own begins: 17.1 + 1.5 s. With an end at 3 s it still crosses.
  arrivals_[index(kWC)] = {5.0};
  EXPECT_DOUBLE_EQ(cost_s(1.1), 18.6 - 5.0);
  EXPECT_DOUBLE_EQ(cost_s(3.0), 0.0);
}

TEST_F(CvPhaseTest, LetsEachHeardCarStandForThoseThatAreSilent) {
  // One of two has a unit: headway 4 s between heard cars.
  const CvPhase half({.equipped_share = 0.5});
  arrivals_[index(kSC)] = {0.0, 1.0};
  EXPECT_DOUBLE_EQ(half.cost_s(arrivals_, kWestEastStage, kSouthNorthStage, 1.1, {}), 6.6 + 9.6);
}

TEST_F(CvPhaseTest, EndsAGreenThatNobodyNeeds) {
  junction_.heard(kSC, {{0.2, 0.0}});
  EXPECT_EQ(asked(100), kSouthNorth);
}

TEST_F(CvPhaseTest, WaitsForTheQueueThatIsCrossing) {
  // Ten cars before the line of one lane against one that waits.
  junction_.heard(kSC, {{0.2, 0.0}});
  std::vector<std::pair<double, double>> queue;
  for (int i = 0; i < 10; ++i) queue.emplace_back(2.0 + 5.6 * i, 2.8);
  junction_.heard(kWC, queue);
  EXPECT_EQ(asked(100), kWestEast);
}

TEST_F(CvPhaseTest, StaysWhereItIsOnAnEmptyRoad) {
  for (Step now = 100; now < 500; ++now) ASSERT_EQ(asked(now), kWestEast);
}

TEST_F(CvPhaseTest, GivesGreenAfterAMinuteWithoutOneThoughNobodyAnnouncesHimself) {
  // South and north were last green before step 0. A request of step 590 acts at step 601, more than 60 s later.
  junction_.heard(kWC, {{100.0, 15.0}});
  for (Step now = 100; now < 590; ++now) ASSERT_EQ(asked(now), kWestEast) << now;
  EXPECT_EQ(asked(590), kSouthNorth);
}

}  // namespace
}  // namespace lukou
