#pragma once

#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "common/core/expected.hpp"
#include "services/rsu/algorithms/actuated.hpp"
#include "services/rsu/algorithms/arrive_on_green.hpp"
#include "services/rsu/algorithms/cv_phase.hpp"
#include "services/rsu/algorithms/eco.hpp"
#include "services/rsu/algorithms/glosa.hpp"
#include "services/rsu/algorithms/max_pressure.hpp"
#include "services/rsu/algorithms/platoon.hpp"
#include "services/rsu/algorithms/speed_harmonisation.hpp"
#include "services/rsu/sdk/rsu_algorithm.hpp"

namespace lukou {

/// The parameters of every algorithm that ships with Lukou.
struct AlgorithmParameters {
  ActuatedParameters actuated;
  ArriveOnGreenParameters arrive_on_green;
  CvPhaseParameters cv_phase;
  EcoParameters eco;
  GlosaParameters glosa;
  GlosaParameters glosa_queue{.approach = {}, .queue = QueueRules{}};
  MaxPressureParameters max_pressure;
  PlatoonParameters platoon;
  SpeedHarmonisationParameters speed_harmonisation;
};

/// An algorithm in a line each; docs/algorithms.md says more.
struct AlgorithmDoc {
  std::string_view name;
  std::string_view what;
  std::string_view source;
};
/// In the order of the alphabet.
std::span<const AlgorithmDoc> algorithm_docs();

/// Names of the algorithms, in the order of the alphabet.
std::vector<std::string_view> algorithm_names();

/// Makes the algorithm of that name; for an unknown one the error says which exist, and the nearest.
Expected<std::unique_ptr<RsuAlgorithm>> make_algorithm(std::string_view name, const AlgorithmParameters& parameters);

}  // namespace lukou
