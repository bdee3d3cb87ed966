#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "common/core/step.hpp"
#include "common/radio/reception_report.hpp"

namespace lukou {

/// What the radio did in a stretch of time, for one direction and kind of frame. A frame counts once per receiver.
struct ReceptionFigures {
  Direction direction{};
  FrameKind kind{};
  std::uint64_t sent = 0;
  std::uint64_t heard = 0;  ///< delivered, duplicates not counted; may have been sent before
  std::uint64_t lost_random = 0;
  std::uint64_t lost_burst = 0;
  std::uint64_t lost_range = 0;
  std::uint64_t lost_path_loss = 0;
  std::uint64_t lost_collision = 0;
  std::uint64_t lost_half_duplex = 0;
  std::uint64_t lost_outage = 0;
  std::uint64_t duplicates = 0;
  /// Of what was heard; empty if nothing was. A percentile is the smallest value that no fewer than its share reach.
  std::optional<double> latency_mean_ms;
  std::optional<double> latency_p95_ms;
  std::optional<double> latency_p99_ms;
  std::optional<double> busy_ratio;  ///< mean of what the reports said; empty if none said anything
};

/// Gathers reports of the radio until they are taken.
class ReceptionMeasures {
 public:
  /// Requires a well-formed report.
  void add(const ReceptionReport& report);
  /// The figures since the last call, sorted by direction and kind: a row for each that was ever reported.
  std::vector<ReceptionFigures> take();
  /// Whether anything was ever reported: the radio is not the ideal one.
  [[nodiscard]] bool any() const { return !gathered_.empty(); }

 private:
  struct Gathered {
    ReceptionFigures figures;
    std::vector<double> latency_ms;
    double busy_sum = 0.0;
    std::uint32_t busy_reports = 0;
  };
  std::map<std::pair<std::uint8_t, std::uint8_t>, Gathered> gathered_;  ///< by direction and kind
};

}  // namespace lukou
