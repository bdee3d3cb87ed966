#pragma once

#include <vector>

#include "services/rsu/algorithms/stages.hpp"
#include "services/rsu/sdk/rsu_algorithm.hpp"
#include "services/rsu/sdk/seen_cars.hpp"

namespace lukou {

struct MaxPressureParameters {
  Staging staging = Staging::kAxes;
  double distance_m = 100.0;
  double decision_s = 1.0;
  double hysteresis_veh = 2.0;
};

/// Max pressure: green for the stage with the most cars within `distance_m`, if they are more than `hysteresis_veh`
/// more than those of the stage that has it, or if that has none. The exits of an isolated intersection are free, so
/// the pressure of a lane is the number of its cars.
/// Source: Varaiya 2013, "Max pressure control of a network of signalized intersections".
class MaxPressure final : public RsuAlgorithm {
 public:
  explicit MaxPressure(const MaxPressureParameters& parameters);

  void on_step(const RsuView& heard, RsuAnswer& answer) override;

 private:
  [[nodiscard]] double pressure(const RsuView& heard, LaneSet lanes);

  MaxPressureParameters parameters_;
  StageControl control_;
  std::vector<SeenCar> cars_;
};

}  // namespace lukou
