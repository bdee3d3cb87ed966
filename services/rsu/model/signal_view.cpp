#include "services/rsu/model/signal_view.hpp"

#include <string>

#include "common/core/contract.hpp"

namespace lukou {

Expected<Done> SignalView::take(const SignalNews& news) {
  const std::size_t changes = news.change_step.size();
  if (news.change_lane.size() != changes || news.change_aspect.size() != changes) {
    return Error{"signal", "the arrays of the forecast differ in length"};
  }
  for (std::size_t i = 0; i < changes; ++i) {
    if (news.change_lane[i] >= kLanes || news.change_aspect[i] < 1 || news.change_aspect[i] > 3) {
      return Error{"signal", "the forecast names an unknown lane or aspect"};
    }
  }
  if (!promise_.extend(news.first, news.heads)) {
    return Error{"signal",
                 "the heads from step " + std::to_string(news.first) + " on leave a gap or hold an unknown aspect"};
  }
  for (LaneState& lane : lanes_) lane.forecast.clear();
  for (std::size_t i = 0; i < changes; ++i) {
    lanes_[news.change_lane[i]].forecast.push_back({static_cast<Aspect>(news.change_aspect[i]), news.change_step[i]});
  }
  return Done{};
}

void SignalView::advance(Step now) {
  LUKOU_EXPECT(promise_.covers(now));
  promise_.forget_before(now);
  const Heads& heads = promise_.at(now);
  for (std::size_t lane = 0; lane < lanes_.size(); ++lane) {
    LaneState& state = lanes_[lane];
    if (state.since < 0 || state.aspect != heads[lane]) {
      state.aspect = heads[lane];
      state.since = now;
    }
    collect_changes(lane, now);
  }
}

void SignalView::collect_changes(std::size_t lane, Step now) {
  LaneState& state = lanes_[lane];
  state.changes.clear();
  Aspect last = state.aspect;
  const auto add = [&](Aspect aspect, Step step) {
    if (aspect == last) return;
    state.changes.push_back({aspect, step});
    last = aspect;
  };
  Step step = now + 1;
  for (; promise_.covers(step); ++step) add(promise_.at(step)[lane], step);
  for (const SignalChange& change : state.forecast) {
    if (change.step >= step) add(change.aspect, change.step);
  }
}

}  // namespace lukou
