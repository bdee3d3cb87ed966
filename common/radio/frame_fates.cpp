#include "common/radio/frame_fates.hpp"

#include <algorithm>
#include <limits>

namespace lukou {

void FrameFates::clear() { fate.clear(), due.clear(), latency_ms.clear(); }

void FrameFates::add(const Reception& reception) {
  const bool lost = reception.lost.has_value();
  fate.push_back(lost ? static_cast<std::uint8_t>(1 + static_cast<std::uint8_t>(*reception.lost)) : kFrameHeard);
  due.push_back(lost ? -1 : reception.first.due);
  latency_ms.push_back(lost ? std::numeric_limits<double>::quiet_NaN() : reception.first.latency_ms);
}

void FrameFates::add(const FrameFates& others) {
  fate.insert(fate.end(), others.fate.begin(), others.fate.end());
  due.insert(due.end(), others.due.begin(), others.due.end());
  latency_ms.insert(latency_ms.end(), others.latency_ms.begin(), others.latency_ms.end());
}

bool FrameFates::well_formed() const {
  return due.size() == size() && latency_ms.size() == size() &&
         std::ranges::all_of(fate, [](std::uint8_t value) { return value < kFrameFates; });
}

}  // namespace lukou
