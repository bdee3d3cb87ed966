#pragma once

#include <cstdint>
#include <vector>

#include "services/traffic_engine/model/engine.hpp"

namespace lukou::traffic {

/// A roadside sensor: which cars it looks at, and how well.
struct SensorParameters {
  std::uint32_t rsu = 0;     ///< index in the scenario's list, < 65536
  std::uint32_t sensor = 0;  ///< index in that RSU's list, < 65536
  Approach approach = Approach::kWest;
  double from_m = 0.0;            ///< of a car's front before the stop line, >= 0
  double to_m = 150.0;            ///< > from_m
  double miss_rate = 0.0;         ///< per car and step, [0, 1)
  double position_noise_m = 0.0;  ///< standard deviation along the lane; across it a tenth (assumed)
  double speed_noise_mps = 0.0;   ///< standard deviation
  double latency_ms = 0.0;        ///< delivered at the first step not before
};

/// A car as a sensor tells of it: no vehicle, no unit, no lane.
struct Detection {
  std::uint32_t rsu = 0;
  std::uint32_t sensor = 0;
  std::uint32_t track = 0;  ///< drawn from vehicle and sensor: it says nothing but "the same as before"
  double x_m = 0.0;         ///< front of the car
  double y_m = 0.0;
  double speed_mps = 0.0;  ///< >= 0
  double heading_rad = 0.0;
  double length_m = 0.0;
  Step measured = 0;
};

/// All sensors of the roadside. Errors are white: each step draws anew. A draw depends on seed, sensor, vehicle and
/// step alone. A car in the zones of two sensors is seen by both.
class RoadsideSensors {
 public:
  RoadsideSensors(std::uint64_t seed, std::vector<SensorParameters> sensors);

  /// Takes over what the sensors see from the next step on; what they saw comes when it was to come. Requires the same
  /// sensors in the same order.
  void use(std::vector<SensorParameters> sensors);
  /// Looks at the road at t_step and gives what the sensors deliver then, in the order of RSU, sensor, measured step,
  /// track. Valid until the next call. Requires ascending steps.
  const std::vector<Detection>& look(Step step, const Engine& engine);

 private:
  struct Underway {
    Step due = 0;
    Detection detection;
  };

  void look_through(const SensorParameters& sensor, Step step, const Engine& engine);
  [[nodiscard]] Detection detected(const SensorParameters& sensor, Step step, const Car& car, const Pose& front) const;

  std::uint64_t seed_;
  std::vector<SensorParameters> sensors_;
  std::vector<Underway> underway_;
  std::vector<Detection> delivered_;
};

}  // namespace lukou::traffic
