#include "services/console/control_holder.hpp"

#include <gtest/gtest.h>

namespace lukou::console {
namespace {

TEST(ControlHolder, IsNobodyUntilSomebodyTakesIt) {
  ControlHolder control;
  control.came(1);
  EXPECT_EQ(control.holder(), 0U);
  EXPECT_TRUE(control.take(1, false));
  EXPECT_EQ(control.holder(), 1U);
  EXPECT_TRUE(control.take(1, false)) << "again";
}

TEST(ControlHolder, IsTakenFromAnotherOnlyOnPurpose) {
  ControlHolder control;
  control.came(1);
  control.came(2);
  ASSERT_TRUE(control.take(1, false));
  EXPECT_FALSE(control.take(2, false));
  EXPECT_EQ(control.holder(), 1U);
  EXPECT_TRUE(control.take(2, true));
  EXPECT_EQ(control.holder(), 2U);
}

TEST(ControlHolder, IsNobodyAgainAfterReleaseOrDeparture) {
  ControlHolder control;
  control.came(1);
  control.came(2);
  ASSERT_TRUE(control.take(1, false));
  control.release(2);
  EXPECT_EQ(control.holder(), 1U) << "only the holder releases";
  control.release(1);
  EXPECT_EQ(control.holder(), 0U);
  ASSERT_TRUE(control.take(2, false));
  control.gone(2);
  EXPECT_EQ(control.holder(), 0U);
  EXPECT_EQ(control.viewers(), 1U);
  EXPECT_FALSE(control.take(2, true)) << "who is gone takes nothing";
}

}  // namespace
}  // namespace lukou::console
