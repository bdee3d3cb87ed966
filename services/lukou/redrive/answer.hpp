#pragma once

#include <compare>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "common/core/step.hpp"
#include "common/messages/frames.hpp"

namespace lukou::redrive {

/// What an RSU sent and asked for in one step.
struct Answer {
  Frames frames;
  std::vector<std::uint16_t> request_lanes;  ///< bit n = lane n; none or one
  std::vector<Step> request_lifetime;

  friend bool operator==(const Answer& a, const Answer& b);
};

/// To whom or of what a word is.
struct Topic {
  enum class Kind : std::uint8_t { kAdvice, kLaneSpeed, kRequest, kSpat, kMap, kRsm, kUnreadable };
  Kind kind = Kind::kAdvice;
  std::uint64_t id = 0;     ///< kAdvice: temporary id of the car; kLaneSpeed: lane; others: 0
  std::uint32_t place = 0;  ///< counts words on the same in one step

  friend auto operator<=>(const Topic&, const Topic&) = default;
};
/// "advice", "lane_speed", "request", "spat", "map", "rsm", "unreadable".
std::string_view name(Topic::Kind kind);

/// A word as it counts: numbers of frames and messages left out, since they follow from what was said before.
struct Word {
  std::string bytes;
  std::string text;  ///< for people
  friend bool operator==(const Word& a, const Word& b) { return a.bytes == b.bytes; }
};
using Words = std::map<Topic, Word>;
Words words_of(const Answer& answer);
/// Advice for cars in an answer.
std::size_t advice_in(const Answer& answer);

}  // namespace lukou::redrive
