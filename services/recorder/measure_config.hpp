#pragma once

#include <vector>

#include "common/measures/run_measures.hpp"
#include "common/run_log/run_log.hpp"
#include "common/scenario/scenario.hpp"

namespace lukou {

/// What the recorder takes from a scenario.
struct RecorderConfig {
  MeasureParameters measures;
  bool stop_on_overflow = true;
  bool record_stops = true;
  bool record_guidance = false;
  bool record_safety = true;
  run_log::Level log = run_log::Level::kNone;
  bool actuated = false;  ///< the controller hears requests for greens
  std::uint64_t seed = 0;
  Step end = 0;
  std::vector<bool> rsu_measured;  ///< by RSU: its computing time is measured
};
RecorderConfig recorder_config(const scenario::Resolved& scenario);

}  // namespace lukou
