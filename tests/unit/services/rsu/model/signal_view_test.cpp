#include "services/rsu/model/signal_view.hpp"

#include <gtest/gtest.h>

namespace lukou {
namespace {

constexpr Lane kLane = lane_of(Approach::kWest, Turn::kLeft);
constexpr std::uint8_t kRed = 1;
constexpr std::uint8_t kGreen = 3;

/// Heads of the steps in which WL shows `aspects`; all other lanes are red.
std::vector<std::uint8_t> heads_of(const std::vector<std::uint8_t>& aspects) {
  std::vector<std::uint8_t> heads;
  for (const std::uint8_t aspect : aspects) {
    heads.push_back(aspect);
    heads.insert(heads.end(), kLanes - 1, kRed);
  }
  return heads;
}

TEST(SignalView, JoinsThePromiseAndTheForecast) {
  SignalView view;
  const auto heads = heads_of({kGreen, kGreen, kRed, kRed});
  const std::vector<std::uint8_t> lanes = {0, 0, 0};
  const std::vector<std::uint8_t> aspects = {kRed, kGreen, kRed};
  const std::vector<Step> steps = {2, 10, 20};
  ASSERT_TRUE(
      view.take({.first = 0, .heads = heads, .change_lane = lanes, .change_aspect = aspects, .change_step = steps}));
  view.advance(0);
  EXPECT_EQ(view.aspect(kLane), Aspect::kGreen);
  const auto changes = view.changes(kLane);
  ASSERT_EQ(changes.size(), 3U);
  EXPECT_EQ(changes[0], (SignalChange{Aspect::kRed, 2}));
  EXPECT_EQ(changes[1], (SignalChange{Aspect::kGreen, 10}));
  EXPECT_EQ(changes[2], (SignalChange{Aspect::kRed, 20}));
  EXPECT_TRUE(view.changes(lane_of(Approach::kNorth, Turn::kRight)).empty());
}

TEST(SignalView, RemembersSinceWhenAHeadShowsWhatItShows) {
  SignalView view;
  ASSERT_TRUE(view.take({.first = 0,
                         .heads = heads_of({kRed, kRed, kGreen, kGreen}),
                         .change_lane = {},
                         .change_aspect = {},
                         .change_step = {}}));
  view.advance(0);
  EXPECT_EQ(view.since(kLane), 0);
  view.advance(1);
  EXPECT_EQ(view.since(kLane), 0);
  view.advance(2);
  EXPECT_EQ(view.aspect(kLane), Aspect::kGreen);
  EXPECT_EQ(view.since(kLane), 2);
  EXPECT_TRUE(view.changes(kLane).empty());
  view.advance(3);
  EXPECT_EQ(view.since(kLane), 2);
}

TEST(SignalView, HoldsThePromiseAboveAForecastThatSaysOtherwise) {
  SignalView view;
  const std::vector<std::uint8_t> lanes = {0, 0};
  const std::vector<std::uint8_t> aspects = {kGreen, kGreen};
  const std::vector<Step> steps = {1, 7};
  ASSERT_TRUE(view.take({.first = 0,
                         .heads = heads_of({kRed, kRed, kRed}),
                         .change_lane = lanes,
                         .change_aspect = aspects,
                         .change_step = steps}));
  view.advance(0);
  ASSERT_EQ(view.changes(kLane).size(), 1U);
  EXPECT_EQ(view.changes(kLane)[0], (SignalChange{Aspect::kGreen, 7}));
}

TEST(SignalView, ForgetsTheOldForecastWhenANewOneComes) {
  SignalView view;
  const std::vector<std::uint8_t> lane = {0};
  const std::vector<std::uint8_t> aspect = {kGreen};
  const std::vector<Step> at_five = {5};
  const std::vector<Step> at_six = {6};
  ASSERT_TRUE(view.take({.first = 0,
                         .heads = heads_of({kRed, kRed}),
                         .change_lane = lane,
                         .change_aspect = aspect,
                         .change_step = at_five}));
  view.advance(0);
  ASSERT_TRUE(view.take(
      {.first = 2, .heads = heads_of({kRed}), .change_lane = lane, .change_aspect = aspect, .change_step = at_six}));
  view.advance(1);
  ASSERT_EQ(view.changes(kLane).size(), 1U);
  EXPECT_EQ(view.changes(kLane)[0].step, 6);
}

TEST(SignalView, RefusesABatchThatIsMalformed) {
  SignalView view;
  const auto heads = heads_of({kRed, kRed});
  const std::vector<std::uint8_t> one = {1};
  const std::vector<std::uint8_t> twelve = {12};
  const std::vector<std::uint8_t> none = {0};
  const std::vector<Step> step = {5};
  const auto refused = [&](SignalNews news) { return !view.take(news).ok(); };
  EXPECT_TRUE(refused({.first = 0, .heads = heads, .change_lane = twelve, .change_aspect = one, .change_step = step}));
  EXPECT_TRUE(refused({.first = 0, .heads = heads, .change_lane = one, .change_aspect = none, .change_step = step}));
  EXPECT_TRUE(refused({.first = 0, .heads = heads, .change_lane = one, .change_aspect = {}, .change_step = step}));
  EXPECT_FALSE(view.covers(0));
  EXPECT_FALSE(refused({.first = 0, .heads = heads, .change_lane = one, .change_aspect = one, .change_step = step}));
  EXPECT_TRUE(refused({.first = 3, .heads = heads, .change_lane = {}, .change_aspect = {}, .change_step = {}}));
}

}  // namespace
}  // namespace lukou
