#include "common/intersection/signal_promise.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace lukou {
namespace {

/// Rows of heads as they stand in a batch, of the steps [first, first + rows): lane i of step s shows 1 + (s + i) % 3.
std::vector<std::uint8_t> rows(Step first, Step count) {
  std::vector<std::uint8_t> heads;
  for (Step step = first; step < first + count; ++step) {
    for (int lane = 0; lane < kLanes; ++lane) heads.push_back(static_cast<std::uint8_t>(1 + (step + lane) % 3));
  }
  return heads;
}

void expect_rows(const SignalPromise& promise, Step from, Step to) {
  for (Step step = from; step < to; ++step) {
    ASSERT_TRUE(promise.covers(step)) << step;
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      ASSERT_EQ(static_cast<Step>(promise.at(step)[lane]), 1 + (step + static_cast<Step>(lane)) % 3) << step;
    }
  }
  EXPECT_FALSE(promise.covers(from - 1));
  EXPECT_FALSE(promise.covers(to));
}

TEST(SignalPromise, GrowsBatchByBatch) {
  SignalPromise promise;
  EXPECT_FALSE(promise.covers(0));
  ASSERT_TRUE(promise.extend(0, rows(0, 11)));
  ASSERT_TRUE(promise.extend(11, rows(11, 5)));
  expect_rows(promise, 0, 16);
}

TEST(SignalPromise, KeepsWhatItKnowsWhereBatchesOverlap) {
  SignalPromise promise;
  ASSERT_TRUE(promise.extend(0, rows(0, 10)));
  auto overlapping = rows(5, 10);
  for (std::size_t i = 0; i < 5 * kLanes; ++i) overlapping[i] = 1;  // another word about known steps
  ASSERT_TRUE(promise.extend(5, overlapping));
  expect_rows(promise, 0, 15);
  ASSERT_TRUE(promise.extend(3, rows(3, 2))) << "nothing new";
  expect_rows(promise, 0, 15);
}

TEST(SignalPromise, RefusesAGapAndStaysAsItWas) {
  SignalPromise promise;
  ASSERT_TRUE(promise.extend(0, rows(0, 10)));
  EXPECT_FALSE(promise.extend(11, rows(11, 5)));
  expect_rows(promise, 0, 10);
}

TEST(SignalPromise, RefusesUnknownAspectsHalfRowsAndNegativeSteps) {
  SignalPromise promise;
  ASSERT_TRUE(promise.extend(0, rows(0, 10)));
  for (const std::uint8_t wrong : std::initializer_list<std::uint8_t>{0, 4, 255}) {
    auto heads = rows(10, 2);
    heads.back() = wrong;
    EXPECT_FALSE(promise.extend(10, heads)) << static_cast<int>(wrong);
  }
  auto half = rows(10, 2);
  half.pop_back();
  EXPECT_FALSE(promise.extend(10, half));
  EXPECT_FALSE(promise.extend(-1, rows(2, 20)));
  expect_rows(promise, 0, 10);
}

TEST(SignalPromise, ForgetsNothingOfARefusedFirstBatch) {
  SignalPromise promise;
  EXPECT_FALSE(promise.extend(7, std::vector<std::uint8_t>(kLanes, 9)));
  EXPECT_TRUE(promise.extend(7, std::vector<std::uint8_t>{})) << "no rows: nothing is promised";
  ASSERT_TRUE(promise.extend(0, rows(0, 3)));
  expect_rows(promise, 0, 3);
}

TEST(SignalPromise, MayBeginLate) {
  SignalPromise promise;
  ASSERT_TRUE(promise.extend(216, rows(216, 5)));
  expect_rows(promise, 216, 221);
}

TEST(SignalPromise, ForgetsThePast) {
  SignalPromise promise;
  ASSERT_TRUE(promise.extend(0, rows(0, 20)));
  promise.forget_before(8);
  expect_rows(promise, 8, 20);
  promise.forget_before(3);
  expect_rows(promise, 8, 20);
  promise.forget_before(20);
  EXPECT_FALSE(promise.covers(19));
  // What was forgotten does not come back, what follows does.
  ASSERT_TRUE(promise.extend(15, rows(15, 10)));
  expect_rows(promise, 20, 25);
}

TEST(SignalPromiseDeathTest, DoesNotGuessWhatWasNotPromised) {
  SignalPromise promise;
  ASSERT_TRUE(promise.extend(0, rows(0, 5)));
  EXPECT_DEATH(static_cast<void>(promise.at(5)), "covers\\(step\\) does not hold");
}

}  // namespace
}  // namespace lukou
