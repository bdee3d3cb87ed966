#pragma once

#include <array>
#include <cstdint>
#include <deque>

#include "common/bus/batches.hpp"
#include "common/intersection/lane.hpp"

namespace lukou {

/// Cars and what they have lost so far.
struct DelayTotals {
  std::uint64_t cars = 0;
  double waited_s = 0.0;  ///< before the entrance
  double delay_s = 0.0;   ///< these and what was lost on the road

  DelayTotals& operator+=(const DelayTotals& other);
};

/// The cars that have arrived and are not on the road yet: when each of them arrived. Memory grows with their number.
class EntryQueue {
 public:
  /// Takes the arrivals of the next step. Requires the batches in the order of their steps.
  void add_arrivals(const TrafficBatch& batch);
  /// The step in which the car arrived that comes onto the road now: the first of its approach and kind.
  Step enter(Approach approach, bool equipped);
  /// Cars of a kind that arrived at or after `since` and still wait at `now`.
  [[nodiscard]] DelayTotals waiting(bool equipped, Step since, Step now) const;

 private:
  /// Of an approach: when the waiting cars arrived, and how many have arrived since step 0.
  struct Kind {
    std::deque<Step> waiting;
    std::uint32_t arrived = 0;
  };
  std::array<Kind, kApproaches> equipped_;
  std::array<Kind, kApproaches> unequipped_;
};

}  // namespace lukou
