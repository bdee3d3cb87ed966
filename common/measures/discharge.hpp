#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace lukou {

/// A car at the stop line of one lane.
struct LineCrossing {
  double at_s = 0.0;
  bool stood = false;  ///< it has stood before the line
};

/// The headways of one place in the discharging queue, over all greens.
struct PlaceHeadways {
  std::uint64_t headways = 0;
  double sum_s = 0.0;
  double sum_of_squares_s2 = 0.0;

  void add(double headway_s);
  PlaceHeadways& operator+=(const PlaceHeadways& other);
  /// Requires at least one headway.
  [[nodiscard]] double mean_s() const;
  /// Sample standard deviation [s]; 0 of a single headway.
  [[nodiscard]] double deviation_s() const;
};

/// How queues discharge at a stop line: headways by place in the queue. The first one counts from the green's begin to
/// the first car's crossing, each other from the crossing before. A queue ends with the first car that has not stood.
/// Source: Highway Capacity Manual, saturation flow from the fifth place on.
class Discharge {
 public:
  /// The place from which on the flow is saturated, from 1.
  static constexpr std::size_t kSaturatedFrom = 5;

  /// Adds the crossings of one lane in their order. `greens_s`: when its greens began, rising.
  void add(std::span<const LineCrossing> crossings, std::span<const double> greens_s);

  /// By place, the first at [0].
  [[nodiscard]] const std::vector<PlaceHeadways>& places() const { return places_; }
  /// All headways from kSaturatedFrom on.
  [[nodiscard]] PlaceHeadways saturated() const;
  /// Mean headway in saturation [s]; empty: no queue was so long.
  [[nodiscard]] std::optional<double> saturation_headway_s() const;
  /// Start-up lost time [s]: what the places before kSaturatedFrom take longer than in saturation, together.
  [[nodiscard]] std::optional<double> lost_time_s() const;

 private:
  std::vector<PlaceHeadways> places_;
};

}  // namespace lukou
