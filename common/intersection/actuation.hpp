#pragma once

#include <cstddef>
#include <cstdint>

#include "common/core/step.hpp"

namespace lukou {

/// What the signal controller keeps when RSUs may ask for greens, whatever they ask for. Defaults: the scenario's.
struct Actuation {
  Step min_green = 80;   ///< steps: no green is shorter
  Step yellow = 30;      ///< steps of yellow at the end of each green
  Step all_red = 10;     ///< steps from the red of a lane to the green of one that crosses it
  Step max_wait = 1200;  ///< steps: a lane that has been red for longer comes before every request

  friend bool operator==(const Actuation&, const Actuation&) = default;
};

/// Most steps for which a request may hold: an hour.
inline constexpr Step kLongestRequest = 36'000;

/// What became of an RSU's request for greens. The values stand on the bus.
enum class RequestOutcome : std::uint8_t {
  kAccepted = 0,   ///< the heads go there
  kMinGreen = 1,   ///< accepted; a green that is to end is too young still
  kMaxWait = 2,    ///< accepted; lanes that have been red for too long come first
  kConflict = 3,   ///< refused: two of its lanes cross
  kMalformed = 4,  ///< refused: no lane, an unknown one, or no lifetime within [1, kLongestRequest]
  kOtherRsu = 5,   ///< refused, or given up: the request of an RSU with a lower index is in force
  kEnded = 6,      ///< its lifetime has ended, and no newer one came: the heads follow the plan
};
inline constexpr std::size_t kRequestOutcomes = 7;

/// Whether the heads follow a request of this outcome, as far as the clearances let them.
constexpr bool is_followed(RequestOutcome outcome) { return outcome <= RequestOutcome::kMaxWait; }

}  // namespace lukou
