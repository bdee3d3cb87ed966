#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <deque>

#include "services/console/transport.hpp"

namespace lukou::console {

/// What one viewer has been sent, and what it still must get. Of pictures and other states only the newest counts;
/// words (hello, events, replies) wait in a queue of limited length.
class Viewer {
 public:
  /// States of which a viewer needs the newest alone; each has a version that counts from 1.
  enum State : std::size_t { kHands, kStatus, kStatistics, kPicture, kStates };

  void push(Bytes words) {
    queued_bytes_ += words->size();
    queue_.push_back(std::move(words));
  }
  /// The oldest word; null: none waits.
  Bytes pop() {
    if (queue_.empty()) return nullptr;
    Bytes words = std::move(queue_.front());
    queue_.pop_front();
    queued_bytes_ -= words->size();
    return words;
  }
  [[nodiscard]] bool too_slow() const { return queue_.size() > kWordsMax || queued_bytes_ > kBytesMax; }

  /// Whether a state of this version may be sent now. A picture has to wait for the ones before to be drawn.
  [[nodiscard]] bool wants(State state, std::uint64_t version) const {
    return version > sent_[state] && (state != kPicture || in_flight_ < kInFlightMax);
  }
  void sent(State state, std::uint64_t version) {
    sent_[state] = version;
    if (state == kPicture) ++in_flight_;
  }
  void drawn() { in_flight_ = std::max(in_flight_ - 1, 0); }

  /// Which signal program it knows; 0 = none yet.
  [[nodiscard]] std::uint64_t program() const { return program_; }
  void knows_program(std::uint64_t version) { program_ = version; }

  /// Another run: what it knew counts no more.
  void forget() { *this = Viewer(); }

 private:
  static constexpr std::size_t kWordsMax = 512;
  static constexpr std::size_t kBytesMax = 4U << 20U;
  static constexpr int kInFlightMax = 2;  ///< one on the way while one is drawn

  std::deque<Bytes> queue_;
  std::size_t queued_bytes_ = 0;
  std::uint64_t sent_[kStates] = {};
  int in_flight_ = 0;
  std::uint64_t program_ = 0;
};

}  // namespace lukou::console
