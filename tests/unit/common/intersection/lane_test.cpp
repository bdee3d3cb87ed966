#include "common/intersection/lane.hpp"

#include <gtest/gtest.h>

namespace lukou {
namespace {

TEST(Lane, HasTheNamesOfTheTwelveApproachLanesInTheirOrder) {
  const std::array<std::string_view, kLanes> names = {"WL", "WC", "WR", "SL", "SC", "SR",
                                                      "EL", "EC", "ER", "NL", "NC", "NR"};
  for (std::size_t i = 0; i < names.size(); ++i) {
    EXPECT_EQ(name(static_cast<Lane>(i)), names[i]);
    EXPECT_EQ(lane_named(names[i]), static_cast<Lane>(i));
  }
}

TEST(Lane, IsAnApproachAndATurn) {
  EXPECT_EQ(name(lane_of(Approach::kWest, Turn::kLeft)), "WL");
  EXPECT_EQ(name(lane_of(Approach::kEast, Turn::kCenter)), "EC");
  EXPECT_EQ(name(lane_of(Approach::kNorth, Turn::kRight)), "NR");
  for (int i = 0; i < kLanes; ++i) {
    const auto lane = static_cast<Lane>(i);
    EXPECT_EQ(lane_of(approach_of(lane), turn_of(lane)), lane);
    // The name says the same: its first letter is the approach, its second the turn.
    EXPECT_EQ(name(lane)[0], "WSEN"[index(approach_of(lane))]);
    EXPECT_EQ(name(lane)[1], "LCR"[static_cast<std::size_t>(turn_of(lane))]);
  }
}

TEST(Lane, IsNotFoundUnderAnotherSpelling) {
  for (const char* wrong : {"", "W", "wl", "WLL", "LW", "OC"}) EXPECT_EQ(lane_named(wrong), std::nullopt) << wrong;
}

TEST(Approach, HasTheNamesOfTheScenario) {
  for (const Approach approach : kAllApproaches) EXPECT_EQ(approach_named(name(approach)), approach);
  EXPECT_EQ(name(Approach::kWest), "west");
  EXPECT_EQ(name(Approach::kSouth), "south");
  EXPECT_EQ(name(Approach::kEast), "east");
  EXPECT_EQ(name(Approach::kNorth), "north");
  EXPECT_EQ(approach_named("West"), std::nullopt);
  EXPECT_EQ(approach_named(""), std::nullopt);
}

}  // namespace
}  // namespace lukou
