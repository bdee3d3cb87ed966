#pragma once

#include <array>
#include <utility>
#include <vector>

#include "services/rsu/sdk/rsu_algorithm.hpp"

namespace lukou::test {

/// A junction whose controller follows requests: minimum green 8 s, yellow 3 s, all-red 1 s; a request acts after
/// 1.1 s, all heads are known until now. The limit is 60 km/h, so a free car drives at 15 m/s.
class Junction {
 public:
  void heads(LaneSet green, Step since) {
    for (const Lane lane : kAllLanes) {
      lanes_[index(lane)].aspect = green.contains(lane) ? Aspect::kGreen : Aspect::kRed;
      lanes_[index(lane)].aspect_since = since;
    }
  }
  /// Cars front to back, each {distance, speed}.
  void sensed(Lane lane, const std::vector<std::pair<double, double>>& cars) {
    sensed_[index(lane)].clear();
    for (const auto& [distance_m, speed_mps] : cars) {
      sensed_[index(lane)].push_back({.lane = lane, .distance_m = distance_m, .speed_mps = speed_mps});
    }
  }
  void heard(Lane lane, const std::vector<std::pair<double, double>>& cars) {
    heard_[index(lane)].clear();
    for (const auto& [distance_m, speed_mps] : cars) {
      heard_[index(lane)].push_back({.lane = lane, .distance_m = distance_m, .speed_mps = speed_mps});
    }
  }
  RsuView view(Step now) {
    RsuView view;
    view.step = now;
    view.time_s = time_s(now);
    view.map = {.speed_limit_mps = 60.0 / 3.6, .approach_length_m = 500.0};
    view.actuation = Actuation{};
    view.promised_to = now;
    view.request_acts = now + 11;
    view.lanes = lanes_;
    for (const Lane lane : kAllLanes) {
      view.lanes[index(lane)].cars = heard_[index(lane)];
      view.lanes[index(lane)].sensed = sensed_[index(lane)];
    }
    return view;
  }
  /// What the algorithm asks for; it must ask in every step.
  LaneSet asked(RsuAlgorithm& algorithm, Step now) {
    RsuAnswer said;
    algorithm.on_step(view(now), said);
    return said.request().value().green;
  }

 private:
  std::array<LaneView, kLanes> lanes_;
  std::array<std::vector<HeardCar>, kLanes> heard_;
  std::array<std::vector<SensedCar>, kLanes> sensed_;
};

inline constexpr Lane kWC = lane_of(Approach::kWest, Turn::kCenter);
inline constexpr Lane kWL = lane_of(Approach::kWest, Turn::kLeft);
inline constexpr Lane kSC = lane_of(Approach::kSouth, Turn::kCenter);
inline constexpr Lane kNL = lane_of(Approach::kNorth, Turn::kLeft);
inline constexpr LaneSet kWestEast = LaneSet::from_bits(0b000'111'000'111);
inline constexpr LaneSet kSouthNorth = LaneSet::from_bits(0b111'000'111'000);

}  // namespace lukou::test
