#pragma once

#include <vector>

#include "common/bus/batches.hpp"
#include "services/traffic_engine/model/engine.hpp"
#include "services/traffic_engine/model/roadside_sensors.hpp"
#include "services/traffic_engine/model/unit_errors.hpp"

namespace lukou {

/// Appends the BSM of every equipped car at t_k, as its unit believes. The antenna on the envelope is the true one.
/// `speakers` is overwritten with the vehicles, in the order of their frames.
void say_safety_messages(const traffic::Engine& engine, traffic::UnitErrors& errors, Step k, Frames& frames,
                         std::vector<std::uint32_t>& speakers);

/// Overwrites `sensed` with what the sensors deliver.
void report_sensed(const std::vector<traffic::Detection>& detections, SensedColumns& sensed);

}  // namespace lukou
