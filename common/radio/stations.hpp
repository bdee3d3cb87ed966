#pragma once

#include <cstdint>
#include <vector>

#include "common/core/keyed_random.hpp"
#include "common/core/step.hpp"
#include "common/radio/kept.hpp"

namespace lukou {

/// A time for which a station of mode 4 keeps its resource.
struct Reservation {
  std::uint32_t number = 0;  ///< equal as long as the resource is
  Step from = 0;             ///< steps [from, to) at least
  Step to = 0;
};

/// What the draws know of each station: its phase, its reservations and their subframes. Pure functions of seed,
/// station and step; what was drawn is kept for speed alone.
class Stations {
 public:
  /// keep_probability in [0, 0.8].
  Stations(std::uint64_t seed, double keep_probability) : seed_(seed), keep_probability_(keep_probability) {}

  /// Time before an instant at which a station generates its frames [ms], in (0, 100).
  double phase_ms(std::uint64_t station);
  /// The reservation that holds in a step, at least 0. Lengths are 5 ... 15 steps, mean 10, or several of these if the
  /// resource is kept.
  const Reservation& reservation(std::uint64_t station, Step step);
  /// Which of 100 subframes of 1 ms a station uses for its frame number `place` of a step.
  std::uint8_t subframe(std::uint64_t station, Step step, std::uint32_t place);
  /// A uniform in (0, 1) for the wait of a reservation's frames, by place, and the key it is drawn with.
  double wait(std::uint64_t station, Step step, std::uint32_t place);
  DrawKey wait_key(std::uint64_t station, Step step, std::uint32_t place);
  /// Whether a station hears nothing in the subframe of a frame because it sends in it one of its own `frames`.
  bool deaf(std::uint64_t station, std::uint32_t frames, std::uint8_t subframe, Step step);

 private:
  struct Known {
    double phase_ms = 0.0;  ///< 0: not drawn yet
    Step offset = 0;        ///< of its grid of reservations
    Reservation reservation{0, 1, 0};
    std::vector<std::uint8_t> subframes;  ///< of the reservation, by place
    double first_wait = 0.0;              ///< of the reservation's first place; 0: not drawn yet
  };
  Known& known(std::uint64_t station);
  Known& known_at(std::uint64_t station, Step step);
  std::uint8_t subframe_of(Known& in, std::uint64_t station, std::uint32_t place) const;
  [[nodiscard]] Step boundary(std::uint64_t station, Step cell) const;

  std::uint64_t seed_;
  double keep_probability_;
  Kept<Known> known_{1024};
};

}  // namespace lukou
