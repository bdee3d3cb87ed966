#include "services/traffic_engine/air_report.hpp"

#include "common/messages/bsm.hpp"
#include "common/messages/time_marks.hpp"

namespace lukou {
namespace {

constexpr std::uint32_t kMessageCounts = 128;  ///< a message count is modulo this
/// A car whose deceleration is at least this [m/s2] shows its brakes; assumed.
constexpr double kBrakePedal_mps2 = 0.5;
constexpr double kMediumLength_m = 6.0;
constexpr double kLongLength_m = 12.0;

LengthClass class_of(double length_m) {
  if (length_m < kMediumLength_m) return LengthClass::kShort;
  return length_m < kLongLength_m ? LengthClass::kMedium : LengthClass::kLong;
}

}  // namespace

void say_safety_messages(const traffic::Engine& engine, traffic::UnitErrors& errors, Step k, Frames& frames,
                         std::vector<std::uint32_t>& speakers) {
  speakers.clear();
  const traffic::EngineParameters& parameters = engine.parameters();
  const bool wrong = errors.any();
  BasicSafety message;
  message.second_mark_ms = second_mark_ms(k);
  message.length_m = parameters.vehicles.length_m;
  message.width_m = parameters.vehicles.width_m;
  message.accuracy_m = errors.accuracy_m();
  for (int i = 0; i < kLanes; ++i) {
    const auto lane = static_cast<Lane>(i);
    for (const traffic::Car& car : engine.lane(lane).cars()) {
      if (!car.equipped) continue;
      const Pose pose = pose_on_path(parameters.road, lane, car.motion.position_m);
      const PlanePoint centre = centre_of_car({pose.x_m, pose.y_m}, pose.heading_rad, message.length_m);
      const auto sequence = static_cast<std::uint32_t>(k - car.entered);
      message.temporary_id = car.temporary_id;
      message.count = static_cast<std::uint8_t>(sequence % kMessageCounts);
      message.centre = centre;
      if (wrong) {
        const traffic::UnitError error = errors.of(car.vehicle, k);
        message.centre = {centre.x_m + error.east_m, centre.y_m + error.north_m};
        message.second_mark_ms = second_mark_ms(k, error.clock_ms);
      }
      message.speed_mps = car.motion.speed_mps;
      message.heading_rad = pose.heading_rad;
      message.acceleration_mps2 = car.motion.acceleration_mps2;
      message.braking = car.motion.acceleration_mps2 <= -kBrakePedal_mps2;
      append(frames,
             {.sender = car.temporary_id, .sequence = sequence, .antenna_x_m = centre.x_m, .antenna_y_m = centre.y_m},
             message);
      speakers.push_back(car.vehicle);
    }
  }
  if (wrong) errors.forget_unseen(k);
}

void report_sensed(const std::vector<traffic::Detection>& detections, SensedColumns& sensed) {
  sensed.clear();
  for (const traffic::Detection& detection : detections) {
    sensed.rsu.push_back(detection.rsu);
    sensed.sensor.push_back(detection.sensor);
    sensed.track.push_back(detection.track);
    sensed.x_m.push_back(detection.x_m);
    sensed.y_m.push_back(detection.y_m);
    sensed.speed_mps.push_back(detection.speed_mps);
    sensed.heading_rad.push_back(detection.heading_rad);
    sensed.length_class.push_back(static_cast<std::uint8_t>(class_of(detection.length_m)));
    sensed.measured.push_back(detection.measured);
  }
}

}  // namespace lukou
