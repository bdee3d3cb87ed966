#pragma once

#include "services/rsu/process/run_rsu.hpp"
#include "services/rsu/rsu_config.hpp"

namespace lukou {

/// What the algorithm of this RSU gets to know before its first step.
RsuSetup setup_of(const RsuConfig& config);

}  // namespace lukou
