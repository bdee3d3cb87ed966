#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "common/intersection/geometry.hpp"
#include "services/rsu/sdk/rsu_view.hpp"

namespace lukou {

/// What a roadside sensor says of one car.
struct SensorReading {
  std::uint32_t sensor = 0;
  std::uint32_t track = 0;
  double front_x_m = 0.0;
  double front_y_m = 0.0;
  double speed_mps = 0.0;
  double heading_rad = 0.0;  ///< clockwise from north
  double length_m = 0.0;     ///< typical of its class
  Step seen = 0;
};

/// A reading under the number by which the RSU tells others of this car.
struct NumberedReading {
  SensorReading reading;
  std::uint16_t number = 0;  ///< [1, 65535]
};

/// What the sensors of an RSU delivered for one step, placed on the map and numbered.
class SensedCars {
 public:
  explicit SensedCars(const RoadLengths& road) : road_(road) {}

  /// Begins a step: forgets the readings of the last one.
  void begin(Step now);
  /// Takes a reading. Of two of one track the one seen later stands.
  void take(const SensorReading& reading);
  /// Ends the step: places the readings and puts them in order.
  void arrange();

  /// The lane's cars front to back, equal distances by sensor, then track.
  [[nodiscard]] std::span<const SensedCar> cars(Lane lane) const { return by_lane_[index(lane)]; }
  /// All readings of the step by number, those that are off the map included. A track keeps its number until it has
  /// been unseen for more than a second; numbers go round, and none is given to two tracks at a time.
  [[nodiscard]] std::span<const NumberedReading> readings() const { return readings_; }

 private:
  struct Track {
    std::uint32_t sensor = 0;
    std::uint32_t track = 0;
    std::uint16_t number = 0;
    Step taken = 0;
  };

  std::uint16_t number_of(const SensorReading& reading);
  [[nodiscard]] std::uint16_t free_number();

  RoadLengths road_;
  Step now_ = 0;
  std::vector<NumberedReading> readings_;
  std::vector<Track> tracks_;  ///< by sensor, then track
  std::uint16_t last_number_ = 0;
  std::array<std::vector<SensedCar>, kLanes> by_lane_;
};

}  // namespace lukou
