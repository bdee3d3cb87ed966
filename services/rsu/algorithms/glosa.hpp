#pragma once

#include <optional>
#include <vector>

#include "services/rsu/algorithms/approach_advice.hpp"
#include "services/rsu/sdk/rsu_algorithm.hpp"

namespace lukou {

struct GlosaParameters {
  ApproachRules approach;
  std::optional<QueueRules> queue;  ///< empty: `glosa`, each car as if it were alone; given: `glosa_queue`
};

/// Green light optimal speed advice: each car that is heard is brought to the even speed d / t that takes it to the
/// line when it can cross. Source: the common form of GLOSA, for example SUMO's device of that name.
class Glosa final : public RsuAlgorithm {
 public:
  explicit Glosa(const GlosaParameters& parameters);

  void on_step(const RsuView& heard, RsuAnswer& answer) override;

 private:
  GlosaParameters parameters_;
  ApproachAdvice advice_;
  std::vector<Crossing> plan_;
};

}  // namespace lukou
