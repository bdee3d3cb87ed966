#include "common/lockstep/edge.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace lukou {
namespace {

struct Batch {
  Step step = 0;
  std::vector<int> column;
};

/// Hands in the batch of `step`; returns the error's text, "" if there is none.
std::string offer(Edge<Batch>& edge, Step step, std::uint32_t epoch = 1) {
  Batch batch{step, {static_cast<int>(step)}};
  const auto done = edge.accept(epoch, batch);
  return done ? "" : done.error().what;
}

/// What step k takes: the step of the batch, -1 if nothing new comes in force.
Step taken(Edge<Batch>& edge, Step k) {
  const Batch* batch = edge.take(k);
  if (batch == nullptr) return -1;
  EXPECT_EQ(batch->column, std::vector<int>{static_cast<int>(batch->step)});
  return batch->step;
}

TEST(Edge, NeedsTheBatchOfTheSameStepIfThereIsNoDelay) {
  Edge<Batch> edge(kSameStep);
  EXPECT_FALSE(edge.ready(0));
  EXPECT_EQ(offer(edge, 0), "");
  EXPECT_TRUE(edge.ready(0));
  EXPECT_EQ(taken(edge, 0), 0);
  EXPECT_FALSE(edge.ready(1)) << "never the newest in place of the one needed";
}

TEST(Edge, NeedsTheBatchOfTheStepBeforeWithADelayOfOneAndNothingAtFirst) {
  Edge<Batch> edge(kStepBefore);
  EXPECT_TRUE(edge.ready(0));
  EXPECT_EQ(taken(edge, 0), -1);
  EXPECT_FALSE(edge.ready(1));
  EXPECT_EQ(offer(edge, 0), "");
  EXPECT_TRUE(edge.ready(1));
  EXPECT_EQ(taken(edge, 1), 0);
}

TEST(Edge, TakesTheExactBatchThoughNewerOnesAreInHand) {
  Edge<Batch> edge(kStepBefore);
  for (Step step = 0; step < 50; ++step) EXPECT_EQ(offer(edge, step), "");
  EXPECT_EQ(taken(edge, 0), -1);
  for (Step k = 1; k <= 50; ++k) EXPECT_EQ(taken(edge, k), k - 1);
}

TEST(Edge, WithAStrideTakesEachBatchOnceAndKeepsItForTheStepsBetween) {
  // Delay 6, stride 5, initial: steps 0..10 use batch 0, 11..15 batch 5, 16..20 batch 10.
  Edge<Batch> edge({.delay = 6, .stride = 5, .initial = true});
  EXPECT_FALSE(edge.ready(0));
  EXPECT_EQ(offer(edge, 0), "");
  EXPECT_EQ(taken(edge, 0), 0);
  for (Step k = 1; k <= 10; ++k) {
    EXPECT_TRUE(edge.ready(k)) << k;
    EXPECT_EQ(taken(edge, k), -1) << k;
  }
  EXPECT_FALSE(edge.ready(11));
  EXPECT_EQ(offer(edge, 5), "");
  EXPECT_EQ(taken(edge, 11), 5);
  EXPECT_EQ(taken(edge, 15), -1);
  EXPECT_FALSE(edge.ready(16));
}

TEST(Edge, CallsAGapAnError) {
  Edge<Batch> same(kSameStep);
  EXPECT_EQ(offer(same, 1), "expected the batch of step 0, got 1");
  EXPECT_EQ(offer(same, 0), "");
  EXPECT_EQ(offer(same, 2), "expected the batch of step 1, got 2");
  EXPECT_EQ(offer(same, 0), "expected the batch of step 1, got 0") << "a batch that comes twice";
  EXPECT_EQ(offer(same, 1), "") << "the edge stayed as it was";

  Edge<Batch> strided({.delay = 6, .stride = 5, .initial = true});
  EXPECT_EQ(offer(strided, 0), "");
  EXPECT_EQ(offer(strided, 1), "expected the batch of step 5, got 1");
}

TEST(Edge, IgnoresWhatWasSentBeforeTheConsumerTookPart) {
  Edge<Batch> edge(kSameStep, false);
  EXPECT_EQ(offer(edge, 95), "") << "overtook the grant";
  EXPECT_TRUE(edge.begin(100).ok());
  EXPECT_EQ(offer(edge, 96), "");
  EXPECT_EQ(offer(edge, 99), "");
  EXPECT_FALSE(edge.ready(100));
  EXPECT_EQ(offer(edge, 100), "");
  EXPECT_EQ(taken(edge, 100), 100);
  EXPECT_EQ(offer(edge, 102), "expected the batch of step 101, got 102");
}

TEST(Edge, BeginsForALateConsumerWithTheBatchThatItsFirstStepNeeds) {
  // First step 211 needs batch (211 - 6) / 5 * 5 = 205; 200 and 195 came before.
  Edge<Batch> edge({.delay = 6, .stride = 5, .initial = true}, false);
  EXPECT_TRUE(edge.begin(211).ok());
  for (const Step step : {195, 200, 205, 210}) EXPECT_EQ(offer(edge, step), "");
  EXPECT_EQ(taken(edge, 211), 205);
  EXPECT_EQ(taken(edge, 215), -1);
  EXPECT_EQ(taken(edge, 216), 210);
}

TEST(Edge, IsSilentUntilItIsAttachedAndTakesEarlyBatchesThen) {
  Edge<Batch> edge(kStepBefore, false);
  EXPECT_TRUE(edge.ready(500));
  EXPECT_EQ(offer(edge, 31), "");
  EXPECT_EQ(offer(edge, 32), "");
  EXPECT_TRUE(edge.ready(32)) << "not attached: nobody waits for it";
  EXPECT_EQ(taken(edge, 32), -1);
  EXPECT_TRUE(edge.attach(1, 31).ok());
  EXPECT_EQ(taken(edge, 31), -1);
  EXPECT_EQ(taken(edge, 32), 31);
  EXPECT_EQ(taken(edge, 33), 32);
  EXPECT_FALSE(edge.ready(34));
}

TEST(Edge, ReportsAGapAmongEarlyBatches) {
  Edge<Batch> edge(kStepBefore, false);
  EXPECT_EQ(offer(edge, 31), "");
  EXPECT_EQ(offer(edge, 33), "");
  const auto attached = edge.attach(1, 31);
  ASSERT_FALSE(attached.ok());
  EXPECT_EQ(attached.error().what, "expected the batch of step 32, got 33");
}

TEST(EdgeFence, CutsBehindTheLastBatchInHandAndGoesOnSilent) {
  Edge<Batch> edge(kStepBefore);
  for (Step step = 0; step <= 4; ++step) EXPECT_EQ(offer(edge, step), "");
  for (Step k = 0; k <= 2; ++k) static_cast<void>(edge.take(k));
  EXPECT_EQ(edge.fence(1), 5) << "0..4 are in hand: 5 is the first not heard";
  EXPECT_EQ(edge.fence(1), 5) << "said twice";
  for (Step k = 3; k <= 5; ++k) EXPECT_EQ(taken(edge, k), k - 1);
  EXPECT_TRUE(edge.ready(6));
  EXPECT_EQ(taken(edge, 6), -1);
}

TEST(EdgeFence, IgnoresLaterBatchesOfThatLife) {
  Edge<Batch> edge(kStepBefore);
  EXPECT_EQ(offer(edge, 0), "");
  EXPECT_EQ(edge.fence(1), 1);
  EXPECT_EQ(offer(edge, 1), "") << "of a stopped process that woke up";
  EXPECT_EQ(offer(edge, 17), "") << "not even a gap counts";
  EXPECT_TRUE(edge.ready(2));
  EXPECT_EQ(taken(edge, 2), -1);
}

TEST(EdgeFence, OfALifeWithoutABatchCutsAtItsBegin) {
  Edge<Batch> first(kStepBefore);
  EXPECT_EQ(first.fence(1), 0);
  EXPECT_TRUE(first.ready(1));

  Edge<Batch> later(kStepBefore, false);
  EXPECT_TRUE(later.attach(2, 40).ok());
  EXPECT_EQ(later.fence(2), 40);
  EXPECT_TRUE(later.ready(41));
}

TEST(EdgeFence, BeforeTheAttachMakesAnEmptyLife) {
  Edge<Batch> edge(kStepBefore);
  EXPECT_EQ(edge.fence(1), 0);
  EXPECT_EQ(offer(edge, 60, 2), "") << "early";
  EXPECT_EQ(edge.fence(2), kNever) << "lost before it took part: none of its steps is heard";
  EXPECT_EQ(offer(edge, 61, 2), "");
  EXPECT_TRUE(edge.ready(61));
  Edge<Batch> strided({.delay = 6, .stride = 5, .initial = true});
  EXPECT_EQ(strided.fence(2), kNever);
  EXPECT_EQ(offer(strided, 60, 2), "") << "ignored, whatever the stride";
  // The next life is not disturbed by what the empty one sent.
  EXPECT_TRUE(edge.attach(3, 80).ok());
  EXPECT_EQ(offer(edge, 62, 2), "");
  EXPECT_EQ(offer(edge, 80, 3), "");
  EXPECT_EQ(taken(edge, 81), 80);
}

TEST(EdgeFence, LetsTheNextLifeBeginWhereItIsAttached) {
  Edge<Batch> edge(kStepBefore);
  for (Step step = 0; step <= 9; ++step) EXPECT_EQ(offer(edge, step), "");
  EXPECT_EQ(edge.fence(1), 10);
  EXPECT_TRUE(edge.attach(2, 30).ok());
  EXPECT_EQ(offer(edge, 10, 1), "");
  EXPECT_EQ(offer(edge, 30, 2), "");
  for (Step k = 0; k <= 10; ++k) EXPECT_EQ(taken(edge, k), k - 1);
  for (Step k = 11; k <= 30; ++k) {
    EXPECT_TRUE(edge.ready(k)) << k;
    EXPECT_EQ(taken(edge, k), -1) << k;
  }
  EXPECT_TRUE(edge.ready(31));
  EXPECT_EQ(taken(edge, 31), 30);
  EXPECT_FALSE(edge.ready(32));
}

TEST(EdgeDeathTest, RefusesToTakeWhatIsNotReady) {
  Edge<Batch> edge(kSameStep);
  EXPECT_DEATH(static_cast<void>(edge.take(0)), "does not hold");
}

TEST(Edge, ReusesTheStorageOfItsBatches) {
  // Ten batches are on their way at any time; once every one of them has storage, none is allocated any more.
  Edge<Batch> edge({.delay = 10});
  Batch batch;
  int grown = 0;
  for (Step k = 0; k < 20000; ++k) {
    if (batch.column.capacity() < 64) ++grown;
    batch.step = k;
    batch.column.assign(64, static_cast<int>(k));
    ASSERT_TRUE(edge.accept(1, batch).ok());
    const Batch* now = edge.take(k);
    ASSERT_EQ(now == nullptr, k < 10);
    if (now == nullptr) continue;
    ASSERT_EQ(now->column, std::vector<int>(64, static_cast<int>(k - 10)));
  }
  EXPECT_LE(grown, 13) << "ten on their way, one in use, one in the producer's hand, one spare";
}

TEST(SignalTiming, GivesEveryStepTheHeadsThatItNeeds) {
  for (Step promise = 2; promise <= 100; ++promise) {
    const EdgeTiming timing = signal_timing(promise);
    EXPECT_GE(timing.stride, 1);
    EXPECT_LE(timing.stride, promise);
    for (Step k = 0; k < 3 * promise; ++k) {
      // The batch in force: floor((k - delay) / stride) * stride, batch 0 at first; it speaks through its step +
      // promise.
      const Step batch = k < timing.delay ? 0 : (k - timing.delay) / timing.stride * timing.stride;
      EXPECT_GE(batch + promise, k) << "promise " << promise;
    }
    // As late as possible: the controller has as many steps of air as the promise allows, less the stride.
    EXPECT_EQ(timing.delay + timing.stride, promise + 1);
  }
}

}  // namespace
}  // namespace lukou
