#pragma once

#include <string>

#include "common/messages/frames.hpp"

namespace lukou {

/// A batch that holds `message` alone.
template <class Message>
Frames one_frame(const Message& message) {
  Frames frames;
  append(frames, Envelope{.sender = 7, .sequence = 3, .antenna_x_m = 1.5, .antenna_y_m = -2.5}, message);
  return frames;
}

/// The bytes of its payload, as Protobuf takes them.
inline std::string bytes_of(const Frames& frames) { return {frames.payload.begin(), frames.payload.end()}; }

inline std::span<const std::uint8_t> as_payload(const std::string& bytes) {
  return {reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()};
}

}  // namespace lukou
