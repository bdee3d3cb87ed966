#pragma once

#include <cstdint>
#include <map>
#include <utility>

#include "common/core/step.hpp"
#include "common/messages/plane.hpp"

namespace lukou {

/// How fast stations move, by where their antennas stood one step before.
class StationSpeed {
 public:
  /// Of a station that now stands there [m/s]; 0 if it sent nothing in the step before. Steps never decrease, and a
  /// station is asked about once a step.
  double of(std::uint64_t station, const PlanePoint& at, Step step) {
    if (step != now_) {
      std::swap(before_, here_);
      here_.clear();
      if (step != now_ + 1) before_.clear();
      now_ = step;
    }
    here_[station] = at;
    const auto found = before_.find(station);
    return found == before_.end() ? 0.0 : distance_m(found->second, at) * static_cast<double>(kStepsPerSecond);
  }

 private:
  using Places = std::map<std::uint64_t, PlanePoint>;  // by station
  Step now_ = -2;
  Places before_;
  Places here_;
};

}  // namespace lukou
