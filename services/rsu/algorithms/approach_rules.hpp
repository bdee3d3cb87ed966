#pragma once

namespace lukou {

/// What the algorithms that steer a car to a crossing time have in common; the scenario says what each is.
struct ApproachRules {
  double acceleration_max_mps2 = 3.0;  ///< of every car, both signs
  double activation_distance_m = 500.0;
  double speed_min_mps = 18.0 / 3.6;
  double target_speed_share = 0.9;
  double speeding_up_mps2 = 2.0;
  double slowing_down_mps2 = 1.5;
  double first_crossing_s = 1.5;
  double tail_s = 2.5;
  double slack_s = 1.0;
  double gain_time_s = 2.0;
  double lifetime_s = 0.5;
};

/// How a queue discharges: its cars stand `spacing_m` apart and cross `headway_s` apart.
struct QueueRules {
  double headway_s = 2.0;
  double spacing_m = 5.6;
  double equipped_share = 1.0;  ///< of all cars, as far as the RSU is told; 1 = no car is guessed
};

}  // namespace lukou
