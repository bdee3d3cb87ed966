#include "services/signal_controller/signal_controller_node.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "common/intersection/signal_promise.hpp"
#include "common/lockstep/edge.hpp"

namespace lukou {
namespace {

/// A controller and a consumer behind its edge, stepped together as a run does it.
class Pair {
 public:
  Pair(const SignalPlan& plan, Step promise) : node_(plan, promise), edge_(signal_timing(promise)) {}

  void use_plan(const SignalPlan& plan, Step k) { node_.use_plan(plan, k); }
  /// Steps the controller, then the consumer if `consume`. False if the consumer lacks the heads of its step.
  bool step(Step k) {
    if (node_.step(k, batch_)) {
      EXPECT_EQ(batch_.step, k);
      first_.push_back(batch_.first);
      rows_.push_back(static_cast<Step>(batch_.heads.size()) / kLanes);
      SignalBatch sent = batch_;
      if (!edge_.accept(1, sent).ok()) return false;
    }
    if (!edge_.ready(k)) return false;
    if (const SignalBatch* news = edge_.take(k)) {
      if (!known_.extend(news->first, news->heads)) return false;
    }
    return known_.covers(k);
  }
  [[nodiscard]] const Heads& heads(Step k) const { return known_.at(k); }
  [[nodiscard]] const std::vector<Step>& first() const { return first_; }
  [[nodiscard]] const std::vector<Step>& rows() const { return rows_; }
  [[nodiscard]] const SignalBatch& last() const { return batch_; }

