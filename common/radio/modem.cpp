#include "common/radio/modem.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

#include "common/core/contract.hpp"
#include "common/core/keyed_random.hpp"
#include "common/radio/path_loss.hpp"

namespace lukou {
namespace {

/// Names of links and of what belongs to them, as `entity` of Purpose::kRadioLink.
enum LinkPart : std::uint32_t { kSender = 0, kReceiver = 1, kDuplicate = 2, kEpoch = 3, kPair = 4 };

constexpr double kSureDeviations = 6.0;  // what lies further from the threshold is not drawn: 1e-9

std::uint64_t mixed(std::uint64_t seed, LinkPart part, std::uint64_t number) {
  return random_bits({.run_seed = seed, .purpose = Purpose::kRadioLink, .entity = part, .index = number});
}

/// A number for the two stations, whoever sends.
std::uint64_t pair_of(std::uint64_t seed, const Hop& hop) {
  const auto [low, high] = std::minmax(hop.sender, hop.receiver);
  return mixed(seed, kPair, mixed(seed, kPair, low) ^ high);
}

DrawKey draw_of(std::uint64_t seed, Purpose purpose, std::uint64_t link, std::uint32_t entity) {
  return {.run_seed = seed, .purpose = purpose, .entity = entity, .index = link};
}

/// A number for the frames of one kind in one step.
std::uint32_t frame_number(const Hop& hop) {
  constexpr Step kKinds = 8;
  LUKOU_EXPECT(hop.kind < kKinds);
  return static_cast<std::uint32_t>(hop.sent * kKinds + hop.kind);
}

/// Eclipse MOSAIC's factor for the latency of a cell, by the speed of the car.
double speed_factor(double speed_mps) {
  const double v_kmh = speed_mps * 3.6;
  return std::max(1.0, 1.0 - 9.258e-4 * v_kmh + 7.357e-5 * v_kmh * v_kmh);
}

/// Power over the least one that is heard [dB], without shadowing.
double margin_db(const PathLossModel& model, Sight sight, const PlanePoint& a, const PlanePoint& b) {
  return model.power_dbm + model.antenna_gain_dbi - path_loss_db(model, sight, a, b) - model.sensitivity_dbm;
}

/// Distance up to which a frame in clear sight is strong enough whatever the shadowing [m]. The loss grows with it.
double sure_distance_m(const PathLossModel& model) {
  if (model.law == PathLossModel::Law::kNone) return std::numeric_limits<double>::infinity();
  const double needed_db = kSureDeviations * shadowing_law(model, Sight::kClear).deviation_db;
  double low_m = 0.0;
  double high_m = 1e5;
  for (int i = 0; i < 50; ++i) {
    const double middle_m = 0.5 * (low_m + high_m);
    (margin_db(model, Sight::kClear, {}, {.x_m = middle_m}) >= needed_db ? low_m : high_m) = middle_m;
  }
  return low_m;
}

}  // namespace

Surroundings uplink_surroundings(const RadioParameters& radio) {
  Surroundings around{.keep_probability = radio.keep_probability, .outages = {}};
  std::ranges::copy_if(radio.outages, std::back_inserter(around.outages), &Outage::uplink);
  return around;
}

Surroundings downlink_surroundings(const RadioParameters& radio) {
  Surroundings around{.keep_probability = radio.keep_probability, .outages = {}};
  std::ranges::copy_if(radio.outages, std::back_inserter(around.outages), &Outage::downlink);
  return around;
}

bool hits(const Outage& outage, const Hop& hop) {
  if (hop.sent < outage.from || hop.sent >= outage.to) return false;
  if (outage.rsu && *outage.rsu != hop.rsu) return false;
  if (outage.arm && *outage.arm != arm_of(hop.car)) return false;
  if (!outage.area) return true;
  const Outage::Area& area = *outage.area;
  return hop.car.x_m >= area.x_min_m && hop.car.x_m <= area.x_max_m && hop.car.y_m >= area.y_min_m &&
         hop.car.y_m <= area.y_max_m;
}

Modem::Modem(std::uint64_t seed, const LinkModel& model, const Surroundings& around)
    : seed_(seed), stations_(seed, around.keep_probability), shadowing_(seed) {
  use(model, around);
}

void Modem::use(const LinkModel& model, const Surroundings& around) {
  model_ = model;
  outages_ = around.outages;
  stations_ = Stations(seed_, around.keep_probability);
  shadowing_ = Shadowing(seed_);
  sure_m_ = sure_distance_m(model.path_loss);
  good_to_bad_ = 0.0;
  bad_to_good_ = 1.0;
  if (model.burst_rate <= 0.0) return;
  // Stationary share of the bad state p / (p + r) = rate, mean stay in it 1 / r = mean length.
  LUKOU_EXPECT(model.burst_rate < 1.0 && model.burst_mean_length >= 1.0);
  bad_to_good_ = 1.0 / model.burst_mean_length;
  good_to_bad_ = bad_to_good_ * model.burst_rate / (1.0 - model.burst_rate);
  LUKOU_EXPECT(good_to_bad_ + bad_to_good_ <= 1.0 + 1e-6);
}

Reception Modem::receive(const Hop& hop) const {
  Reception reception;
  if (std::ranges::any_of(outages_, [&](const Outage& outage) { return hits(outage, hop); })) {
    reception.lost = LossCause::kOutage;
    return reception;
  }
  if (hop.distance_m > model_.range_m) {
    reception.lost = LossCause::kRange;
    return reception;
  }
  const std::uint64_t link = link_of(hop);
  reception.lost = loss(link, hop);
  if (reception.lost) return reception;
  reception.first = arrival(link, hop);
  if (model_.duplicate_rate > 0.0 &&
      uniform01(draw_of(seed_, Purpose::kRadioDuplicate, link, frame_number(hop))) < model_.duplicate_rate) {
    // The copy travels by itself, so it may come first.
    reception.second = arrival(mixed(seed_, kDuplicate, link), hop);
    if (reception.second->at_ms < reception.first.at_ms) std::swap(reception.first, *reception.second);
  }
  return reception;
}

std::uint64_t Modem::link_of(const Hop& hop) const {
  Link& kept = links_.of(hop.sender + 0x9e37'79b9'7f4a'7c15 * hop.receiver);
  if (kept.epoch == hop.epoch && kept.sender == hop.sender && kept.receiver == hop.receiver) return kept.number;
  // Two links share a number with a probability of 2^-64. A later start of an RSU has links of its own.
  std::uint64_t number = mixed(seed_, kReceiver, mixed(seed_, kSender, hop.sender) ^ hop.receiver);
  if (hop.epoch > 1) number = mixed(seed_, kEpoch, number ^ hop.epoch);
  kept = {.sender = hop.sender, .receiver = hop.receiver, .epoch = hop.epoch, .number = number};
  return number;
}

std::optional<LossCause> Modem::loss(std::uint64_t link, const Hop& hop) const {
  if (too_weak(hop)) return LossCause::kPathLoss;
  if (model_.half_duplex) {
    const std::uint8_t subframe = stations_.subframe(hop.sender, hop.sent, hop.place);
    if (stations_.deaf(hop.receiver, hop.receiver_frames, subframe, hop.sent)) return LossCause::kHalfDuplex;
  }
  if (model_.collisions && hop.collision_probability > 0.0) {
    // One draw for the reservation: the same two stations meet in each of its frames.
    const std::uint32_t reservation = stations_.reservation(hop.sender, hop.sent).number;
    const std::uint64_t resource = link + hop.place;
    if (uniform01(draw_of(seed_, Purpose::kRadioCollision, resource, reservation)) < hop.collision_probability)
      return LossCause::kCollision;
  }
  if (in_bad_state(link, hop.sent)) return LossCause::kBurst;
  if (model_.loss_rate > 0.0 &&
      uniform01(draw_of(seed_, Purpose::kRadioLoss, link, frame_number(hop))) < model_.loss_rate)
    return LossCause::kRandom;
  return std::nullopt;
}

bool Modem::too_weak(const Hop& hop) const {
  const PathLossModel& model = model_.path_loss;
  if (model.law == PathLossModel::Law::kNone || (!hop.between_cars && hop.distance_m <= sure_m_)) return false;
  Sight sight = Sight::kClear;
  const std::uint64_t pair = pair_of(seed_, hop);
  const DrawKey of_pair{.run_seed = seed_, .purpose = Purpose::kRadioSight, .entity = 0, .index = pair};
  if (hop.between_cars) {
    const double seen = clear_probability(model, hop.distance_m);
    if (around_corner(hop.car, hop.other)) {
      sight = Sight::kCorner;
    } else if (seen < 1.0 && uniform01(of_pair) >= seen) {
      sight = Sight::kBlocked;
    }
  }
  double over_db = margin_db(model, sight, hop.car, hop.other);
  if (sight == Sight::kBlocked) {
    DrawKey key = of_pair;
    key.purpose = Purpose::kRadioBlocker;
    over_db -= std::max(0.0, blocker_mean_db(hop.distance_m) + kBlockerDeviation_db * standard_normal(key));
  }
  const ShadowingLaw law = shadowing_law(model, sight);
  if (over_db >= kSureDeviations * law.deviation_db) return false;
  if (over_db <= -kSureDeviations * law.deviation_db) return true;
  double shadow = 0.0;
  if (!hop.between_cars) {
    shadow = shadowing_.at(pair, hop.car, law.decorrelation_m);
  } else {
    const bool in_order = hop.sender < hop.receiver;
    shadow =
        shadowing_.between(pair, in_order ? hop.car : hop.other, in_order ? hop.other : hop.car, law.decorrelation_m);
  }
  return over_db < law.deviation_db * shadow;
}

bool Modem::in_bad_state(std::uint64_t link, Step step) const {
  if (model_.burst_rate <= 0.0) return false;
  // A transition reads one uniform u: u < p puts the link into the bad state and u >= 1 - r into the good one, whatever
  // it was before; in between it stays. So the newest draw that decides tells the state, and nothing need be kept.
  for (Step at = step; at > 0; --at) {
    const double u = uniform01(draw_of(seed_, Purpose::kRadioBurst, link, static_cast<std::uint32_t>(at)));
    if (u < good_to_bad_) return true;
    if (u >= 1.0 - bad_to_good_) return false;
  }
  // Step 0 finds the link in its stationary state.
  return uniform01(draw_of(seed_, Purpose::kRadioBurst, link, 0)) < model_.burst_rate;
}

double Modem::latency_ms(std::uint64_t link, const Hop& hop) const {
  const LatencyModel& law = model_.latency;
  if (law.law == LatencyModel::Law::kConstant) return std::min(law.min_ms, kLatencyMax_ms);
  const bool uniform = law.law == LatencyModel::Law::kUniform;
  if (law.per_reservation && uniform) {
    const double wait = stations_.wait(hop.sender, hop.sent, hop.place);
    return std::min(law.min_ms + (law.max_ms - law.min_ms) * wait, kLatencyMax_ms);
  }
  DrawKey first = draw_of(seed_, Purpose::kRadioLatency, link, frame_number(hop));
  Purpose second = Purpose::kRadioLatencySecond;
  if (law.per_reservation) {
    // Of the sender's resource, so equal at every receiver.
    first = stations_.wait_key(hop.sender, hop.sent, hop.place);
    second = Purpose::kRadioReservedLatency2nd;
  }
  double drawn_ms = law.min_ms;
  if (uniform) {
    drawn_ms += (law.max_ms - law.min_ms) * uniform01(first);
  } else {
    // Gamma with shape 2 is the sum of two exponentials.
    DrawKey other = first;
    other.purpose = second;
    drawn_ms += (law.mean_ms - law.min_ms) / 2.0 * (unit_exponential(first) + unit_exponential(other));
    if (law.speed_factor) drawn_ms *= speed_factor(hop.car_speed_mps);
  }
  return std::min(drawn_ms, kLatencyMax_ms);
}

Arrival Modem::arrival(std::uint64_t link, const Hop& hop) const {
  constexpr auto kStepLength_ms = static_cast<double>(kStep_ms);
  // A station generates its frames at a fixed phase before each instant: what has no latency is heard at the instant.
  const double latency = latency_ms(link, hop);
  const double after_sent_ms = latency + hop.computing_ms - stations_.phase_ms(hop.sender);
  const auto steps = static_cast<Step>(std::ceil(after_sent_ms / kStepLength_ms));
  return {.due = hop.sent + std::max<Step>(steps, 0),
          .at_ms = static_cast<double>(hop.sent) * kStepLength_ms + after_sent_ms,
          .latency_ms = latency};
}

}  // namespace lukou
