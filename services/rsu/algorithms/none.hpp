#pragma once

#include "services/rsu/sdk/rsu_algorithm.hpp"

namespace lukou {

/// Advises nobody: the RSU says its SPAT and MAP, and every car drives on its own.
class NoGuidance final : public RsuAlgorithm {
 public:
  void on_step(const RsuView& /*heard*/, RsuAnswer& /*answer*/) override {}
};

}  // namespace lukou
