#include "services/traffic_engine/model/unit_errors.hpp"

#include <algorithm>
#include <cmath>

#include "common/core/contract.hpp"
#include "common/core/keyed_random.hpp"
#include "common/core/math.hpp"

namespace lukou::traffic {
namespace {

constexpr std::uint64_t kAxes = 2;  // east, north

}  // namespace

double drawn_clock_offset_ms(std::uint64_t seed, std::uint32_t vehicle, double deviation_ms) {
  if (deviation_ms == 0.0) return 0.0;
  return deviation_ms *
         standard_normal({.run_seed = seed, .purpose = Purpose::kUnitClock, .entity = vehicle, .index = 0});
}

void UnitErrors::use(const UnitErrorParameters& parameters) {
  parameters_ = parameters;
  if (!any()) entries_.clear();
}

bool UnitErrors::any() const {
  return parameters_.bias_m > 0.0 || parameters_.noise_m > 0.0 || parameters_.clock_offset_ms > 0.0;
}

std::optional<double> UnitErrors::accuracy_m() const {
  const double variance_m2 = parameters_.bias_m * parameters_.bias_m + parameters_.noise_m * parameters_.noise_m;
  if (variance_m2 <= 0.0) return std::nullopt;
  return std::sqrt(variance_m2);
}

UnitError UnitErrors::of(std::uint32_t vehicle, Step step) {
  if (!any()) return {};
  Entry& entry = entry_of(vehicle);
  entry.seen = step;
  if (parameters_.noise_m > 0.0) {
    wander_to(entry, step);
  } else {
    entry.wandered.reset();
  }
  const auto error_m = [&](std::size_t axis) {
    const double wander_m = entry.wandered ? parameters_.noise_m * entry.wander[axis] : 0.0;
    return parameters_.bias_m * entry.bias[axis] + wander_m;
  };
  return {.east_m = error_m(0), .north_m = error_m(1), .clock_ms = parameters_.clock_offset_ms * entry.clock};
}

void UnitErrors::forget_unseen(Step step) {
  std::erase_if(entries_, [step](const Entry& entry) { return entry.seen != step; });
}

UnitErrors::Entry& UnitErrors::entry_of(std::uint32_t vehicle) {
  const auto at = std::ranges::lower_bound(entries_, vehicle, {}, &Entry::vehicle);
  if (at != entries_.end() && at->vehicle == vehicle) return *at;
  Entry entry;
  entry.vehicle = vehicle;
  for (std::uint64_t axis = 0; axis < kAxes; ++axis) {
    entry.bias[axis] =
        standard_normal({.run_seed = seed_, .purpose = Purpose::kPositionBias, .entity = vehicle, .index = axis});
  }
  entry.clock = drawn_clock_offset_ms(seed_, vehicle, 1.0);
  return *entries_.insert(at, entry);
}

void UnitErrors::wander_to(Entry& entry, Step step) const {
  LUKOU_EXPECT(!entry.wandered || step >= *entry.wandered);
  const auto drawn = [&](Step at, std::uint64_t axis) {
    return standard_normal({.run_seed = seed_,
                            .purpose = Purpose::kPositionNoise,
                            .entity = entry.vehicle,
                            .index = kAxes * static_cast<std::uint64_t>(at) + axis});
  };
  if (!entry.wandered) {
    entry.wandered = step;
    for (std::uint64_t axis = 0; axis < kAxes; ++axis) entry.wander[axis] = drawn(step, axis);
    return;
  }
  const double kept = math::exp(-kStep_s / parameters_.correlation_s);
  const double fresh = std::sqrt(1.0 - kept * kept);
  while (*entry.wandered < step) {
    ++*entry.wandered;
    for (std::uint64_t axis = 0; axis < kAxes; ++axis) {
      entry.wander[axis] = kept * entry.wander[axis] + fresh * drawn(*entry.wandered, axis);
    }
  }
}

}  // namespace lukou::traffic