 private:
  SignalControllerNode node_;
  Edge<SignalBatch> edge_;
  SignalPromise known_;
  SignalBatch batch_;
  std::vector<Step> first_;
  std::vector<Step> rows_;
};

Heads heads_of(const SignalPlan& plan, Step step) {
  Heads heads{};
  for (std::size_t i = 0; i < kLanes; ++i) heads[i] = aspect_at(plan, static_cast<Lane>(i), step);
  return heads;
}

TEST(SignalControllerNode, PublishesEveryStepOnceWithoutAGapWhateverThePromise) {
  for (Step promise = 2; promise <= 20; ++promise) {
    Pair pair(paper_plan(), promise);
    constexpr Step kSteps = 400;
    for (Step k = 0; k < kSteps; ++k) ASSERT_TRUE(pair.step(k)) << "promise " << promise << " step " << k;
    Step next = 0;
    for (std::size_t i = 0; i < pair.first().size(); ++i) {
      ASSERT_EQ(pair.first()[i], next) << "promise " << promise;
      next += pair.rows()[i];
    }
    // The last batch was that of the last multiple of the stride, and it speaks `promise` steps ahead.
    const Step stride = signal_stride(promise);
    EXPECT_EQ(next, (kSteps - 1) / stride * stride + promise + 1);
    EXPECT_EQ(pair.first().size(), static_cast<std::size_t>((kSteps - 1) / stride + 1));
  }
}

TEST(SignalControllerNode, ShowsThePlansHeadsAtEveryStep) {
  for (const Step promise : {2, 3, 10, 20}) {
    for (const SignalPlan& plan : {paper_plan(), paper_yellow_plan(), protected_left_plan()}) {
      Pair pair(plan, promise);
      for (Step k = 0; k < 2000; ++k) {
        ASSERT_TRUE(pair.step(k));
        ASSERT_EQ(pair.heads(k), heads_of(plan, k)) << k;
      }
    }
  }
}

TEST(SignalControllerNode, BreaksNoPromiseWhenThePlanChanges) {
  // A change asked for at step k acts from the first start of a cycle at or after k + promise; cycles start at 900 n.
  for (Step promise = 2; promise <= 20; ++promise) {
    for (const Step asked : std::initializer_list<Step>{1, 895, 900 - promise, 901 - promise, 1000}) {
      Pair pair(paper_plan(), promise);
      const Step from = (asked + promise + 899) / 900 * 900;
      for (Step k = 0; k < 3000; ++k) {
        if (k == asked) pair.use_plan(protected_left_plan(), k);
        ASSERT_TRUE(pair.step(k));
        ASSERT_EQ(pair.heads(k), heads_of(k < from ? paper_plan() : protected_left_plan(), k))
            << "promise " << promise << " asked " << asked << " step " << k;
      }
    }
  }
}

TEST(SignalControllerNode, DoesNotStartThePlanAgainThatItHas) {
  SignalPlan plan = paper_plan();
  plan.offset = 100;
  Pair pair(plan, 10);
  for (Step k = 0; k < 3000; ++k) {
    pair.use_plan(plan, k);  // as after every change of something else
    ASSERT_TRUE(pair.step(k));
    ASSERT_EQ(pair.heads(k), heads_of(plan, k)) << k;
  }
}

TEST(SignalControllerNode, TakesBackAChangeThatHasNotTakenEffect) {
  Pair pair(paper_plan(), 10);
  for (Step k = 0; k < 3000; ++k) {
    if (k == 100) pair.use_plan(protected_left_plan(), k);
    if (k == 500) pair.use_plan(paper_plan(), k);
    ASSERT_TRUE(pair.step(k));
    ASSERT_EQ(pair.heads(k), heads_of(paper_plan(), k)) << k;
  }
}

/// Changes that the last batch forecasts, by lane.
std::map<int, std::vector<HeadChange>> forecast(const SignalBatch& batch) {
  std::map<int, std::vector<HeadChange>> lanes;
  EXPECT_EQ(batch.change_lane.size(), batch.change_step.size());
  EXPECT_EQ(batch.change_lane.size(), batch.change_aspect.size());
  for (std::size_t i = 0; i < batch.change_lane.size(); ++i) {
    lanes[batch.change_lane[i]].push_back({batch.change_step[i], static_cast<Aspect>(batch.change_aspect[i])});
  }
  return lanes;
}

TEST(SignalControllerNode, ForecastsTheChangesOfThreeCyclesInOrder) {
  Pair pair(paper_plan(), 10);
  ASSERT_TRUE(pair.step(0));
  const auto lanes = forecast(pair.last());
  ASSERT_EQ(lanes.size(), static_cast<std::size_t>(kLanes));
  for (const auto& [lane, changes] : lanes) {
    // Figure 3 of the paper: the heads change every 45 s, W and E to red first; 270 s ahead these are six changes.
    ASSERT_EQ(changes.size(), 6U);
    const bool west_east = approach_of(static_cast<Lane>(lane)) == Approach::kWest ||
                           approach_of(static_cast<Lane>(lane)) == Approach::kEast;
    for (std::size_t i = 0; i < changes.size(); ++i) {
      EXPECT_EQ(changes[i].at, 450 * static_cast<Step>(i + 1));
      EXPECT_EQ(changes[i].to, (i % 2 == 0) == west_east ? Aspect::kRed : Aspect::kGreen);
    }
  }
  EXPECT_TRUE(std::ranges::is_sorted(pair.last().change_lane));
}

TEST(SignalControllerNode, ForecastsAPendingChangeOfThePlan) {
  Pair pair(paper_plan(), 10);
  for (Step k = 0; k <= 100; ++k) {
    if (k == 100) pair.use_plan(protected_left_plan(), k);
    ASSERT_TRUE(pair.step(k));
  }
  ASSERT_EQ(pair.last().step, 100);
  ASSERT_EQ(pair.last().first, 106) << "step 95 promised through 105";
  const auto lanes = forecast(pair.last());
  // WL: red at 450; the new plan (from 900) starts with red for it, green at 22 s, yellow at 41 s, red at 44 s.
  const auto& left = lanes.at(static_cast<int>(*lane_named("WL")));
  ASSERT_GE(left.size(), 4U);
  EXPECT_EQ(left[0].at, 450);
  EXPECT_EQ(left[0].to, Aspect::kRed);
  EXPECT_EQ(left[1].at, 900 + 220);
  EXPECT_EQ(left[1].to, Aspect::kGreen);
  EXPECT_EQ(left[2].at, 900 + 410);
  EXPECT_EQ(left[2].to, Aspect::kYellow);
  EXPECT_EQ(left[3].at, 900 + 440);
  EXPECT_EQ(left[3].to, Aspect::kRed);
}

}  // namespace
}  // namespace lukou
