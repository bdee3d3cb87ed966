#include "services/rsu/model/sensed_cars.hpp"

#include <algorithm>
#include <tuple>

#include "common/core/contract.hpp"
#include "services/rsu/model/map_matching.hpp"

namespace lukou {
namespace {

constexpr Step kForgetAfter = kStepsPerSecond;
constexpr std::size_t kNumbers = 65'535;

}  // namespace

void SensedCars::begin(Step now) {
  now_ = now;
  readings_.clear();
  std::erase_if(tracks_, [now](const Track& track) { return now - track.taken > kForgetAfter; });
}

void SensedCars::take(const SensorReading& reading) {
  const std::uint16_t number = number_of(reading);
  const auto same = std::ranges::find(readings_, number, &NumberedReading::number);
  if (same == readings_.end()) {
    readings_.push_back({reading, number});
  } else if (reading.seen > same->reading.seen) {
    same->reading = reading;
  }
}

void SensedCars::arrange() {
  std::ranges::sort(readings_, {}, &NumberedReading::number);
  for (auto& lane : by_lane_) lane.clear();
  for (const NumberedReading& item : readings_) {
    const SensorReading& reading = item.reading;
    // Without a length the point that is matched stands for the front.
    const auto place = match_to_map(road_, {.centre_x_m = reading.front_x_m,
                                            .centre_y_m = reading.front_y_m,
                                            .heading_rad = reading.heading_rad,
                                            .length_m = 0.0});
    if (!place || place->distance_m <= 0.0) continue;
    by_lane_[index(place->lane)].push_back({.sensor = reading.sensor,
                                            .track = reading.track,
                                            .lane = place->lane,
                                            .distance_m = place->distance_m,
                                            .speed_mps = reading.speed_mps,
                                            .age = now_ - reading.seen});
  }
  for (auto& lane : by_lane_) {
    std::ranges::sort(lane, {}, [](const SensedCar& car) { return std::tuple(car.distance_m, car.sensor, car.track); });
  }
}

std::uint16_t SensedCars::number_of(const SensorReading& reading) {
  const auto key = [](const Track& track) { return std::tuple(track.sensor, track.track); };
  const auto at = std::ranges::lower_bound(tracks_, std::tuple(reading.sensor, reading.track), {}, key);
  if (at != tracks_.end() && key(*at) == std::tuple(reading.sensor, reading.track)) {
    at->taken = now_;
    return at->number;
  }
  const std::uint16_t number = free_number();
  tracks_.insert(at, {reading.sensor, reading.track, number, now_});
  return number;
}

std::uint16_t SensedCars::free_number() {
  LUKOU_EXPECT(tracks_.size() < kNumbers);
  do {
    last_number_ = last_number_ == kNumbers ? std::uint16_t{1} : static_cast<std::uint16_t>(last_number_ + 1);
  } while (std::ranges::find(tracks_, last_number_, &Track::number) != tracks_.end());
  return last_number_;
}

}  // namespace lukou
