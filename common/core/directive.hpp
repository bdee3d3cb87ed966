#pragma once

#include <cstdint>
#include <string>

#include "common/core/step.hpp"

namespace lukou {

/// An operator's change that everybody applies at the start of step `step`.
struct Directive {
  Step step = 0;
  std::string set;  ///< "path=value" in the scenario
};

/// How long an RSU was measured to compute. What it answered in `step` is delayed by this.
struct ComputingDelay {
  std::uint32_t rsu = 0;
  Step step = 0;
  std::uint32_t delay_ms = 0;
};

}  // namespace lukou
