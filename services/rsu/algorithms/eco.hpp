#pragma once

#include <optional>
#include <vector>

#include "services/rsu/algorithms/approach_advice.hpp"
#include "services/rsu/sdk/rsu_algorithm.hpp"

namespace lukou {

struct EcoParameters {
  ApproachRules approach;
  QueueRules queue;
  std::optional<double> end_speed_mps;  ///< at the line; empty = free
};

/// Eco-approach: each car that is heard drives the arrival with the least integral of a^2, planned anew in every step.
/// Source: closed form of the minimum-acceleration problem; crossing times as in `glosa_queue`.
class Eco final : public RsuAlgorithm {
 public:
  explicit Eco(const EcoParameters& parameters);

  void on_step(const RsuView& heard, RsuAnswer& answer) override;

 private:
  EcoParameters parameters_;
  ApproachAdvice advice_;
  std::vector<Crossing> plan_;
};

}  // namespace lukou
