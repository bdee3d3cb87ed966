#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "common/core/expected.hpp"
#include "services/lukou/study/analysis.hpp"

// Two single runs with the same arrivals. Cars of a run depend on each other, so no car is a sample; the means of the
// cars that came within some whole cycles nearly are: the method of batch means (Law, Simulation Modeling and Analysis,
// 9.5.3), here of the differences car by car.

namespace lukou::compare {

/// What is told by the cars that left in both runs and came after the warm-up.
struct Batches {
  studies::Pairs pairs;   ///< a batch's mean in A and in B
  std::size_t cars = 0;   ///< in all batches
  double length_s = 0.0;  ///< of a batch, whole cycles
  double lag_one = 0.0;   ///< correlation of neighbouring batches' differences
  /// Whether the batches follow each other as if by chance: lag_one below its 95 % bound of independent ones.
  [[nodiscard]] bool independent() const;
};

/// Fewer batches than this have no interval.
inline constexpr std::size_t kBatchesLeast = 10;
/// As many are aimed at.
inline constexpr std::size_t kBatchesAim = 20;

/// Whether single cars have the measure, so that it can be compared by car.
bool is_of_cars(const std::string& measure);

/// Requires is_of_cars(measure). Reads car.csv in both result folders. Error: a table that is missing or wrong.
Expected<Batches> batches_of(const std::filesystem::path& a, const std::filesystem::path& b,
                             const std::string& measure);

/// Correlation of neighbours in a series, about its mean; 0 of a series that does not vary or has fewer than 2 values.
double lag_one_correlation(const std::vector<double>& series);

}  // namespace lukou::compare
