#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "common/core/expected.hpp"
#include "common/messages/frames.hpp"
#include "common/messages/plane.hpp"

namespace lukou {

/// What a participant is; the values stand in the message.
enum class ParticipantType : std::uint8_t { kUnknown = 0, kMotor = 1, kNonMotor = 2, kPedestrian = 3, kRsu = 4 };

/// Who saw it; the values stand in the message.
enum class ParticipantSource : std::uint8_t {
  kUnknown = 0,
  kItself = 1,
  kV2x = 2,
  kVideo = 3,
  kMicrowaveRadar = 4,
  kLoop = 5,
  kLidar = 6,
  kSeveral = 7,
};

/// Something on the road that an RSU knows of. Empty = unavailable.
struct Participant {
  ParticipantType type = ParticipantType::kMotor;
  std::uint16_t number = 0;  ///< given by the RSU, unique within it; 0 = the RSU itself
  ParticipantSource source = ParticipantSource::kUnknown;
  std::optional<std::uint64_t> vehicle;  ///< temporary id, if a BSM told it
  std::uint16_t second_mark_ms = 0;      ///< when it was seen, [0, 59999]; see time_marks.hpp
  PlanePoint centre;                     ///< within 0.83 degree (56 km or more) of the reference point
  std::optional<double> accuracy_m;      ///< of the position; the message knows 15 classes, 0.01 ... 500 m
  std::optional<double> speed_mps;       ///< [0, 163.8], unit 0.02
  std::optional<double> heading_rad;     ///< clockwise from north, [0, 2 pi), unit 0.0125 degree
  double width_m = 0.0;                  ///< [0, 10.23], unit 0.01; 0 = unavailable
  double length_m = 0.0;                 ///< [0, 40.95], unit 0.01; 0 = unavailable
};

inline constexpr std::size_t kMaxParticipants = 16;

/// What an RSU's sensors see (T/CSAE 53, RSM).
struct RoadsideSafety {
  std::uint64_t rsu = 0;                  ///< id of the RSU
  std::uint8_t count = 0;                 ///< of this sender's messages of this kind, modulo 128: [0, 127]
  std::vector<Participant> participants;  ///< 1 to 16
};

/// False for a point that no offset from the reference can tell: one that is not a number or too far away.
bool fits_offset(const PlanePoint& point);

/// Appends a frame. Values beyond a field's range saturate; a value that is not a number or a heading beyond a turn
/// becomes unavailable; an accuracy is told by the finest class that is not below it (worse than 500 m: unavailable).
/// Requires count <= 127, marks <= 59999, 1 to 16 participants and that every centre fits.
void append(Frames& frames, const Envelope& envelope, const RoadsideSafety& message);
/// Refuses what cannot be decoded, lacks a required field, holds a value outside the standard's range, or has no
/// participant or more than 16.
Expected<RoadsideSafety> decode_rsm(std::span<const std::uint8_t> payload);

/// The standard's optional fields that a participant holds.
struct ParticipantFields {
  bool vehicle_id = false;
  bool transmission = false;
  bool steering_angle = false;
  bool motion_confidence = false;  ///< of speed, heading and steering angle
  bool accelerations = false;
  bool height = false;
  bool vehicle_class = false;
};
/// UPER bits of a participant; `offset_units`: the larger of the two offsets in 1e-7 degree, without its sign.
std::uint32_t participant_bits(const ParticipantFields& fields, std::int64_t offset_units);
/// UPER bytes of a message whose participants take `bits` together.
std::uint32_t rsm_bytes(std::uint32_t bits);

}  // namespace lukou
