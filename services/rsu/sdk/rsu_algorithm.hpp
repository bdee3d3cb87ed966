#pragma once

#include "services/rsu/sdk/rsu_answer.hpp"
#include "services/rsu/sdk/rsu_view.hpp"

namespace lukou {

/// What a researcher writes: the mind of an RSU. One object lives as long as its RSU; it may keep a state of its own.
/// A result must not depend on anything but the views so far: no clock, no random device, no order of addresses.
class RsuAlgorithm {
 public:
  RsuAlgorithm() = default;
  RsuAlgorithm(const RsuAlgorithm&) = delete;
  RsuAlgorithm& operator=(const RsuAlgorithm&) = delete;
  virtual ~RsuAlgorithm() = default;

  /// Called once per step with what this RSU has heard by now; answers with advice.
  /// Both arguments are valid during the call only.
  virtual void on_step(const RsuView& heard, RsuAnswer& answer) = 0;
};

}  // namespace lukou
