#include "common/radio/modem.hpp"

#include <gtest/gtest.h>

#include "common/messages/bsm.hpp"

namespace lukou {
namespace {

TEST(Modem, OfTheIdealRadioHearsEachFrameAtOnceHoweverFar) {
  Frames frames;
  append(frames, {.sender = 1, .sequence = 0, .antenna_x_m = 0.0, .antenna_y_m = 0.0}, BasicSafety{});
  append(frames, {.sender = 2, .sequence = 0, .antenna_x_m = 1e6, .antenna_y_m = -1e6}, BasicSafety{});
  const Modem modem(RadioModel::kIdeal, {.x_m = 3.0, .y_m = 4.0});
  EXPECT_EQ(modem.heard_at(frames, 0, 17), 17);
  EXPECT_EQ(modem.heard_at(frames, 1, 18), 18);
  EXPECT_EQ(modem.antenna().y_m, 4.0);
}

}  // namespace
}  // namespace lukou
