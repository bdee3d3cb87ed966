#include "services/rsu/algorithms/guided_cars.hpp"

#include <algorithm>

namespace lukou {

GuidedCars::GuidedCars(double lifetime_s) : lifetime_(std::max<Step>(1, step_at_or_after(lifetime_s))) {}

void GuidedCars::advise(const HeardCar& car, double acceleration_mps2, RsuAnswer& answer) {
  answer.advise(car.id,
                {.acceleration_mps2 = acceleration_mps2, .lifetime = lifetime_, .binding = Binding::kFollowing});
  advised_now_.push_back(car.id);
}

void GuidedCars::release(const HeardCar& car, RsuAnswer& answer) const {
  if (std::ranges::binary_search(advised_, car.id)) answer.release(car.id);
}

void GuidedCars::end_step() {
  std::ranges::sort(advised_now_);
  std::swap(advised_, advised_now_);
  advised_now_.clear();
}

}  // namespace lukou
