#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "common/core/expected.hpp"
#include "common/intersection/lane.hpp"
#include "common/messages/frames.hpp"
#include "common/messages/plane.hpp"

namespace lukou {

/// Ids of the nodes in the west, south, east and north from which our links come: 11 to 14.
inline constexpr std::uint32_t kFirstNeighbour = 11;

/// An approach lane as the MAP draws it: a straight line from its entrance to its stop line.
struct MapLane {
  PlanePoint entrance;  ///< on the lane's centre line
  PlanePoint stop_line;
};

/// The intersection as the RSU tells it (T/CSAE 53, MAP): four links of three lanes.
struct MapData {
  std::uint8_t count = 0;            ///< of this sender's messages of this kind, modulo 128: [0, 127]
  std::uint32_t minute_of_year = 0;  ///< [0, 527039]
  std::uint16_t node = 0;            ///< id of the intersection, [0, 65535]
  double lane_width_m = 0.0;         ///< [0, 109.22], unit 0.01
  double speed_limit_mps = 0.0;      ///< [0, 163.8], unit 0.02
  std::array<MapLane, kLanes> lanes;
};

/// Appends a frame. Values beyond a field's range saturate. Requires count <= 127 and minute_of_year <= 527039.
void append(Frames& frames, const Envelope& envelope, const MapData& message);
/// Refuses what cannot be decoded, lacks a required field or a lane, or holds a value outside the standard's range.
Expected<MapData> decode_map(std::span<const std::uint8_t> payload);

}  // namespace lukou
