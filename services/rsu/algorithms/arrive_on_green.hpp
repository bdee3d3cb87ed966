#pragma once

#include <optional>

#include "services/rsu/algorithms/approach_time.hpp"
#include "services/rsu/algorithms/guided_cars.hpp"
#include "services/rsu/sdk/rsu_algorithm.hpp"

namespace lukou {

/// Source of all defaults: the guidance study. The scenario says what each is.
struct ArriveOnGreenParameters {
  double acceleration_max_mps2 = 3.0;  ///< of every car, both signs
  double headway_s = 1.98;
  double first_crossing_s = 0.6;
  double tail_s = 2.5;
  double slack_s = 1.0;
  double target_speed_share = 0.9;
  SpeedRates rates;
  double speed_min_mps = 3.0;
  double gain_time_s = 2.0;
  double first_speed_mps = 6.4;
  double speed_ramp_mps2 = 2.0;
  double lifetime_s = 0.5;
};

/// Lets cars reach the stop line when their turn to cross comes, at speed, in place of standing before a red light.
/// In each lane, front to back, it gives every heard car the earliest time at which it can cross: not before it can be
/// there, a headway after the car before, and in a green. A car that would be too early is slowed; a car that makes it
/// is left alone. Cars without an on-board unit are not guessed: advice is bound by FOLLOWING.
class ArriveOnGreen final : public RsuAlgorithm {
 public:
  explicit ArriveOnGreen(const ArriveOnGreenParameters& parameters);

  void on_step(const RsuView& heard, RsuAnswer& answer) override;

 private:
  void guide_lane(const RsuView& heard, const LaneView& lane, RsuAnswer& answer);
  /// The acceleration that brings the car to the line in `time_to_line_s`; empty = it is late already.
  [[nodiscard]] std::optional<double> acceleration_for(const HeardCar& car, double final_mps,
                                                       double time_to_line_s) const;

  ArriveOnGreenParameters parameters_;
  double go_mps2_;  ///< the largest acceleration that a message can carry and every car can take
  GuidedCars cars_;
};

}  // namespace lukou
