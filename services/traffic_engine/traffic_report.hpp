#pragma once

#include "common/bus/batches.hpp"
#include "services/traffic_engine/model/engine.hpp"

namespace lukou {

/// Writes the engine's state at t_step and what happened in the step into the batch, which it clears first.
/// `heard_epoch` stays empty: it is the node's to say.
void report(const traffic::Engine& engine, Step step, TrafficBatch& batch);

}  // namespace lukou
