#pragma once

#include <vector>

#include "services/rsu/algorithms/approach_advice.hpp"
#include "services/rsu/sdk/rsu_algorithm.hpp"

namespace lukou {

struct PlatoonParameters {
  ApproachRules approach;
  QueueRules queue;             ///< its headway is also that of a platoon's cars at the line
  double gap_s = 3.0;           ///< to the heard car ahead, at most, within a platoon
  double end_speed_mps = 10.0;  ///< at the line
};

/// Lets groups of heard cars cross together. In each lane, front to back, cars with small gaps form a platoon, as long
/// as the same green takes them: what does not fit is a platoon of its own, for the next. The leader decides for all:
/// whether they are near enough, and whether they are early. If they are, all drive the smoothest arrival to one speed
/// at the line, the leader at its crossing time, the others a headway apart behind it, or as soon as they can be there.
/// A car without a unit inside a platoon is not seen: advice is bound by FOLLOWING.
/// Source: platoon entering as in the literature on vehicle-road cooperation; arrivals as in `eco`.
class Platoon final : public RsuAlgorithm {
 public:
  explicit Platoon(const PlatoonParameters& parameters);

  void on_step(const RsuView& heard, RsuAnswer& answer) override;

 private:
  void guide_lane(const RsuView& heard, const LaneView& lane, RsuAnswer& answer);
  /// Whether car number `i` of the lane, which is planned, belongs to the platoon of the car before it.
  [[nodiscard]] bool follows(const LaneView& lane, std::size_t i) const;

  PlatoonParameters parameters_;
  ApproachAdvice advice_;
  std::vector<Crossing> plan_;
};

}  // namespace lukou
