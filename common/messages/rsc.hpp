#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "common/core/expected.hpp"
#include "common/intersection/lane.hpp"
#include "common/messages/binding.hpp"
#include "common/messages/frames.hpp"
#include "common/messages/plane.hpp"

namespace lukou {

/// From some time after the issue on another acceleration: a further point of a path.
struct LaterAcceleration {
  std::uint32_t from_ms = 0;  ///< from the issue, unit 10; later than the point before, earlier than the end of life
  double acceleration_mps2 = 0.0;  ///< [-20, 20], unit 0.01: decodes to exactly n / 100.0
  PlanePoint centre;               ///< where the RSU expects the car's centre then
};

/// An acceleration from the issue of the message until its lifetime ends: a path of one point. Or one that changes on
/// the way: a path of several. Or a speed, for the car to get to by itself: a path of one point that has a speed and no
/// acceleration.
struct GuidedPath {
  PlanePoint centre;  ///< where the RSU holds the car's centre to be at the issue; the standard requires it
  double acceleration_mps2 = 0.0;        ///< [-20, 20], unit 0.01: decodes to exactly n / 100.0; 0 with a speed
  std::uint32_t lifetime_ms = 0;         ///< from the issue, [10, 655340], unit 10
  std::optional<double> speed_mps;       ///< [0, 163.8], unit 0.02: decodes to exactly n / 50.0; then `later` is empty
  std::vector<LaterAcceleration> later;  ///< in the order of time, at most kMaxPathPoints - 1
};

/// Points of a path that we write and read; ours.
inline constexpr std::size_t kMaxPathPoints = 32;

/// What the RSU asks of one car.
struct VehicleCoordination {
  std::uint64_t vehicle = 0;       ///< temporary id of the car
  std::optional<GuidedPath> path;  ///< empty = release: the car drives on its own
  Binding binding = Binding::kGuard;
};

/// What the RSU recommends to everybody on a lane.
struct LaneSpeed {
  Lane lane{};
  double speed_mps = 0.0;         ///< [0, 163.8], unit 0.02: decodes to exactly n / 50.0
  std::uint32_t lifetime_ms = 0;  ///< from the issue, [10, 655340], unit 10
};

inline constexpr std::size_t kMaxCoordinations = 16;
inline constexpr std::size_t kMaxLaneCoordinations = 8;

/// Guidance of an RSU (T/CSAE 157, RSC).
struct Coordination {
  std::uint64_t rsu = 0;                      ///< id of the RSU
  std::uint8_t count = 0;                     ///< of this sender's messages of this kind, modulo 128: [0, 127]
  std::uint16_t second_mark_ms = 0;           ///< when it was issued, [0, 59999]; see time_marks.hpp
  std::vector<VehicleCoordination> vehicles;  ///< at most 16
  std::uint16_t node = 0;                     ///< id of the intersection that the lanes lead to
  std::vector<LaneSpeed> lanes;               ///< at most 8
};

/// False if an acceleration, a speed, a time or a lifetime is not a number or does not fit its field, or if the points
/// of the path are too many or not in the order of time. An advice is never bent: who sends one must ask first.
bool fits(const GuidedPath& path);
bool fits(const LaneSpeed& advice);

/// Appends a frame. Requires count <= 127, second_mark_ms <= 59999, at most 16 vehicles and 8 lanes and that every path
/// and every lane's speed fits.
void append(Frames& frames, const Envelope& envelope, const Coordination& message);
/// Refuses what cannot be decoded, lacks a required field, holds a value outside the standard's range, names more than
/// 16 vehicles or 8 lanes, a lane that is none of our twelve, or has a path of more than kMaxPathPoints points or one
/// whose times do not ascend.
Expected<Coordination> decode_rsc(std::span<const std::uint8_t> payload);

}  // namespace lukou
