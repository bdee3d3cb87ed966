#pragma once

#include <string>

#include "common/bus/batches.hpp"
#include "common/lockstep/messages.hpp"

// What comes over the bus was written by somebody else, perhaps in another language: before a process uses it, columns
// of one group must have one length, and every value must be one that docs/topics.md knows.

namespace lukou::bus {

/// Frames of one step that are still believed.
inline constexpr std::size_t kFramesMax = 65'536;
/// Bytes of a frame that are still believed; the largest that is sent, a MAP, has less than 3,000.
inline constexpr std::uint32_t kWireBytesMax = 65'535;

/// What is wrong with it: "frames.kind has 3 values, frames.sender has 4"; "" if nothing is.
std::string flaw_of(const AirBatch& batch);
std::string flaw_of(const RoadsideBatch& batch);
std::string flaw_of(const RequestBatch& batch);
std::string flaw_of(const SignalBatch& batch);
std::string flaw_of(const TrafficBatch& batch);
std::string flaw_of(const Control& message);
std::string flaw_of(const Up& message);
std::string flaw_of(const RunState& message);
std::string flaw_of(const View& message);

}  // namespace lukou::bus
