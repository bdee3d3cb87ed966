#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "common/bus/batches.hpp"
#include "common/measures/rows.hpp"

namespace lukou {

/// Follows every advice to its end. An advice that was never used has its fate at once; one that was used is settled
/// when a newer one takes its place or its car drives without it. A speed for the lane is settled at its first use.
class AdviceLedger {
 public:
  /// Takes the next step's batch.
  void add(const TrafficBatch& batch);
  /// What the newest step settled: in the order of the batch's fates, then of its cars.
  [[nodiscard]] std::span<const SettledAdvice> settled() const { return settled_; }
  /// Settles what is still in force, by vehicle: the run is over.
  [[nodiscard]] std::vector<SettledAdvice> close() const;

 private:
  void add_fate(const TrafficBatch& batch, std::size_t row);
  void settle(std::map<std::uint32_t, SettledAdvice>::iterator used, Step step);

  Step step_ = -1;
  std::map<std::uint32_t, Lane> lanes_;          ///< of the vehicles on the road
  std::map<std::uint32_t, SettledAdvice> used_;  ///< by vehicle: the advice that it uses
  std::vector<SettledAdvice> settled_;
};

}  // namespace lukou
