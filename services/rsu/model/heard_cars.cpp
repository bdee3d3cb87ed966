#include "services/rsu/model/heard_cars.hpp"

#include <algorithm>
#include <tuple>

namespace lukou {
namespace {

constexpr Step kForgetAfter = kStepsPerSecond;
constexpr double kHardest_mps2 = 10.0;  // no car speeds up more than this
constexpr double kTolerance_m = 10.0;   // of two positions; assumed

/// Whether a car can have come to its stop line between two of its reports.
bool can_have_crossed(const CarReport& before, double distance_m, Step made) {
  const double elapsed_s = time_s(made - before.made);
  return distance_m <= (before.speed_mps + 0.5 * kHardest_mps2 * elapsed_s) * elapsed_s + kTolerance_m;
}

}  // namespace

void HeardCars::hear(const CarReport& report) {
  const auto known = std::ranges::lower_bound(entries_, report.id, {}, [](const Entry& e) { return e.report.id; });
  const bool is_known = known != entries_.end() && known->report.id == report.id;
  if (is_known && report.made <= known->report.made) return;
  const std::optional<ApproachPlace> place = match_to_map(road_, report.place);
  if (place && place->distance_m > 0.0) {
    if (is_known) {
      *known = {report, *place};
    } else {
      entries_.insert(known, {report, *place});
    }
  } else if (is_known) {
    if (can_have_crossed(known->report, known->place.distance_m, report.made)) note_crossing(*known, report, place);
    entries_.erase(known);
  }
}

void HeardCars::note_crossing(const Entry& before, const CarReport& report,
                              const std::optional<ApproachPlace>& beyond) {
  double crossed_s = time_s(report.made);
  if (beyond && beyond->lane == before.place.lane) {
    const double from_s = time_s(before.report.made);
    const double share = before.place.distance_m / (before.place.distance_m - beyond->distance_m);
    crossed_s = from_s + (crossed_s - from_s) * share;
  }
  std::optional<double>& last_s = last_crossing_s_[index(before.place.lane)];
  if (!last_s || crossed_s > *last_s) last_s = crossed_s;
}

void HeardCars::arrange(Step now) {
  std::erase_if(entries_, [now](const Entry& entry) { return now - entry.report.made > kForgetAfter; });
  for (auto& lane : by_lane_) lane.clear();
  for (const Entry& entry : entries_) {
    by_lane_[index(entry.place.lane)].push_back({.id = entry.report.id,
                                                 .lane = entry.place.lane,
                                                 .distance_m = entry.place.distance_m,
                                                 .speed_mps = entry.report.speed_mps,
                                                 .acceleration_mps2 = entry.report.acceleration_mps2,
                                                 .age = std::max<Step>(0, now - entry.report.made),
                                                 .accuracy_m = entry.report.accuracy_m});
  }
  for (auto& lane : by_lane_) {
    std::ranges::sort(lane, {}, [](const HeardCar& car) { return std::tuple(car.distance_m, car.id); });
  }
}

const CarReport* HeardCars::report(TemporaryId id) const {
  const auto known = std::ranges::lower_bound(entries_, id, {}, [](const Entry& e) { return e.report.id; });
  return known != entries_.end() && known->report.id == id ? &known->report : nullptr;
}

}  // namespace lukou
