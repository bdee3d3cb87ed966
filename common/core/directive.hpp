#pragma once

#include <string>

#include "common/core/step.hpp"

namespace lukou {

/// An operator's change that everybody applies at the start of step `step`.
struct Directive {
  Step step = 0;
  std::string set;  ///< "path=value" in the scenario
};

}  // namespace lukou
