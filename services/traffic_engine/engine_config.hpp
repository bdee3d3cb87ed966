#pragma once

#include <vector>

#include "common/core/expected.hpp"
#include "common/radio/link_model.hpp"
#include "services/traffic_engine/model/parameters.hpp"
#include "services/traffic_engine/model/roadside_sensors.hpp"
#include "services/traffic_engine/model/unit_errors.hpp"

namespace lukou {

namespace scenario {
class Resolved;
}

/// What the traffic engine takes from a scenario.
struct EngineConfig {
  traffic::EngineParameters traffic;
  RadioParameters radio;
  traffic::UnitErrorParameters unit_errors;
  std::vector<traffic::SensorParameters> sensors;  ///< of all RSUs, in the order of the scenario
  std::vector<bool> rsu_measured;                  ///< by RSU: its computing time is measured
  bool record_frames = false;                      ///< the record holds all that is said and sensed
};

/// Reads it, traces of arrivals included. Refuses values that are each in range but do not go together.
Expected<EngineConfig> engine_config(const scenario::Resolved& scenario);

}  // namespace lukou
