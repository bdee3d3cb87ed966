#pragma once

#include <cstdint>
#include <optional>

#include "common/core/step.hpp"
#include "common/radio/link_model.hpp"

namespace lukou {

/// A frame on its way to one receiver: what the physics of the radio may know of it, never its payload.
struct Hop {
  std::uint64_t sender = 0;    ///< temporary id of the station
  std::uint64_t receiver = 0;  ///< likewise
  std::uint32_t sequence = 0;  ///< of the frame, per sender
  Step sent = 0;               ///< the step whose instant the frame speaks of
  double distance_m = 0.0;     ///< between the antennas at that instant
};

/// Why a receiver does not hear a frame.
enum class LossCause : std::uint8_t {
  kRandom,  ///< by itself: noise
  kBurst,   ///< the link was in its bad state
  kRange,   ///< the sender was too far away
};

/// When a frame reaches its receiver.
struct Arrival {
  Step due = 0;             ///< the first step whose instant is not before the arrival
  double at_ms = 0.0;       ///< simulated time
  double latency_ms = 0.0;  ///< since the frame was generated
};

/// What becomes of a frame at one receiver.
struct Reception {
  std::optional<LossCause> lost;  ///< empty: it is heard
  Arrival first;                  ///< if it is heard
  std::optional<Arrival> second;  ///< the duplicate, not before the first
};

/// Longest time that a frame is under way [ms]; a longer draw is cut. Messages carry their time within the minute.
inline constexpr double kLatencyMax_ms = 50'000.0;

/// The receiving half of the radio: decides for each frame whether a station hears it, and when. A pure function of
/// seed, model, and hop: neither the order of questions nor other links can change an answer.
class Modem {
 public:
  /// Requires a model within its ranges, as all below.
  Modem(std::uint64_t seed, const LinkModel& model);

  /// From now on; the draws stay as they are.
  void use(const LinkModel& model);
  [[nodiscard]] Reception receive(const Hop& hop) const;

 private:
  [[nodiscard]] bool in_bad_state(std::uint64_t link, std::uint32_t sequence) const;
  [[nodiscard]] double latency_ms(std::uint64_t link, std::uint32_t sequence) const;
  [[nodiscard]] Arrival arrival(std::uint64_t link, const Hop& hop) const;

  std::uint64_t seed_;
  LinkModel model_;
  double good_to_bad_ = 0.0;  ///< probability per frame
  double bad_to_good_ = 1.0;
};

}  // namespace lukou
