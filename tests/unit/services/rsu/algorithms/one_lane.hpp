#pragma once

#include <utility>
#include <vector>

#include "services/rsu/sdk/rsu_algorithm.hpp"

namespace lukou::test {

/// A road of which an RSU hears one lane; the limit is 60 km/h, so a free car drives at 15 m/s.
class OneLane {
 public:
  /// Cars front to back, each {distance, speed}; ids count from 77.
  void cars(const std::vector<std::pair<double, double>>& cars) {
    heard_.clear();
    for (const auto& [distance_m, speed_mps] : cars) {
      heard_.push_back({.id = TemporaryId{77 + heard_.size()}, .distance_m = distance_m, .speed_mps = speed_mps});
    }
  }
  /// Red now, green from this step on for 45 s, and so on.
  void red_until(Step green) {
    lane_.aspect = Aspect::kRed;
    changes_ = {{Aspect::kGreen, green}, {Aspect::kRed, green + 450}, {Aspect::kGreen, green + 900}};
  }
  /// Green now, red from this step on for 45 s, then green for 45 s.
  void green_until(Step red) {
    lane_.aspect = Aspect::kGreen;
    changes_ = {{Aspect::kRed, red}, {Aspect::kGreen, red + 450}, {Aspect::kRed, red + 900}};
  }
  void no_change_is_known() { changes_.clear(); }
  void last_crossing(double time_s) { lane_.last_crossing_s = time_s; }

  LaneView lane() {
    lane_.cars = heard_;
    lane_.changes = changes_;
    return lane_;
  }
  RsuView view(Step now) {
    RsuView view;
    view.step = now;
    view.time_s = time_s(now);
    view.map = {.speed_limit_mps = 60.0 / 3.6, .approach_length_m = 500.0};
    view.lanes[1] = lane();
    return view;
  }
  std::vector<RsuAnswer::Item> answer(RsuAlgorithm& algorithm, Step now) {
    RsuAnswer said;
    algorithm.on_step(view(now), said);
    return said.items();
  }

 private:
  LaneView lane_;
  std::vector<HeardCar> heard_;
  std::vector<SignalChange> changes_;
};

}  // namespace lukou::test
