#pragma once

#include <vector>

#include "common/bus/batches.hpp"
#include "services/traffic_engine/model/engine.hpp"
#include "services/traffic_engine/model/roadside_sensors.hpp"
#include "services/traffic_engine/model/unit_errors.hpp"

namespace lukou {

/// Appends the BSM of every equipped car at t_k, as its unit believes. The antenna on the envelope is the true one.
void say_safety_messages(const traffic::Engine& engine, traffic::UnitErrors& errors, Step k, Frames& frames);

/// Overwrites `sensed` with what the sensors deliver.
void report_sensed(const std::vector<traffic::Detection>& detections, SensedColumns& sensed);

}  // namespace lukou
