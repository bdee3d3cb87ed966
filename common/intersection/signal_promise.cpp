#include "common/intersection/signal_promise.hpp"

#include <algorithm>

#include "common/core/contract.hpp"

namespace lukou {

bool SignalPromise::extend(Step first, std::span<const std::uint8_t> heads) {
  const Step begin = heads_.empty() ? std::max(first_, first) : first_;
  const Step end = begin + static_cast<Step>(heads_.size());
  if (first > end || first < 0 || heads.size() % kLanes != 0) return false;
  const auto known = [](std::uint8_t value) { return value >= 1 && value <= 3; };
  if (!std::ranges::all_of(heads, known)) return false;
  const Step rows = static_cast<Step>(heads.size()) / kLanes;
  if (end - first >= rows) return true;  // nothing new
  first_ = begin;
  for (Step row = end - first; row < rows; ++row) {
    Heads added{};
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      added[lane] = static_cast<Aspect>(heads[static_cast<std::size_t>(row) * kLanes + lane]);
    }
    heads_.push_back(added);
  }
  return true;
}

const Heads& SignalPromise::at(Step step) const {
  LUKOU_EXPECT(covers(step));
  return heads_[static_cast<std::size_t>(step - first_)];
}

void SignalPromise::forget_before(Step step) {
  while (!heads_.empty() && first_ < step) {
    heads_.pop_front();
    ++first_;
  }
}

}  // namespace lukou
