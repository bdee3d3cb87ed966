#pragma once

#include "common/core/expected.hpp"
#include "common/radio/link_model.hpp"
#include "services/traffic_engine/model/parameters.hpp"

namespace lukou {

namespace scenario {
class Resolved;
}

/// What the traffic engine takes from a scenario.
struct EngineConfig {
  traffic::EngineParameters traffic;
  RadioParameters radio;
};

/// Reads it, traces of arrivals included. Refuses values that are each in range but do not go together.
Expected<EngineConfig> engine_config(const scenario::Resolved& scenario);

}  // namespace lukou
