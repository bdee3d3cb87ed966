#include "common/radio/stations.hpp"

#include "common/core/keyed_random.hpp"

namespace lukou {
namespace {

constexpr Step kGrid = 10;       // steps between two marks of a station's reservations
constexpr int kJitters = 6;      // a mark is late by 0 ... 5 steps
constexpr int kSubframes = 100;  // of 1 ms in a step

}  // namespace

Stations::Known& Stations::known(std::uint64_t station) {
  Known& of = known_.of(station);
  if (of.phase_ms > 0.0) return of;
  of.phase_ms = static_cast<double>(kStep_ms) *
                uniform01({.run_seed = seed_, .purpose = Purpose::kRadioPhase, .entity = 0, .index = station});
  // Grids of different stations do not stand in step. Entity 0 is no mark: marks count from 1.
  of.offset = static_cast<Step>(
      static_cast<double>(kGrid) *
      uniform01({.run_seed = seed_, .purpose = Purpose::kRadioReservation, .entity = 0, .index = station}));
  return of;
}

Step Stations::boundary(std::uint64_t station, Step cell) const {
  const double u = uniform01({.run_seed = seed_,
                              .purpose = Purpose::kRadioReservation,
                              .entity = static_cast<std::uint32_t>(cell),
                              .index = station});
  return kGrid * cell + static_cast<Step>(kJitters * u);
}

Stations::Known& Stations::known_at(std::uint64_t station, Step step) {
  Known& of = known(station);
  if (step >= of.reservation.from && step < of.reservation.to) return of;
  // Marks are counted from 2 on, so that the mark before the first step has a number, too.
  const Step shift = 2 * kGrid + of.offset;
  const Step at = step + shift;
  Step cell = at / kGrid;
  Step begin = boundary(station, cell);
  Step end = 0;
  if (begin > at) {
    end = begin;
    begin = boundary(station, --cell);
  } else {
    end = boundary(station, cell + 1);
  }
  // The resource is that of the newest mark at which it was not kept.
  auto number = static_cast<std::uint32_t>(cell);
  while (keep_probability_ > 0.0 && number > 1 &&
         uniform01({.run_seed = seed_, .purpose = Purpose::kRadioKeep, .entity = number, .index = station}) <
             keep_probability_) {
    --number;
  }
  if (number != of.reservation.number) {
    of.subframes.clear();
    of.first_wait = 0.0;
  }
  of.reservation = {.number = number, .from = begin - shift, .to = end - shift};
  return of;
}

double Stations::phase_ms(std::uint64_t station) { return known(station).phase_ms; }

const Reservation& Stations::reservation(std::uint64_t station, Step step) {
  return known_at(station, step).reservation;
}

std::uint8_t Stations::subframe_of(Known& in, std::uint64_t station, std::uint32_t place) const {
  while (in.subframes.size() <= place) {
    const std::uint64_t next = in.subframes.size();
    in.subframes.push_back(static_cast<std::uint8_t>(kSubframes * uniform01({.run_seed = seed_,
                                                                             .purpose = Purpose::kRadioSubframe,
                                                                             .entity = in.reservation.number,
                                                                             .index = station + (next << 56U)})));
  }
  return in.subframes[place];
}

std::uint8_t Stations::subframe(std::uint64_t station, Step step, std::uint32_t place) {
  return subframe_of(known_at(station, step), station, place);
}

DrawKey Stations::wait_key(std::uint64_t station, Step step, std::uint32_t place) {
  return {.run_seed = seed_,
          .purpose = Purpose::kRadioReservedLatency,
          .entity = reservation(station, step).number,
          .index = station + (static_cast<std::uint64_t>(place) << 56U)};
}

double Stations::wait(std::uint64_t station, Step step, std::uint32_t place) {
  if (place > 0) return uniform01(wait_key(station, step, place));
  Known& of = known_at(station, step);
  if (of.first_wait == 0.0) of.first_wait = uniform01(wait_key(station, step, 0));
  return of.first_wait;
}

bool Stations::deaf(std::uint64_t station, std::uint32_t frames, std::uint8_t subframe, Step step) {
  Known& of = known_at(station, step);
  for (std::uint32_t place = 0; place < frames; ++place) {
    if (subframe_of(of, station, place) == subframe) return true;
  }
  return false;
}

}  // namespace lukou
