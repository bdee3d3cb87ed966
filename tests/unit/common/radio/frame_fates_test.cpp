#include "common/radio/frame_fates.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace lukou {
namespace {

TEST(FrameFates, TellWhenAFrameIsHeardOrWhyItIsLost) {
  FrameFates fates;
  fates.add(Reception{.lost = {}, .first = {.due = 7, .at_ms = 690.0, .latency_ms = 92.5}, .second = {}});
  fates.add(Reception{.lost = LossCause::kCollision, .first = {}, .second = {}});
  EXPECT_TRUE(fates.well_formed());
  EXPECT_EQ(fates.fate, (std::vector<std::uint8_t>{kFrameHeard, 5}));
  EXPECT_EQ(fates.due, (std::vector<Step>{7, -1}));
  EXPECT_EQ(fates.latency_ms[0], 92.5);
  EXPECT_TRUE(std::isnan(fates.latency_ms[1]));
}

TEST(FrameFates, AreBrokenIfAColumnIsShorterOrACauseUnknown) {
  FrameFates fates;
  fates.add(Reception{.lost = LossCause::kOutage, .first = {}, .second = {}});
  EXPECT_TRUE(fates.well_formed());
  FrameFates shorter = fates;
  shorter.due.clear();
  EXPECT_FALSE(shorter.well_formed());
  fates.fate[0] = kFrameFates;
  EXPECT_FALSE(fates.well_formed());
}

}  // namespace
}  // namespace lukou
