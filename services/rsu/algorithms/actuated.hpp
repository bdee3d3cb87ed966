#pragma once

#include <vector>

#include "services/rsu/algorithms/stages.hpp"
#include "services/rsu/sdk/rsu_algorithm.hpp"
#include "services/rsu/sdk/seen_cars.hpp"

namespace lukou {

struct ActuatedParameters {
  Staging staging = Staging::kAxes;
  double gap_s = 1.0;
  double detection_m = 15.0;
  double max_green_s = 60.0;
};

/// Actuated control: a stage stays green while cars keep coming within `detection_m` of its lines (gap-out), at most
/// `max_green_s` from the first car that waits elsewhere on (max-out); stages where nobody waits are left out.
/// Source: stop-line actuation as in the handbooks, for example FHWA's Signal Timing Manual.
class Actuated final : public RsuAlgorithm {
 public:
  explicit Actuated(const ActuatedParameters& parameters);

  void on_step(const RsuView& heard, RsuAnswer& answer) override;

 private:
  [[nodiscard]] bool has_cars(const RsuView& heard, LaneSet lanes);

  ActuatedParameters parameters_;
  StageControl control_;
  std::vector<SeenCar> cars_;
  Step served_ = 0;  ///< the last step with a car before the lines of the current stage
  Step called_ = 0;  ///< since when cars wait elsewhere
  bool calls_ = false;
};

}  // namespace lukou
