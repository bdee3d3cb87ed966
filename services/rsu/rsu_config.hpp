#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/core/expected.hpp"
#include "common/intersection/actuation.hpp"
#include "common/intersection/geometry.hpp"
#include "common/messages/plane.hpp"
#include "common/radio/link_model.hpp"
#include "services/rsu/algorithms/registry.hpp"

namespace lukou {

namespace scenario {
class Scenario;
}

/// What an RSU knows of a sensor of its own.
struct RsuSensor {
  bool radar = false;       ///< false: a camera
  double accuracy_m = 0.0;  ///< standard deviation of a position, from its data sheet
};

/// What the time that the algorithm takes does to what it answers.
struct ComputingTime {
  bool measured = false;          ///< on_step is measured
  std::uint32_t declared_ms = 0;  ///< else this long; 0 = free
};

/// All that one RSU needs to know before a run.
struct RsuConfig {
  std::uint32_t rsu = 0;         ///< index in the scenario's list
  std::uint64_t station_id = 0;  ///< sender of its frames
  PlanePoint antenna;            ///< at the centre of the junction; assumed
  RadioParameters radio;
  RoadLengths road;
  double speed_limit_mps = 0.0;
  double acceleration_max_mps2 = 0.0;  ///< of every car
  Step signal_promise = 10;            ///< steps: how far ahead the controller decides
  std::optional<Actuation> actuation;  ///< empty: the controller runs a fixed plan
  std::string algorithm;
  AlgorithmParameters parameters;
  std::vector<RsuSensor> sensors;  ///< in the order of the scenario
  ComputingTime computing;
};

/// What an algorithm is told of the map.
MapView map_view(const RsuConfig& config);

/// The configuration of the scenario's RSU number `rsu`. The scenario is resolved: every field is present and valid.
/// Fails if there is no such RSU.
Expected<RsuConfig> rsu_config(const scenario::Scenario& scenario, std::uint32_t rsu);

}  // namespace lukou
