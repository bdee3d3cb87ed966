#pragma once

#include <cstdint>

#include "common/messages/plane.hpp"
#include "common/radio/kept.hpp"

namespace lukou {

/// What houses, trees and cars add to a mean path loss and take from it, correlated along the way of a car: standard
/// normal, the same in both directions of a pair, correlation e^-1 over the decorrelation distance. A street is cut
/// into cells of half that distance; in cell c the value is a sum of independent normals Z of the cells c, c - 1, ...
/// with weights rho^j, so it is an AR(1) process that needs no memory. What was computed is kept for speed alone.
class Shadowing {
 public:
  explicit Shadowing(std::uint64_t seed) : seed_(seed) {}

  /// Between a mast and a car at `car`. `pair` is the number of the pair; decorrelation_m > 0.
  double at(std::uint64_t pair, const PlanePoint& car, double decorrelation_m);
  /// Between two cars: each end adds the process of its own way. `a` is the station with the smaller id.
  double between(std::uint64_t pair, const PlanePoint& a, const PlanePoint& b, double decorrelation_m);

 private:
  struct InCell {
    std::uint32_t cell = 0;  ///< 0: none
    double value = 0.0;
  };
  double process(std::uint64_t pair, std::uint32_t end, const PlanePoint& at, double decorrelation_m);

  std::uint64_t seed_;
  Kept<InCell> kept_{4096};  ///< by pair and end
};

}  // namespace lukou
