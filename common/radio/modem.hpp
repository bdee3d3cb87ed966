#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "common/core/step.hpp"
#include "common/messages/plane.hpp"
#include "common/radio/kept.hpp"
#include "common/radio/link_model.hpp"
#include "common/radio/shadowing.hpp"
#include "common/radio/stations.hpp"

namespace lukou {

/// A frame on its way to one receiver: what the physics of the radio may know of it, never its payload.
struct Hop {
  std::uint64_t sender = 0;            ///< temporary id of the station
  std::uint64_t receiver = 0;          ///< likewise
  std::uint32_t sequence = 0;          ///< of the frame, per sender and epoch; names it, decides nothing
  std::uint8_t kind = 0;               ///< FrameKind, below 8
  Step sent = 0;                       ///< the step whose instant the frame speaks of
  double distance_m = 0.0;             ///< between the antennas at that instant
  PlanePoint car;                      ///< antenna of the car at that instant; between cars: of the sender
  PlanePoint other;                    ///< antenna of the other station
  bool between_cars = false;           ///< else one end stands on a mast and sees all streets
  std::uint32_t rsu = 0;               ///< index of the RSU at one end
  std::uint32_t epoch = 1;             ///< of the sender: which start of an RSU; 1 for a car
  std::uint32_t place = 0;             ///< of the frame among those that its sender sent in the step
  std::uint32_t receiver_frames = 1;   ///< that the receiver itself sends in a step
  double car_speed_mps = 0.0;          ///< of the car
  double collision_probability = 0.0;  ///< of a reservation of the sender at the receiver
  double computing_ms = 0.0;           ///< that the sender computed before it could generate the frame
};

/// Why a receiver does not hear a frame.
enum class LossCause : std::uint8_t {
  kRandom,      ///< by itself: noise
  kBurst,       ///< the link was in its bad state
  kRange,       ///< the sender was too far away
  kPathLoss,    ///< it was too weak
  kCollision,   ///< another station sent in the same resource
  kHalfDuplex,  ///< the receiver was sending itself
  kOutage,      ///< a planned outage
};

/// When a frame reaches its receiver.
struct Arrival {
  Step due = 0;             ///< the first step whose instant is not before the arrival
  double at_ms = 0.0;       ///< simulated time
  double latency_ms = 0.0;  ///< since the frame was generated, computing before that not included
};

/// What becomes of a frame at one receiver.
struct Reception {
  std::optional<LossCause> lost;  ///< empty: it is heard
  Arrival first;                  ///< if it is heard
  std::optional<Arrival> second;  ///< the duplicate, not before the first
};

/// Longest time that a frame is under way [ms]; a longer draw is cut. Messages carry their time within the minute.
inline constexpr double kLatencyMax_ms = 50'000.0;

/// What all links of a direction have in common with other links.
struct Surroundings {
  double keep_probability = 0.0;  ///< of a resource when its reservation ends, [0, 0.8]
  std::vector<Outage> outages;    ///< of this direction
};
Surroundings uplink_surroundings(const RadioParameters& radio);
Surroundings downlink_surroundings(const RadioParameters& radio);

/// Whether an outage loses a frame; its direction is not looked at.
bool hits(const Outage& outage, const Hop& hop);

/// The receiving half of the radio: decides for each frame whether a station hears it, and when. A pure function of
/// seed, model, and hop: neither the order of questions nor other links can change an answer. Frames of one kind that a
/// station sends in one step share their draws at a receiver, so how much else is sent can change none of them. It
/// keeps draws that it will need again, for speed alone.
class Modem {
 public:
  /// Requires a model within its ranges, as all below.
  Modem(std::uint64_t seed, const LinkModel& model, const Surroundings& around = {});

  /// From now on; the draws stay as they are.
  void use(const LinkModel& model, const Surroundings& around = {});
  [[nodiscard]] Reception receive(const Hop& hop) const;
  /// Whether an answer depends on the hop's `collision_probability` / `car_speed_mps`.
  [[nodiscard]] bool asks_for_collisions() const { return model_.collisions; }
  [[nodiscard]] bool asks_for_speed() const { return model_.latency.speed_factor; }

 private:
  /// The number of a directed link.
  struct Link {
    std::uint64_t sender = 0;
    std::uint64_t receiver = 0;
    std::uint32_t epoch = 0;  ///< 0: not drawn yet
    std::uint64_t number = 0;
  };
  [[nodiscard]] std::uint64_t link_of(const Hop& hop) const;
  [[nodiscard]] std::optional<LossCause> loss(std::uint64_t link, const Hop& hop) const;
  [[nodiscard]] bool too_weak(const Hop& hop) const;
  [[nodiscard]] bool in_bad_state(std::uint64_t link, Step step) const;
  [[nodiscard]] double latency_ms(std::uint64_t link, const Hop& hop) const;
  [[nodiscard]] Arrival arrival(std::uint64_t link, const Hop& hop) const;

  std::uint64_t seed_;
  LinkModel model_;
  std::vector<Outage> outages_;
  double good_to_bad_ = 0.0;  ///< probability per step
  double bad_to_good_ = 1.0;
  double sure_m_ = 0.0;  ///< in clear sight a frame is strong enough up to here, whatever is drawn
  mutable Kept<Link> links_{1024};
  mutable Stations stations_;
  mutable Shadowing shadowing_;
};

}  // namespace lukou
