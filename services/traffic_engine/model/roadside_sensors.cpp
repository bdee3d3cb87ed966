#include "services/traffic_engine/model/roadside_sensors.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

#include "common/core/contract.hpp"
#include "common/core/keyed_random.hpp"
#include "common/core/math.hpp"

namespace lukou::traffic {
namespace {

constexpr double kAcrossShare = 0.1;  // of the noise along the lane; assumed

DrawKey key_of(std::uint64_t seed, Purpose purpose, const SensorParameters& sensor, std::uint32_t vehicle, Step step) {
  const std::uint64_t number = (std::uint64_t{sensor.rsu} << 16U) | sensor.sensor;
  return {.run_seed = seed,
          .purpose = purpose,
          .entity = vehicle,
          .index = (number << 32U) | static_cast<std::uint64_t>(step)};
}

}  // namespace

RoadsideSensors::RoadsideSensors(std::uint64_t seed, std::vector<SensorParameters> sensors)
    : seed_(seed), sensors_(std::move(sensors)) {
  for (const SensorParameters& sensor : sensors_) LUKOU_EXPECT(sensor.rsu < 65'536 && sensor.sensor < 65'536);
}

void RoadsideSensors::use(std::vector<SensorParameters> sensors) {
  LUKOU_EXPECT(sensors.size() == sensors_.size());
  sensors_ = std::move(sensors);
}

const std::vector<Detection>& RoadsideSensors::look(Step step, const Engine& engine) {
  delivered_.clear();
  for (const SensorParameters& sensor : sensors_) look_through(sensor, step, engine);
  std::erase_if(underway_, [&](const Underway& item) {
    if (item.due > step) return false;
    delivered_.push_back(item.detection);
    return true;
  });
  std::ranges::sort(delivered_, {}, [](const Detection& detection) {
    return std::tuple(detection.rsu, detection.sensor, detection.measured, detection.track, detection.x_m,
                      detection.y_m);
  });
  return delivered_;
}

void RoadsideSensors::look_through(const SensorParameters& sensor, Step step, const Engine& engine) {
  const RoadLengths& road = engine.parameters().road;
  const Step due = step + step_at_or_after(sensor.latency_ms / 1000.0);
  for (const Turn turn : {Turn::kLeft, Turn::kCenter, Turn::kRight}) {
    const Lane lane = lane_of(sensor.approach, turn);
    for (const Car& car : engine.lane(lane).cars()) {
      const double distance_m = road.approach_m - car.motion.position_m;
      if (distance_m < sensor.from_m) continue;
      if (distance_m > sensor.to_m) break;  // front to back: the others are farther away
      if (uniform01(key_of(seed_, Purpose::kSensorMiss, sensor, car.vehicle, step)) < sensor.miss_rate) continue;
      const Pose front = pose_on_path(road, lane, car.motion.position_m);
      Detection seen = detected(sensor, step, car, front);
      seen.length_m = engine.parameters().vehicles.length_m;
      underway_.push_back({due, seen});
    }
  }
}

Detection RoadsideSensors::detected(const SensorParameters& sensor, Step step, const Car& car,
                                    const Pose& front) const {
  const auto error = [&](Purpose purpose, double deviation) {
    return deviation > 0.0 ? deviation * standard_normal(key_of(seed_, purpose, sensor, car.vehicle, step)) : 0.0;
  };
  const double along_m = error(Purpose::kSensorAlong, sensor.position_noise_m);
  const double across_m = error(Purpose::kSensorAcross, kAcrossShare * sensor.position_noise_m);
  const double east = math::sin(front.heading_rad);
  const double north = math::cos(front.heading_rad);
  const auto track =
      static_cast<std::uint32_t>(random_bits(key_of(seed_, Purpose::kSensorTrack, sensor, car.vehicle, 0)));
  return {.rsu = sensor.rsu,
          .sensor = sensor.sensor,
          .track = track,
          .x_m = front.x_m + along_m * east + across_m * north,
          .y_m = front.y_m + along_m * north - across_m * east,
          .speed_mps = std::max(0.0, car.motion.speed_mps + error(Purpose::kSensorSpeed, sensor.speed_noise_mps)),
          .heading_rad = front.heading_rad,
          .length_m = 0.0,
          .measured = step};
}

}  // namespace lukou::traffic
