#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "services/rsu/model/map_matching.hpp"
#include "services/rsu/sdk/rsu_view.hpp"

namespace lukou {

/// What one message says of a car.
struct CarReport {
  TemporaryId id{};
  Step made = 0;  ///< when it was made; later than now if the car's clock is ahead
  ReportedPlace place;
  double speed_mps = 0.0;
  double acceleration_mps2 = 0.0;
  std::optional<double> accuracy_m;  ///< of the place, one standard deviation
};

/// The cars on the approaches as their messages tell, and when they crossed their stop lines.
class HeardCars {
 public:
  explicit HeardCars(const RoadLengths& road) : road_(road) {}

  /// Takes a report. One that is not newer than the car's last changes nothing; one off the approaches ends the car's
  /// place here, as a crossing if it can have come to its stop line since its last report: a position far off the road
  /// is an error, not a crossing.
  void hear(const CarReport& report);
  /// Forgets cars unheard for more than a second and puts the rest in order; the views below speak of `now`.
  void arrange(Step now);

  /// The lane's cars front to back, equal distances by id.
  [[nodiscard]] std::span<const HeardCar> cars(Lane lane) const { return by_lane_[index(lane)]; }
  /// When a car last crossed the lane's stop line, between two reports by their distances.
  [[nodiscard]] std::optional<double> last_crossing_s(Lane lane) const { return last_crossing_s_[index(lane)]; }
  /// The last report of a car on an approach; nullptr without one. Valid until the next report.
  [[nodiscard]] const CarReport* report(TemporaryId id) const;

 private:
  struct Entry {
    CarReport report;
    ApproachPlace place;
  };

  void note_crossing(const Entry& before, const CarReport& report, const std::optional<ApproachPlace>& beyond);

  RoadLengths road_;
  std::vector<Entry> entries_;  ///< by id
  std::array<std::vector<HeardCar>, kLanes> by_lane_;
  std::array<std::optional<double>, kLanes> last_crossing_s_;
};

}  // namespace lukou
