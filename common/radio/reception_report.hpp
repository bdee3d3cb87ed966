#pragma once

#include <cstdint>
#include <limits>
#include <string_view>
#include <vector>

#include "common/messages/frames.hpp"
#include "common/radio/modem.hpp"

namespace lukou {

/// Which way a frame goes; the values stand on the bus.
enum class Direction : std::uint8_t { kUplink = 0, kDownlink = 1, kVehicleToVehicle = 2 };

/// "uplink", "downlink", "v2v": as in radio.csv.
std::string_view name(Direction direction);

/// Counts what became of frames of one kind in one direction. A frame counts once per receiver.
struct ReceptionTally {
  std::uint32_t sent = 0;   ///< that the modem has decided on
  std::uint32_t heard = 0;  ///< delivered, duplicates not counted
  std::uint32_t lost_random = 0;
  std::uint32_t lost_burst = 0;
  std::uint32_t lost_range = 0;
  std::uint32_t lost_path_loss = 0;
  std::uint32_t lost_collision = 0;
  std::uint32_t lost_half_duplex = 0;
  std::uint32_t lost_outage = 0;
  std::uint32_t duplicates = 0;  ///< delivered a second time
  /// Share of the channel in use where the receivers stand, [0, 1]; not a number: not counted.
  double busy_ratio = std::numeric_limits<double>::quiet_NaN();
  std::vector<double> latency_ms;  ///< of each that was heard, in order

  void clear();
  void count_sent(const Reception& reception);
  void count_delivered(double latency, bool duplicate);
};

/// What the radio did in a step, a row per direction and kind of frame; empty under the ideal radio. It speaks of the
/// frames sent at the instant and of those delivered at it, which may have been sent before.
struct ReceptionReport {
  std::vector<std::uint8_t> direction;  ///< Direction
  std::vector<std::uint8_t> kind;       ///< FrameKind
  std::vector<std::uint32_t> sent;
  std::vector<std::uint32_t> heard;
  std::vector<std::uint32_t> lost_random;
  std::vector<std::uint32_t> lost_burst;
  std::vector<std::uint32_t> lost_range;
  std::vector<std::uint32_t> duplicates;
  std::vector<std::uint32_t> lost_path_loss;
  std::vector<std::uint32_t> lost_collision;
  std::vector<std::uint32_t> lost_half_duplex;
  std::vector<std::uint32_t> lost_outage;
  std::vector<double> busy_ratio;  ///< [0, 1]; not a number: not counted
  std::vector<double> latency_ms;  ///< `heard` values of the first row, then of the second, ...

  [[nodiscard]] std::size_t size() const { return direction.size(); }
  void clear();
  void add(Direction way, FrameKind frames, const ReceptionTally& tally);
  void add(const ReceptionReport& other);
  /// Whether every column has its length: a report from the bus must be asked first.
  [[nodiscard]] bool well_formed() const;
};

}  // namespace lukou
