#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "common/core/expected.hpp"
#include "common/messages/binding.hpp"
#include "common/messages/frames.hpp"
#include "common/messages/plane.hpp"

namespace lukou {

/// An acceleration from the issue of the message until its lifetime ends: a path of one point.
struct GuidedPath {
  PlanePoint centre;  ///< where the RSU holds the car's centre to be at the issue; the standard requires it
  double acceleration_mps2 = 0.0;  ///< [-20, 20], unit 0.01: decodes to exactly n / 100.0
  std::uint32_t lifetime_ms = 0;   ///< from the issue, [10, 655340], unit 10
};

/// What the RSU asks of one car.
struct VehicleCoordination {
  std::uint64_t vehicle = 0;       ///< temporary id of the car
  std::optional<GuidedPath> path;  ///< empty = release: the car drives on its own
  Binding binding = Binding::kGuard;
};

inline constexpr std::size_t kMaxCoordinations = 16;

/// Guidance of an RSU (T/CSAE 157, RSC).
struct Coordination {
  std::uint64_t rsu = 0;                      ///< id of the RSU
  std::uint8_t count = 0;                     ///< of this sender's messages of this kind, modulo 128: [0, 127]
  std::uint16_t second_mark_ms = 0;           ///< when it was issued, [0, 59999]; see time_marks.hpp
  std::vector<VehicleCoordination> vehicles;  ///< at most 16
};

/// False if the acceleration or the lifetime is not a number or does not fit its field. An advice is never bent:
/// who sends one must ask first.
bool fits(const GuidedPath& path);

/// Appends a frame. Requires count <= 127, second_mark_ms <= 59999, at most 16 vehicles and that every path fits.
void append(Frames& frames, const Envelope& envelope, const Coordination& message);
/// Refuses what cannot be decoded, lacks a required field, holds a value outside the standard's range, names more than
/// 16 vehicles, or has a path of more than one point (no car of ours follows one).
Expected<Coordination> decode_rsc(std::span<const std::uint8_t> payload);

}  // namespace lukou
