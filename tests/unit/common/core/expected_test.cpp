#include "common/core/expected.hpp"

#include <gtest/gtest.h>

#include <memory>

namespace lukou {
namespace {

TEST(Expected, HoldsAValue) {
  Expected<int> lanes(12);
  ASSERT_TRUE(lanes.ok());
  EXPECT_TRUE(static_cast<bool>(lanes));
  EXPECT_EQ(lanes.value(), 12);
  lanes.value() = 11;
  EXPECT_EQ(std::as_const(lanes).value(), 11);
}

TEST(Expected, HoldsAnErrorInTheValuesPlace) {
  const Expected<int> lanes(Error{"a.textproto:3:1", "must be 12"});
  ASSERT_FALSE(lanes.ok());
  EXPECT_FALSE(static_cast<bool>(lanes));
  EXPECT_EQ(lanes.error().where, "a.textproto:3:1");
  EXPECT_EQ(lanes.error().what, "must be 12");
}

TEST(Expected, GivesAwayAValueThatCanOnlyBeMoved) {
  Expected<std::unique_ptr<int>> owner(std::make_unique<int>(7));
  const std::unique_ptr<int> taken = std::move(owner).value();
  EXPECT_EQ(*taken, 7);
}

TEST(ErrorText, PutsThePlaceBeforeTheFault) {
  EXPECT_EQ((Error{"run.seed", "is missing"}).text(), "run.seed: is missing");
  EXPECT_EQ((Error{"", "is missing"}).text(), "is missing");
}

TEST(ExpectedDeathTest, RefusesTheValueOfAnErrorAndTheErrorOfAValue) {
  Expected<int> wrong(Error{"", "no"});
  const Expected<int> right(1);
  EXPECT_DEATH(static_cast<void>(wrong.value()), "ok\\(\\) does not hold");
  EXPECT_DEATH(static_cast<void>(right.error()), "!ok\\(\\) does not hold");
}

}  // namespace
}  // namespace lukou
