#include "common/measures/crossing_watch.hpp"

#include <algorithm>
#include <tuple>

#include "common/core/contract.hpp"
#include "common/core/step.hpp"
#include "common/intersection/conflicts.hpp"
#include "common/intersection/crossing.hpp"

namespace lukou {

CrossingWatch::CrossingWatch(const RoadLengths& road, double vehicle_length_m) : approach_m_(road.approach_m) {
  for (const Lane lane : kAllLanes) {
    auto& marks = marks_[index(lane)];
    for (const Lane other : kAllLanes) {
      const auto area = crossing_area(lane, other);
      if (!area) continue;
      marks.push_back({approach_m_ + area->from_m, other, true});
      marks.push_back({approach_m_ + area->to_m + vehicle_length_m, other, false});
    }
    std::ranges::sort(marks, {}, [](const Mark& mark) { return std::tuple{mark.front_m, mark.enters, mark.other}; });
    // A car is looked at once beyond its last mark at least: no step is longer than this.
    constexpr double kLongestStep_m = 10.0;
    end_m_[index(lane)] = marks.empty() ? approach_m_ : marks.back().front_m + kLongestStep_m;
  }
}

void CrossingWatch::move(const CrossingCar& car, double now_s, std::size_t& next_mark) {
  const auto& marks = marks_[index(car.lane)];
  while (next_mark < marks.size() && car.position_m >= marks[next_mark].front_m) {
    const Mark& mark = marks[next_mark++];
    const double mean_mps = car.speed_mps - 0.5 * car.acceleration_mps2 * kStep_s;
    const double since_m = car.position_m - mark.front_m;
    const double since_s = since_m < mean_mps * kStep_s ? since_m / mean_mps : kStep_s;
    passings_.push_back({now_s - since_s, mark, car});
  }
}

std::span<const PostEncroachment> CrossingWatch::settle() {
  settled_.clear();
  if (passings_.empty()) return settled_;
  // Of what happens at the same time, leaving comes first: no car is then inside together with one that only comes.
  std::ranges::sort(passings_, {}, [](const Passing& passing) {
    return std::tuple{passing.at_s, passing.mark.enters, passing.car.lane, passing.mark.other, passing.car.vehicle};
  });
  for (const Passing& passing : passings_) take(passing);
  passings_.clear();
  return settled_;
}

void CrossingWatch::take(const Passing& passing) {
  const CrossingCar& car = passing.car;
  Use& own = uses_[index(car.lane)][index(passing.mark.other)];
  if (!passing.mark.enters) {
    LUKOU_EXPECT(own.inside > 0);
    if (--own.inside == 0) own.newest.reset();
    own.left = car;
    own.left_s = passing.at_s;
    return;
  }
  ++own.inside;
  own.newest = car;
  own.left.reset();  // the other movement follows this car now, not the one before it
  Use& other = uses_[index(passing.mark.other)][index(car.lane)];
  PostEncroachment pair{.second = car, .entered_s = passing.at_s};
  if (other.newest) {
    pair.first = *other.newest;
  } else if (other.left) {
    pair.first = *other.left;
    pair.pet_s = passing.at_s - other.left_s;
  } else {
    return;
  }
  other.left.reset();
  pair.past_line_m = passing.mark.front_m - approach_m_;
  pair.opposed_left = conflict(car.lane, pair.first.lane) == Conflict::kPermitted;
  settled_.push_back(pair);
}

}  // namespace lukou
