#pragma once

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <tuple>
#include <utility>
#include <vector>

#include "common/radio/modem.hpp"

namespace lukou {

/// What is on the air towards the stations of one process, until the step in which it is heard.
template <class Content>
class Inbox {
 public:
  struct Item {
    Arrival arrival;
    std::uint64_t sender = 0;
    std::uint32_t sequence = 0;
    bool duplicate = false;  ///< an equal item came before
    Content content;
  };

  /// Puts in what the modem let through, its duplicate too.
  void add(const Reception& reception, const Hop& hop, const Content& content) {
    waiting_.push_back({reception.first, hop.sender, hop.sequence, false, content});
    if (reception.second) waiting_.push_back({*reception.second, hop.sender, hop.sequence, true, content});
  }
  /// Takes out what is due by step `now`, in the order of arrival time, sender and sequence; what is equal in all three
  /// (one frame for several receivers, a duplicate) in the order in which it was put in.
  std::vector<Item> take(Step now) {
    const auto due = std::stable_partition(waiting_.begin(), waiting_.end(),
                                           [now](const Item& item) { return item.arrival.due > now; });
    std::vector<Item> taken(std::make_move_iterator(due), std::make_move_iterator(waiting_.end()));
    waiting_.erase(due, waiting_.end());
    std::ranges::stable_sort(
        taken, {}, [](const Item& item) { return std::tuple(item.arrival.at_ms, item.sender, item.sequence); });
    return taken;
  }
  [[nodiscard]] bool empty() const { return waiting_.empty(); }

 private:
  std::vector<Item> waiting_;
};

}  // namespace lukou
