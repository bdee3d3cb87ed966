#include "common/scenario/scenario.hpp"
#include "common/scenario/wording.hpp"
#include "scenario.pb.h"

namespace lukou::scenario {

std::vector<std::string> sensor_lines(const Resolved& resolved) {
  std::vector<std::string> lines;
  const Scenario& scenario = resolved.message();
  for (int r = 0; r < scenario.rsus_size(); ++r) {
    for (int s = 0; s < scenario.rsus(r).sensors_size(); ++s) {
      const Sensor& sensor = scenario.rsus(r).sensors(s);
      lines.push_back("rsus[" + std::to_string(r) + "].sensors[" + std::to_string(s) +
                      "]: " + Sensor::Kind_Name(sensor.kind()) + ", " + Sensor::Approach_Name(sensor.approach()) +
                      ", " + number_text(sensor.from_m()) + " to " + number_text(sensor.to_m()) +
                      " m before the line; misses " + number_text(100.0 * sensor.miss_rate()) + " %, errs by " +
                      number_text(sensor.position_noise_m()) + " m and " + number_text(sensor.speed_noise_mps()) +
                      " m/s, late by " + number_text(sensor.latency_ms()) + " ms");
    }
  }
  return lines;
}

}  // namespace lukou::scenario
