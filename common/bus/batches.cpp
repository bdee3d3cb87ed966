#include "common/bus/batches.hpp"

namespace lukou {

bool SensedColumns::well_formed() const {
  const std::size_t rows = rsu.size();
  return sensor.size() == rows && track.size() == rows && x_m.size() == rows && y_m.size() == rows &&
         speed_mps.size() == rows && heading_rad.size() == rows && length_class.size() == rows &&
         measured.size() == rows;
}

void SensedColumns::clear() {
  rsu.clear(), sensor.clear(), track.clear(), x_m.clear(), y_m.clear();
  speed_mps.clear(), heading_rad.clear(), length_class.clear(), measured.clear();
}

void TrafficBatch::clear() {
  // Keeps the storage: steady steps allocate nothing.
  const auto empty = [](auto&... columns) { (columns.clear(), ...); };
  empty(vehicle, lane, state, equipped, position_m, speed_mps, acceleration_mps2, commanded_mps2, noise_mps2);
  empty(guidance, bound_by, missed);
  empty(arrived, waiting, arrived_equipped, waiting_equipped);
  empty(entered_vehicle, entered_lane, entered_equipped, entered_speed_mps, entered_desired_speed_mps);
  empty(crossed_vehicle, crossed_time_s, crossed_aspect, crossed_committed);
  empty(left_vehicle, left_time_s);
  empty(fate_vehicle, fate_rsu, fate_sequence, fate, fate_again, fate_issued, fate_commanded_mps2);
  empty(fate_kind, fate_speed_mps, computing_ms, uplink_vehicle, uplink_rsu);
  uplink.clear();
  air.clear(), sensed.clear(), said.clear();
  empty(said_rsu, asked_rsu, asked_lanes, asked_lifetime);
  answers_malformed = 0;
  requests_refused = 0;
  guard_interventions = 0;
  overflow = 0;
  heard_epoch.clear();
  reception.clear();
}

}  // namespace lukou
