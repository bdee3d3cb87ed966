#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "common/intersection/geometry.hpp"
#include "common/intersection/lane.hpp"

namespace lukou::traffic {

// The defaults below are the fallbacks of idl/scenario.proto (a test compares them); ranges and sources stand there.

/// What every vehicle can do.
struct VehicleParameters {
  double length_m = 4.5;
  double width_m = 1.8;
  double speed_limit_mps = 60.0 / 3.6;
  double acceleration_max_mps2 = 3.0;  ///< both signs
  double actuation_noise_mps2 = 0.2;   ///< standard deviation
};

/// How drivers drive.
struct DrivingParameters {
  double desired_speed_mean = 0.9;  ///< shares of the limit
  double desired_speed_deviation = 0.05;
  double desired_speed_min = 0.75;
  double desired_speed_max = 1.0;
  double initial_speed_min = 0.5;
  double safe_time_s = 1.98;          ///< theta of the safe distance
  double standstill_spacing_m = 5.5;  ///< head to head
  double guard_spacing_m = 5.5;       ///< head to head, at most standstill_spacing_m
  double reaction_distance_m = 150.0;
  double comfortable_braking_mps2 = 0.75;
  double perception_threshold_radps = 6e-4;
  double perception_floor_mps = 0.02;
  double band_near = 1.1;
  double band_far = 0.88;
  double singularity_m = 0.5;
  double speed_relaxation_s = 1.0;
  double gap_closing_mps2 = 1.0;
  double discharge_speed_mps = 10.0 / 3.6;
  double reaction_time_s = 0.1;  ///< T, [0.1, 1.0]
};

/// The units that hear advice.
struct UnitParameters {
  double fallback_s = 1.0;               ///< from the last command to natural driving when an advice ends; 0 = at once
  double rsu_lost_after_s = 2.0;         ///< having heard nothing of the RSU for this long ends its advice
  double speed_gain_time_s = 2.0;        ///< an advised speed becomes the acceleration (wanted - own) / this ...
  double speed_acceleration_mps2 = 2.0;  ///< ... at most this
  double speed_deceleration_mps2 = 1.5;  ///< ... and at least minus this
};

/// Who follows advice, of the cars with a unit; the others are automated and follow exactly.
struct ComplianceParameters {
  double human_share = 0.0;
  double ignoring_share = 0.0;  ///< together at most 1
  double reaction_s = 1.0;      ///< of a human, from the display to the pedal
  double gain_deviation = 0.1;  ///< spread between humans of what they make of a command, as a share of it
  double threshold_mps2 = 0.1;  ///< a human leaves smaller commands alone
};

/// A flow that holds from a time on.
struct Flow {
  double from_s = 0.0;
  double flow_veh_per_h = 0.0;
};

/// How cars arrive at one approach: by a flow that may change over time, or at given times.
struct DemandParameters {
  std::vector<Flow> flows = {{.from_s = 0.0, .flow_veh_per_h = 1800.0}};  ///< by time; before the first it is 0
  bool listed = false;                                                    ///< true: `arrivals_s` alone says who arrives
  std::vector<double> arrivals_s;                                         ///< ascending, >= 0
  std::array<double, kLanesPerApproach> lane_weights = {1.0, 1.0, 1.0};   ///< relative, left to right
};

/// Everything the traffic model needs to know.
struct EngineParameters {
  std::uint64_t seed = 1;
  VehicleParameters vehicles;
  DrivingParameters driving;
  RoadLengths road;
  std::array<DemandParameters, kApproaches> demand;
  double equipped_ratio = 0.7;
  UnitParameters unit;
  ComplianceParameters compliance;
  double overflow_wait_s = 60.0;
};

}  // namespace lukou::traffic
