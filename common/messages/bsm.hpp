#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "common/core/expected.hpp"
#include "common/messages/frames.hpp"
#include "common/messages/plane.hpp"

namespace lukou {

/// What a car's unit says about its car (T/CSAE 53, BSM). Empty = unavailable.
struct BasicSafety {
  std::uint64_t temporary_id = 0;
  std::uint8_t count = 0;                   ///< of this sender's messages of this kind, modulo 128: [0, 127]
  std::uint16_t second_mark_ms = 0;         ///< when it was made, [0, 59999]; see time_marks.hpp
  PlanePoint centre;                        ///< centre of the car, not its front; see centre_of_car
  std::optional<double> speed_mps;          ///< [0, 163.8], unit 0.02
  std::optional<double> heading_rad;        ///< clockwise from north, [0, 2 pi), unit 0.0125 degree
  std::optional<double> acceleration_mps2;  ///< along the car, [-20, 20], unit 0.01
  bool braking = false;                     ///< the brake pedal is pressed
  double width_m = 0.0;                     ///< [0, 10.23], unit 0.01; 0 = unavailable
  double length_m = 0.0;                    ///< [0, 40.95], unit 0.01; 0 = unavailable
  std::optional<double> accuracy_m;         ///< semi-major axis, one standard deviation, [0, 12.7], unit 0.05
};

/// Appends a frame. Values beyond a field's range saturate; a value that is not a number, a heading beyond a turn or a
/// point off the globe becomes unavailable.
/// Requires count <= 127 and second_mark_ms <= 59999.
void append(Frames& frames, const Envelope& envelope, const BasicSafety& message);
/// Refuses what cannot be decoded, lacks a required field, holds a value outside the standard's range, or no position.
Expected<BasicSafety> decode_bsm(std::span<const std::uint8_t> payload);

/// Centre of a car whose front is at `front` and which heads for `heading_rad`.
PlanePoint centre_of_car(const PlanePoint& front, double heading_rad, double length_m);

}  // namespace lukou
