#include "common/intersection/lane_set.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace lukou {
namespace {

constexpr auto kWl = static_cast<Lane>(0);
constexpr auto kWr = static_cast<Lane>(2);
constexpr auto kNr = static_cast<Lane>(11);

TEST(LaneSet, HoldsWhatWasPutIn) {
  LaneSet set;
  EXPECT_TRUE(set.empty());
  set.insert(kNr);
  set.insert(kWl);
  set.insert(kWl);
  EXPECT_EQ(set.size(), 2U);
  EXPECT_TRUE(set.contains(kNr));
  EXPECT_FALSE(set.contains(kWr));
  set.erase(kNr);
  EXPECT_EQ(set, LaneSet{kWl});
}

TEST(LaneSet, GoesThroughItsLanesInTheirOrder) {
  std::vector<Lane> lanes;
  for (const Lane lane : LaneSet{kNr, kWl, kWr}) lanes.push_back(lane);
  EXPECT_EQ(lanes, (std::vector<Lane>{kWl, kWr, kNr}));
  for (const Lane lane : LaneSet{}) ADD_FAILURE() << name(lane);
}

TEST(LaneSet, JoinsMeetsAndSubtracts) {
  const LaneSet a{kWl, kWr};
  const LaneSet b{kWr, kNr};
  EXPECT_EQ(a | b, (LaneSet{kWl, kWr, kNr}));
  EXPECT_EQ(a & b, LaneSet{kWr});
  EXPECT_EQ(a - b, LaneSet{kWl});
}

TEST(LaneSet, ComesFromTheBitsOfTheTwelveLanesAlone) {
  EXPECT_EQ(LaneSet::from_bits(0b1000'0000'0101), (LaneSet{kWl, kWr, kNr}));
  EXPECT_EQ(LaneSet::from_bits(0xFFFF).size(), 12U);
  EXPECT_EQ((LaneSet{kWl, kNr}).bits(), 0b1000'0000'0001);
}

}  // namespace
}  // namespace lukou
