#include "common/measures/entry_queue.hpp"

#include "common/core/contract.hpp"

namespace lukou {

DelayTotals& DelayTotals::operator+=(const DelayTotals& other) {
  cars += other.cars;
  waited_s += other.waited_s;
  delay_s += other.delay_s;
  return *this;
}

void EntryQueue::add_arrivals(const TrafficBatch& batch) {
  LUKOU_EXPECT(batch.arrived.size() == kApproaches && batch.arrived_equipped.size() == kApproaches);
  const auto take = [&](Kind& kind, std::uint32_t arrived) {
    LUKOU_EXPECT(arrived >= kind.arrived);
    for (; kind.arrived < arrived; ++kind.arrived) kind.waiting.push_back(batch.step);
  };
  for (std::size_t approach = 0; approach < kApproaches; ++approach) {
    take(equipped_[approach], batch.arrived_equipped[approach]);
    take(unequipped_[approach], batch.arrived[approach] - batch.arrived_equipped[approach]);
  }
}

Step EntryQueue::enter(Approach approach, bool equipped) {
  std::deque<Step>& waiting = (equipped ? equipped_ : unequipped_)[index(approach)].waiting;
  LUKOU_EXPECT(!waiting.empty());
  const Step arrived = waiting.front();
  waiting.pop_front();
  return arrived;
}

DelayTotals EntryQueue::waiting(bool equipped, Step since, Step now) const {
  DelayTotals totals;
  for (const Kind& kind : equipped ? equipped_ : unequipped_) {
    for (const Step arrived : kind.waiting) {
      if (arrived < since) continue;
      ++totals.cars;
      totals.waited_s += time_s(now - arrived);
    }
  }
  totals.delay_s = totals.waited_s;
  return totals;
}

}  // namespace lukou
