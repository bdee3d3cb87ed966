#include "common/radio/modem.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/core/contract.hpp"
#include "common/core/keyed_random.hpp"
#include "common/core/math.hpp"

namespace lukou {
namespace {

/// Names of links and of what belongs to them, as `entity` of Purpose::kRadioLink.
enum LinkPart : std::uint32_t { kSender = 0, kReceiver = 1, kDuplicate = 2 };

std::uint64_t mixed(std::uint64_t seed, LinkPart part, std::uint64_t number) {
  return random_bits({.run_seed = seed, .purpose = Purpose::kRadioLink, .entity = part, .index = number});
}

/// A number for the directed link. Two links share one with a probability of 2^-64.
std::uint64_t link_between(std::uint64_t seed, std::uint64_t sender, std::uint64_t receiver) {
  return mixed(seed, kReceiver, mixed(seed, kSender, sender) ^ receiver);
}

DrawKey draw_of(std::uint64_t seed, Purpose purpose, std::uint64_t link, std::uint32_t sequence) {
  return {.run_seed = seed, .purpose = purpose, .entity = sequence, .index = link};
}

}  // namespace

Modem::Modem(std::uint64_t seed, const LinkModel& model) : seed_(seed) { use(model); }

void Modem::use(const LinkModel& model) {
  model_ = model;
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
  if (hop.distance_m > model_.range_m) {
    reception.lost = LossCause::kRange;
    return reception;
  }
  const std::uint64_t link = link_between(seed_, hop.sender, hop.receiver);
  const auto happens = [&](Purpose purpose, double rate) {
    return rate > 0.0 && uniform01(draw_of(seed_, purpose, link, hop.sequence)) < rate;
  };
  if (in_bad_state(link, hop.sequence)) {
    reception.lost = LossCause::kBurst;
  } else if (happens(Purpose::kRadioLoss, model_.loss_rate)) {
    reception.lost = LossCause::kRandom;
  }
  if (reception.lost) return reception;
  reception.first = arrival(link, hop);
  if (happens(Purpose::kRadioDuplicate, model_.duplicate_rate)) {
    // The copy travels by itself, so it may come first.
    reception.second = arrival(mixed(seed_, kDuplicate, link), hop);
    if (reception.second->at_ms < reception.first.at_ms) std::swap(reception.first, *reception.second);
  }
  return reception;
}

bool Modem::in_bad_state(std::uint64_t link, std::uint32_t sequence) const {
  if (model_.burst_rate <= 0.0) return false;
  // A transition reads one uniform u: u < p puts the link into the bad state and u >= 1 - r into the good one, whatever
  // it was before; in between it stays. So the newest draw that decides tells the state, and nothing need be kept.
  for (std::uint32_t at = sequence; at > 0; --at) {
    const double u = uniform01(draw_of(seed_, Purpose::kRadioBurst, link, at));
    if (u < good_to_bad_) return true;
    if (u >= 1.0 - bad_to_good_) return false;
  }
  // The first frame of a sender finds the link in its stationary state.
  return uniform01(draw_of(seed_, Purpose::kRadioBurst, link, 0)) < model_.burst_rate;
}

double Modem::latency_ms(std::uint64_t link, std::uint32_t sequence) const {
  const LatencyModel& law = model_.latency;
  const auto key = [&](Purpose purpose) { return draw_of(seed_, purpose, link, sequence); };
  double drawn_ms = law.min_ms;
  switch (law.law) {
    case LatencyModel::Law::kConstant:
      break;
    case LatencyModel::Law::kUniform:
      drawn_ms += (law.max_ms - law.min_ms) * uniform01(key(Purpose::kRadioLatency));
      break;
    case LatencyModel::Law::kGamma:
      // Gamma with shape 2 is the sum of two exponentials.
      drawn_ms += (law.mean_ms - law.min_ms) / 2.0 *
                  (unit_exponential(key(Purpose::kRadioLatency)) + unit_exponential(key(Purpose::kRadioLatencySecond)));
      break;
  }
  return std::min(drawn_ms, kLatencyMax_ms);
}

Arrival Modem::arrival(std::uint64_t link, const Hop& hop) const {
  constexpr auto kStepLength_ms = static_cast<double>(kStep_ms);
  // A station generates its frames at a fixed phase before each instant: what has no latency is heard at the instant.
  const double phase_ms = kStepLength_ms * uniform01(draw_of(seed_, Purpose::kRadioPhase, hop.sender, 0));
  const double latency = latency_ms(link, hop.sequence);
  const double after_sent_ms = latency - phase_ms;
  const auto steps = static_cast<Step>(std::ceil(after_sent_ms / kStepLength_ms));
  return {.due = hop.sent + std::max<Step>(steps, 0),
          .at_ms = static_cast<double>(hop.sent) * kStepLength_ms + after_sent_ms,
          .latency_ms = latency};
}

}  // namespace lukou
