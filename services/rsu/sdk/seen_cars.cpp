#include "services/rsu/sdk/seen_cars.hpp"

#include <algorithm>

namespace lukou {
namespace {

constexpr double kSameCar_m = 3.0;

}  // namespace

void seen_cars(const LaneView& lane, std::vector<SeenCar>& cars) {
  cars.clear();
  for (const SensedCar& car : lane.sensed) cars.push_back({car.distance_m, car.speed_mps});
  for (const HeardCar& car : lane.cars) cars.push_back({car.distance_m, car.speed_mps});
  std::ranges::stable_sort(cars, {}, &SeenCar::distance_m);
  const auto same = [](const SeenCar& kept, const SeenCar& next) {
    return next.distance_m - kept.distance_m < kSameCar_m;
  };
  const auto [first_again, end] = std::ranges::unique(cars, same);
  cars.erase(first_again, end);
}

}  // namespace lukou
