#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "common/core/step.hpp"

namespace lukou::traffic {

/// How wrong on-board units are about where and when they are; all standard deviations. Zero: exact.
struct UnitErrorParameters {
  double bias_m = 0.0;           ///< of a car's constant error, per axis
  double noise_m = 0.0;          ///< of the error that wanders, per axis, in the long run
  double correlation_s = 60.0;   ///< > 0; after this time the correlation of the wandering error is 1/e
  double clock_offset_ms = 0.0;  ///< of a unit's constant offset

  friend bool operator==(const UnitErrorParameters&, const UnitErrorParameters&) = default;
};

/// What a unit adds to the truth without knowing it.
struct UnitError {
  double east_m = 0.0;
  double north_m = 0.0;
  double clock_ms = 0.0;  ///< positive = its clock is ahead
};

/// A unit's clock offset [ms]: the same for the whole life of its car.
double drawn_clock_offset_ms(std::uint64_t seed, std::uint32_t vehicle, double deviation_ms);

/// The errors of all units. The error of a position is, per axis, a constant and a first-order Gauss-Markov process:
/// e(k) = r e(k-1) + sqrt(1 - r^2) n(k), r = exp(-0.1 s / correlation_s), n normal; it is stationary from the first
/// step on, and two cars share no draw.
class UnitErrors {
 public:
  UnitErrors(std::uint64_t seed, const UnitErrorParameters& parameters) : seed_(seed), parameters_(parameters) {}

  /// From the next step on. What wanders goes on from where it is, scaled.
  void use(const UnitErrorParameters& parameters);
  /// False: every error is zero.
  [[nodiscard]] bool any() const;
  /// What a unit believes of its position, one standard deviation per axis [m]; empty if it takes it for exact.
  [[nodiscard]] std::optional<double> accuracy_m() const;
  /// The error of a car's unit in a step. Requires steps that do not go back.
  UnitError of(std::uint32_t vehicle, Step step);
  /// Forgets the cars that `of` was not asked for in this step: they have left.
  void forget_unseen(Step step);

 private:
  struct Entry {
    std::uint32_t vehicle = 0;
    Step seen = 0;
    std::optional<Step> wandered;   ///< the step that `wander` is of
    double wander[2] = {0.0, 0.0};  ///< unit variance
    double bias[2] = {0.0, 0.0};    ///< unit variance
    double clock = 0.0;             ///< unit variance
  };

  Entry& entry_of(std::uint32_t vehicle);
  void wander_to(Entry& entry, Step step) const;

  std::uint64_t seed_;
  UnitErrorParameters parameters_;
  std::vector<Entry> entries_;  ///< by vehicle
};

}  // namespace lukou::traffic
