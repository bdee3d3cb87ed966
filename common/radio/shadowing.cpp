#include "common/radio/shadowing.hpp"

#include <cmath>

#include "common/core/keyed_random.hpp"
#include "common/radio/path_loss.hpp"

namespace lukou {
namespace {

constexpr double kCellsPerDecorrelation = 2.0;
constexpr double kRho = 0.60653065971263342;  // e^-(1/2): correlation of neighbouring cells
constexpr int kTerms = 14;                    // rho^14 = e^-7: what is left out is below 0.1 %
constexpr std::uint32_t kCellZero = 1U << 23U;

/// Street, cell along it and end of the pair in one number.
std::uint32_t cell_name(Street street, std::uint32_t cell, std::uint32_t end) {
  return (static_cast<std::uint32_t>(street) << 28U) | (end << 27U) | cell;
}

}  // namespace

double Shadowing::process(std::uint64_t pair, std::uint32_t end, const PlanePoint& at, double decorrelation_m) {
  const Street street = street_of(at);
  const double cells = std::floor(along_street_m(at) * kCellsPerDecorrelation / decorrelation_m);
  const auto cell = static_cast<std::uint32_t>(static_cast<std::int64_t>(kCellZero) + static_cast<std::int64_t>(cells));
  // The two decorrelation distances cut the street differently: their cells are different ones, too.
  const std::uint32_t name = cell_name(street, cell, end) | (decorrelation_m > 11.0 ? 1U << 30U : 0U);
  InCell& kept = kept_.of(pair + end);
  if (kept.cell == name) return kept.value;
  double sum = 0.0;
  double weight = 1.0;
  double squares = 0.0;
  for (std::uint32_t j = 0; j < kTerms; ++j) {
    sum += weight *
           standard_normal({.run_seed = seed_, .purpose = Purpose::kRadioShadowing, .entity = name - j, .index = pair});
    squares += weight * weight;
    weight *= kRho;
  }
  kept = {name, sum / std::sqrt(squares)};
  return kept.value;
}

double Shadowing::at(std::uint64_t pair, const PlanePoint& car, double decorrelation_m) {
  return process(pair, 0, car, decorrelation_m);
}

double Shadowing::between(std::uint64_t pair, const PlanePoint& a, const PlanePoint& b, double decorrelation_m) {
  return (process(pair, 0, a, decorrelation_m) + process(pair, 1, b, decorrelation_m)) / std::sqrt(2.0);
}

}  // namespace lukou
