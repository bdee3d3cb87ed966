#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "common/core/expected.hpp"
#include "common/core/step.hpp"
#include "common/intersection/signal_plan.hpp"
#include "common/messages/frames.hpp"

namespace lukou {

/// A stretch of a head's future, counted from the message's time.
struct PhaseState {
  Aspect aspect = Aspect::kRed;
  Step starts_in = 0;           ///< steps; 0 = it shows now. [0, 35999], unit 0.1 s; later saturates to 36000
  std::optional<Step> ends_in;  ///< steps; likely end, as `starts_in`; empty = unknown
};

/// At most as many states as T/CSAE 53 allows in a phase.
inline constexpr std::size_t kMaxPhaseStates = 16;

/// What the heads show, and will (T/CSAE 53, SPAT). One phase per lane; phase id = index of the lane + 1.
struct Spat {
  std::uint8_t count = 0;                             ///< of this sender's messages of this kind, modulo 128: [0, 127]
  std::uint32_t minute_of_year = 0;                   ///< [0, 527039]
  std::uint16_t second_mark_ms = 0;                   ///< [0, 59999]
  std::uint16_t node = 0;                             ///< id of the intersection, [0, 65535]
  std::array<std::vector<PhaseState>, kLanes> lanes;  ///< in the order of time; each holds 1 to 16
};

/// Appends a frame. Requires what the fields say.
void append(Frames& frames, const Envelope& envelope, const Spat& message);
/// Refuses what cannot be decoded, lacks a required field or a phase, or holds a value outside the standard's range.
Expected<Spat> decode_spat(std::span<const std::uint8_t> payload);

}  // namespace lukou
