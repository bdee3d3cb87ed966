#include "common/measures/discharge.hpp"

#include <algorithm>
#include <cmath>

#include "common/core/contract.hpp"

namespace lukou {

void PlaceHeadways::add(double headway_s) {
  ++headways;
  sum_s += headway_s;
  sum_of_squares_s2 += headway_s * headway_s;
}

PlaceHeadways& PlaceHeadways::operator+=(const PlaceHeadways& other) {
  headways += other.headways;
  sum_s += other.sum_s;
  sum_of_squares_s2 += other.sum_of_squares_s2;
  return *this;
}

double PlaceHeadways::mean_s() const {
  LUKOU_EXPECT(headways > 0);
  return sum_s / static_cast<double>(headways);
}

double PlaceHeadways::deviation_s() const {
  if (headways < 2) return 0.0;
  const auto n = static_cast<double>(headways);
  return std::sqrt(std::max(0.0, (sum_of_squares_s2 - sum_s * sum_s / n) / (n - 1.0)));
}

void Discharge::add(std::span<const LineCrossing> crossings, std::span<const double> greens_s) {
  std::size_t next = 0;
  for (std::size_t green = 0; green < greens_s.size(); ++green) {
    while (next < crossings.size() && crossings[next].at_s < greens_s[green]) ++next;
    double before_s = greens_s[green];
    const bool last_green = green + 1 == greens_s.size();
    for (std::size_t place = 0; next < crossings.size() && crossings[next].stood; ++place, ++next) {
      if (!last_green && crossings[next].at_s >= greens_s[green + 1]) break;
      if (places_.size() <= place) places_.resize(place + 1);
      places_[place].add(crossings[next].at_s - before_s);
      before_s = crossings[next].at_s;
    }
  }
}

PlaceHeadways Discharge::saturated() const {
  PlaceHeadways all;
  for (std::size_t place = kSaturatedFrom - 1; place < places_.size(); ++place) all += places_[place];
  return all;
}

std::optional<double> Discharge::saturation_headway_s() const {
  const PlaceHeadways all = saturated();
  if (all.headways == 0) return std::nullopt;
  return all.mean_s();
}

std::optional<double> Discharge::lost_time_s() const {
  const auto saturation_s = saturation_headway_s();
  if (!saturation_s) return std::nullopt;
  double lost_s = 0.0;
  for (std::size_t place = 0; place + 1 < kSaturatedFrom; ++place) lost_s += places_[place].mean_s() - *saturation_s;
  return lost_s;
}

}  // namespace lukou
