#pragma once

#include <array>
#include <vector>

#include "services/rsu/algorithms/approach_advice.hpp"
#include "services/rsu/sdk/rsu_algorithm.hpp"

namespace lukou {

struct SpeedHarmonisationParameters {
  ApproachRules approach{.activation_distance_m = 200.0};
  QueueRules queue;
  double speed_change_mps2 = 5.0 / 3.6;  ///< at which the advised speed of a lane may change
};

/// One speed for all cars of a lane that are heard: the least of the even speeds at which each would reach the line at
/// its crossing time, which holds for the light, the queue and the car ahead. It changes slowly. Cars that cross in the
/// green that shows are left alone.
/// Source: speed harmonisation by lane coordination, as T/CSAE 157 describes the service.
class SpeedHarmonisation final : public RsuAlgorithm {
 public:
  explicit SpeedHarmonisation(const SpeedHarmonisationParameters& parameters);

  void on_step(const RsuView& heard, RsuAnswer& answer) override;

  /// The speed that the lane was last given; the limit before the first step.
  [[nodiscard]] double lane_speed_mps(Lane lane) const { return lane_speed_mps_[index(lane)]; }

 private:
  void guide_lane(const RsuView& heard, const LaneView& lane, double& lane_speed_mps, RsuAnswer& answer);

  SpeedHarmonisationParameters parameters_;
  ApproachAdvice advice_;
  std::array<double, kLanes> lane_speed_mps_;
  std::vector<Crossing> plan_;
};

}  // namespace lukou
