#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "common/core/step.hpp"

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
  double max_ms = 0.0;           ///< of kUniform, at least min_ms
  double mean_ms = 0.0;          ///< of kGamma, at least min_ms
  bool per_reservation = false;  ///< drawn once for a reservation of the sender, for all receivers; else for each frame
  bool speed_factor = false;     ///< of kGamma: grows with the speed of the car
};

/// How a signal weakens with distance, and below which power nothing is heard.
struct PathLossModel {
  enum class Law : std::uint8_t { kNone, kTr37885, kWinnerB1 };
  Law law = Law::kNone;
  double power_dbm = 23.0;
  double antenna_gain_dbi = 6.0;   ///< of both ends together
  double sensitivity_dbm = -90.5;  ///< least power that is heard
  double antenna_height_m = 1.5;   ///< effective, of kWinnerB1

  friend bool operator==(const PathLossModel&, const PathLossModel&) = default;
};

/// Everything that happens to a frame on its way. The defaults are the ideal link: all is heard at once.
struct LinkModel {
  LatencyModel latency;
  double loss_rate = 0.0;          ///< of frames lost one by one, [0, 1]
  double burst_rate = 0.0;         ///< share of the steps in which the link is in its bad state, [0, 1)
  double burst_mean_length = 1.0;  ///< of a stay there, steps: at least 1 / (1 - burst_rate) if burst_rate > 0
  double range_m = std::numeric_limits<double>::infinity();  ///< between the antennas; beyond it nothing is heard
  double duplicate_rate = 0.0;                               ///< of heard frames that arrive a second time, [0, 1]
  PathLossModel path_loss;
  bool half_duplex = false;  ///< who sends in a subframe hears nothing in it
  bool collisions = false;   ///< frames in the same resource disturb each other; needs a load
};

/// How full the channel is, by what the stations send.
struct LoadModel {
  bool counted = false;
  std::uint32_t sub_channels = 4;             ///< that share a subframe of 1 ms
  std::uint32_t bytes_per_sub_channel = 190;  ///< of a frame with its security
  std::uint32_t security_bytes = 95;          ///< on top of each frame's wire_bytes
  double sir_threshold_db = 4.0;              ///< below it the interferer wins
  PathLossModel path_loss;                    ///< between any two stations

  friend bool operator==(const LoadModel&, const LoadModel&) = default;
};

/// The arms of the junction, as the approaches are numbered.
enum class Arm : std::uint8_t { kWest = 0, kSouth = 1, kEast = 2, kNorth = 3 };

/// A planned stretch of time in which frames of some stations are lost.
struct Outage {
  struct Area {
    double x_min_m = 0.0;
    double x_max_m = 0.0;
    double y_min_m = 0.0;
    double y_max_m = 0.0;
  };
  Step from = 0;  ///< frames of this step and those after it ...
  Step to = 0;    ///< ... until this one, not included
  bool uplink = true;
  bool downlink = true;
  std::optional<std::uint32_t> rsu;  ///< of this one alone
  std::optional<Arm> arm;            ///< cars on this arm alone
  std::optional<Area> area;          ///< cars in this rectangle alone
};

/// The radio of a run.
struct RadioParameters {
  std::uint64_t seed = 0;
  bool modelled = false;                        ///< false: the ideal radio, without a draw or a report
  LinkModel uplink;                             ///< car to RSU
  LinkModel downlink;                           ///< RSU to car
  std::optional<LinkModel> vehicle_to_vehicle;  ///< empty: nobody draws for it
  double awareness_m = 150.0;                   ///< between cars, beyond it nobody draws
  double keep_probability = 0.0;                ///< of a resource when its reservation ends, [0, 0.8]
  LoadModel load;
  std::vector<Outage> outages;
};

}  // namespace lukou
