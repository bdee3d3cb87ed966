#include "common/radio/between_cars.hpp"

#include <cstddef>

namespace lukou {

BetweenCars::BetweenCars(const RadioParameters& radio) : seed_(radio.seed) { use(radio); }

void BetweenCars::use(const RadioParameters& radio) {
  modem_.reset();
  if (!radio.vehicle_to_vehicle) {
    tally_.clear();
    return;
  }
  awareness_m_ = radio.awareness_m;
  modem_.emplace(seed_, *radio.vehicle_to_vehicle, Surroundings{radio.keep_probability, {}});
}

void BetweenCars::hear(const Frames& air, Step at, ChannelLoad& load) {
  if (!modem_) return;
  tally_.clear();
  if (at % kStepsPerSecond != 0) return;
  if (load.counted()) tally_.busy_ratio = load.busy_ratio_of_cars();
  for (std::size_t a = 0; a < air.size(); ++a) {
    for (std::size_t b = a + 1; b < air.size(); ++b) {
      const double dx_m = air.antenna_x_m[a] - air.antenna_x_m[b];
      if (dx_m > awareness_m_ || dx_m < -awareness_m_) continue;
      const double away_m =
          distance_m({air.antenna_x_m[a], air.antenna_y_m[a]}, {air.antenna_x_m[b], air.antenna_y_m[b]});
      if (away_m > awareness_m_) continue;
      hop(air, a, b, away_m, at, load);
      hop(air, b, a, away_m, at, load);
    }
  }
}

void BetweenCars::hop(const Frames& air, std::size_t from, std::size_t to, double away_m, Step at, ChannelLoad& load) {
  Hop hop{.sender = air.sender[from],
          .receiver = air.sender[to],
          .sequence = air.sequence[from],
          .kind = air.kind[from],
          .sent = at,
          .distance_m = away_m,
          .car = {air.antenna_x_m[from], air.antenna_y_m[from]},
          .other = {air.antenna_x_m[to], air.antenna_y_m[to]},
          .between_cars = true};
  if (modem_->asks_for_collisions()) {
    hop.collision_probability = load.collision_between(hop.car, hop.other, load.width(air.wire_bytes[from]));
  }
  const Reception reception = modem_->receive(hop);
  tally_.count_sent(reception);
  if (reception.lost) return;
  tally_.count_delivered(reception.first.latency_ms, false);
  if (reception.second) tally_.count_delivered(reception.second->latency_ms, true);
}

}  // namespace lukou
