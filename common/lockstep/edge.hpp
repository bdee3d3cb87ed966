#pragma once

#include <deque>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "common/core/contract.hpp"
#include "common/core/expected.hpp"
#include "common/core/step.hpp"

namespace lukou {

/// When a consumer needs which batch of a producer.
struct EdgeTiming {
  Step delay = 0;        ///< step k needs the batch of step k - delay ...
  Step stride = 1;       ///< ... rounded down to a multiple of the stride: producers may publish every stride-th step
  bool initial = false;  ///< steps before the delay need batch 0 (otherwise they need nothing)
};

inline constexpr Step kNever = std::numeric_limits<Step>::max();

/// One input of a stepped participant: holds the batches of one producer until the step that needs them, and says
/// whether a step may start. Each step takes exactly the batch it needs, never "the newest".
///
/// A producer's life is a list of epochs (process starts). Batch j belongs to the epoch whose interval [from, cut)
/// holds j; outside all intervals the producer is silent and nobody waits for it.
template <class Batch>
class Edge {
 public:
  /// `attached`: the producer's first epoch is 1 and begins with batch 0. Otherwise nothing is heard before attach().
  explicit Edge(EdgeTiming timing, bool attached = true) : timing_(timing) {
    if (attached) {
      intervals_.push_back({1, 0, kNever, {}});
    } else {
      intervals_.push_back({0, kNever, kNever, {}});
    }
  }

  /// Takes over a batch that came in (its storage is swapped for a used one, so steady traffic allocates nothing).
  /// Batches of a fenced epoch are ignored. A gap in the steps is an error: something was lost.
  Expected<Done> accept(std::uint32_t epoch, Batch& batch) {
    Interval* interval = find(epoch);
    if (interval == nullptr) {
      if (epoch <= intervals_.back().epoch) return Done{};  // of a life that is over
      early_.emplace_back(epoch, std::move(batch));         // overtook the grant that attaches it
      return Done{};
    }
    if (interval->cut != kNever || interval->from == kNever) return Done{};  // fenced, or before it took part
    const Step due = interval->next < 0 ? round_up(interval->from) : interval->next;
    if (interval->next < 0 && batch.step < due) return Done{};  // from before the consumer took part
    if (batch.step != due) {
      return Error{"", "expected the batch of step " + std::to_string(due) + ", got " + std::to_string(batch.step)};
    }
    interval->next = due + timing_.stride;
    store(*interval, batch);
    return Done{};
  }

  /// True if everything that step k needs of this producer is in hand.
  [[nodiscard]] bool ready(Step k) const {
    const Step need = needed(k);
    const Interval* interval = need < 0 ? nullptr : holding(need);
    return interval == nullptr || need <= interval->taken || !interval->batches.empty();
  }

  /// The batch that comes in force with step k; nullptr if none does (silent, or still the one before).
  /// Requires ready(k), and steps in order.
  Batch* take(Step k) {
    const Step need = needed(k);
    Interval* interval = need < 0 ? nullptr : const_cast<Interval*>(holding(need));
    if (interval == nullptr || need <= interval->taken) return nullptr;
    LUKOU_EXPECT(!interval->batches.empty() && interval->batches.front().step == need);
    interval->taken = need;
    std::swap(current_, interval->batches.front());
    spare_.push_back(std::move(interval->batches.front()));
    interval->batches.pop_front();
    return &current_;
  }

  /// The producer of `epoch` is gone: nothing is awaited beyond what is in hand. Returns the first step not heard.
  Step fence(std::uint32_t epoch) {
    Interval* interval = find(epoch);
    if (interval == nullptr) {  // lost before it was attached: an empty life
      std::erase_if(early_, [&](const auto& e) { return e.first == epoch; });
      intervals_.push_back({epoch, kNever, kNever, {}});
      return kNever;
    }
    if (interval->cut == kNever) interval->cut = interval->next < 0 ? interval->from : interval->next;
    return interval->cut;
  }

  /// A consumer that takes part from its step k on: the first batch that it needs of a producer that never stopped.
  Expected<Done> begin(Step k) { return attach(1, needed(k) < 0 ? 0 : needed(k)); }

  /// The producer lives again from batch `from` on.
  Expected<Done> attach(std::uint32_t epoch, Step from) {
    intervals_.push_back({epoch, from, kNever, {}});
    auto early = std::exchange(early_, {});
    for (auto& [of_epoch, batch] : early) {
      if (auto done = accept(of_epoch, batch); !done) return done;
    }
    return Done{};
  }

 private:
  struct Interval {
    std::uint32_t epoch;
    Step from;
    Step cut;
    std::deque<Batch> batches;
    Step next = -1;   ///< step of the batch that must come next; -1 before the first
    Step taken = -1;  ///< step of the batch taken last
  };

  [[nodiscard]] Step round_up(Step step) const { return (step + timing_.stride - 1) / timing_.stride * timing_.stride; }

  [[nodiscard]] Step needed(Step k) const {
    if (k < timing_.delay) return timing_.initial ? 0 : -1;
    return (k - timing_.delay) / timing_.stride * timing_.stride;
  }

  [[nodiscard]] const Interval* holding(Step batch) const {
    for (auto it = intervals_.rbegin(); it != intervals_.rend(); ++it)
      if (batch >= it->from && batch < it->cut) return &*it;
    return nullptr;
  }

  Interval* find(std::uint32_t epoch) {
    for (auto& interval : intervals_)
      if (interval.epoch == epoch) return &interval;
    return nullptr;
  }

  void store(Interval& interval, Batch& batch) {
    if (spare_.empty()) {
      interval.batches.push_back(std::move(batch));
      batch = Batch{};
    } else {
      interval.batches.push_back(std::move(spare_.back()));
      spare_.pop_back();
      std::swap(interval.batches.back(), batch);
    }
  }

  EdgeTiming timing_;
  std::deque<Interval> intervals_;
  std::vector<std::pair<std::uint32_t, Batch>> early_;
  std::vector<Batch> spare_;
  Batch current_{};
};

// The edges of design: who needs what when.

/// Engine to RSU and to recorder.
inline constexpr EdgeTiming kSameStep{.delay = 0};
/// RSU to engine and controller.
inline constexpr EdgeTiming kStepBefore{.delay = 1};
/// The controller publishes every stride-th step what it has promised since; with promise P a batch of step k holds the
/// heads of steps k + P - stride + 1 ... k + P, so it is needed P - stride + 1 steps later.
constexpr Step signal_stride(Step promise) { return promise / 2; }
constexpr EdgeTiming signal_timing(Step promise) {
  return {.delay = promise - signal_stride(promise) + 1, .stride = signal_stride(promise), .initial = true};
}

}  // namespace lukou
