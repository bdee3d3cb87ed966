#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace lukou {

/// Which kind of station sent a frame or what a frame holds; the values stand on the bus.
enum class FrameKind : std::uint8_t { kBsm = 1, kMap = 2, kSpat = 3, kRsm = 4, kRsc = 5 };

/// Frames that the stations of one process sent in one step. The receiver's modem reads the envelope; an algorithm gets
/// the decoded payload of those frames alone that the modem let through.
struct Frames {
  std::vector<std::uint64_t> sender;      ///< temporary id of the station
  std::vector<std::uint32_t> sequence;    ///< per sender, from 0
  std::vector<std::uint8_t> kind;         ///< FrameKind
  std::vector<std::uint32_t> wire_bytes;  ///< size of a UPER encoding [bytes], security envelope not included
  std::vector<double> antenna_x_m;        ///< true position, for the physics of the radio alone
  std::vector<double> antenna_y_m;
  std::vector<std::uint32_t> payload_end;  ///< end of this frame's bytes in `payload`; its begin is the one before's
  std::vector<std::uint8_t> payload;       ///< Protobuf (idl/v2x.proto), frame after frame

  [[nodiscard]] std::size_t size() const { return sender.size(); }
  /// Bytes of one frame. Requires frame < size().
  [[nodiscard]] std::span<const std::uint8_t> payload_of(std::size_t frame) const {
    const std::size_t begin = frame == 0 ? 0 : payload_end[frame - 1];
    return std::span(payload).subspan(begin, payload_end[frame] - begin);
  }
  /// Adds the frames of others behind these.
  void append(const Frames& others);
  void clear() {
    sender.clear(), sequence.clear(), kind.clear(), wire_bytes.clear();
    antenna_x_m.clear(), antenna_y_m.clear(), payload_end.clear(), payload.clear();
  }
};

/// What the sender of a frame puts on its outside.
struct Envelope {
  std::uint64_t sender = 0;    ///< temporary id of the station
  std::uint32_t sequence = 0;  ///< per sender, from 0
  double antenna_x_m = 0.0;    ///< true position, for the physics of the radio alone
  double antenna_y_m = 0.0;
};

}  // namespace lukou
