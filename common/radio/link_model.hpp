#pragma once

#include <cstdint>
#include <limits>

namespace lukou {

// The laws of the air for one direction. Formulas, units and sources: docs/radio.md. Ranges stand in
// idl/scenario.proto.

/// How long a frame travels, from its generation to its reception.
struct LatencyModel {
  enum class Law : std::uint8_t {
    kConstant,  ///< min_ms
    kUniform,   ///< uniform in [min_ms, max_ms]
    kGamma,     ///< min_ms + Gamma(2, (mean_ms - min_ms) / 2)
  };
  Law law = Law::kConstant;
  double min_ms = 0.0;
  double max_ms = 0.0;   ///< of kUniform, at least min_ms
  double mean_ms = 0.0;  ///< of kGamma, at least min_ms
};

/// Everything that happens to a frame on its way. The defaults are the ideal link: all is heard at once.
struct LinkModel {
  LatencyModel latency;
  double loss_rate = 0.0;          ///< of frames lost one by one, [0, 1]
  double burst_rate = 0.0;         ///< of frames lost in bursts, [0, 1)
  double burst_mean_length = 1.0;  ///< frames of the sender, at least 1 / (1 - burst_rate) if burst_rate > 0
  double range_m = std::numeric_limits<double>::infinity();  ///< between the antennas; beyond it nothing is heard
  double duplicate_rate = 0.0;                               ///< of heard frames that arrive a second time, [0, 1]
};

/// The radio of a run.
struct RadioParameters {
  std::uint64_t seed = 0;
  bool modelled = false;  ///< false: the ideal radio, without a draw or a report
  LinkModel uplink;       ///< car to RSU
  LinkModel downlink;     ///< RSU to car
};

}  // namespace lukou
