#pragma once

#include <cstdint>
#include <vector>

#include "common/core/step.hpp"
#include "common/radio/modem.hpp"

namespace lukou {

/// In FrameFates::fate: the frame is heard; 1 + LossCause: it is lost. The values stand on the bus.
inline constexpr std::uint8_t kFrameHeard = 0;
inline constexpr std::uint8_t kFrameFates = 8;

/// What one receiver's modem decided on the frames of a step, a row per frame in their order.
struct FrameFates {
  std::vector<std::uint8_t> fate;
  std::vector<Step> due;           ///< the step in which it is heard; -1: lost
  std::vector<double> latency_ms;  ///< not a number: lost

  [[nodiscard]] std::size_t size() const { return fate.size(); }
  void clear();
  void add(const Reception& reception);
  void add(const FrameFates& others);
  /// Whether the columns have one length and every fate is known.
  [[nodiscard]] bool well_formed() const;
};

}  // namespace lukou
