#include "common/radio/modem.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace lukou {
namespace {

constexpr std::uint64_t kSeed = 7;
constexpr Step kSent = 1000;

/// The frame of a station `number` steps after kSent.
Hop hop(std::uint32_t number, std::uint64_t sender = 11, std::uint64_t receiver = 22) {
  return {
      .sender = sender, .receiver = receiver, .sequence = number, .sent = kSent + Step{number}, .distance_m = 100.0};
}

LinkModel constant(double latency_ms) {
  return {.latency = {.law = LatencyModel::Law::kConstant, .min_ms = latency_ms}};
}

/// Where in the step the sender generates its frames, before the instant [ms].
double phase_ms(std::uint64_t sender) {
  const Reception heard = Modem(kSeed, constant(0.0)).receive(hop(0, sender));
  return static_cast<double>(kSent) * 100.0 - heard.first.at_ms;
}

TEST(Modem, OfAnIdealLinkHearsEveryFrameAtItsInstantHoweverFar) {
  const Modem modem(kSeed, LinkModel{});
  for (std::uint32_t n = 0; n < 1000; ++n) {
    Hop far = hop(n, n);
    far.distance_m = 1e7;
    const Reception heard = modem.receive(far);
    ASSERT_FALSE(heard.lost);
    EXPECT_EQ(heard.first.due, far.sent);
    EXPECT_EQ(heard.first.latency_ms, 0.0);
    EXPECT_FALSE(heard.second);
  }
}

TEST(Modem, DeliversAtTheFirstInstantThatIsNotBeforeTheArrival) {
  for (const double latency_ms : {0.4, 5.0, 99.0, 100.0, 150.0, 1234.5}) {
    const Modem modem(kSeed, constant(latency_ms));
    for (std::uint64_t sender = 0; sender < 200; ++sender) {
      const Arrival arrival = modem.receive(hop(0, sender)).first;
      EXPECT_LE(arrival.at_ms, static_cast<double>(arrival.due) * 100.0);
      EXPECT_GT(arrival.at_ms, static_cast<double>(arrival.due - 1) * 100.0);
      EXPECT_NEAR(arrival.at_ms, static_cast<double>(kSent) * 100.0 - phase_ms(sender) + latency_ms, 1e-6);
    }
  }
}

TEST(Modem, GivesEverySenderAPhaseOfItsOwnThatStays) {
  // Phases are uniform in (0, 100) ms: a mean of 50 with a deviation of 100 / sqrt(12 n) = 0.29 for n = 10,000; 5 of
  // these are 1.5. With a latency of 5 ms those with a phase below 5 ms come a step later: 5 % of them, 4 deviations
  // of sqrt(0.05 * 0.95 / n) = 0.0022 are 0.009. With 95 ms it is 95 %.
  constexpr std::uint64_t kSenders = 10'000;
  double sum_ms = 0.0;
  int later_5 = 0;
  int later_95 = 0;
  const Modem fast(kSeed, constant(5.0));
  const Modem slow(kSeed, constant(95.0));
  for (std::uint64_t sender = 0; sender < kSenders; ++sender) {
    const double phase = phase_ms(sender);
    ASSERT_GT(phase, 0.0);
    ASSERT_LT(phase, 100.0);
    sum_ms += phase;
    later_5 += fast.receive(hop(0, sender)).first.due == kSent + 1 ? 1 : 0;
    later_95 += slow.receive(hop(0, sender)).first.due == kSent + 1 ? 1 : 0;
  }
  EXPECT_NEAR(sum_ms / kSenders, 50.0, 1.5);
  EXPECT_NEAR(later_5 / 10'000.0, 0.05, 0.009);
  EXPECT_NEAR(later_95 / 10'000.0, 0.95, 0.009);
}

TEST(Modem, HearsNothingBeyondItsRange) {
  LinkModel model;
  model.range_m = 509.4;
  const Modem modem(kSeed, model);
  Hop at = hop(0);
  at.distance_m = 509.4;
  EXPECT_FALSE(modem.receive(at).lost);
  at.distance_m = 509.5;
  EXPECT_EQ(modem.receive(at).lost, LossCause::kRange);
}

TEST(Modem, LosesAllAtARateOfOneAndNothingAtZero) {
  LinkModel model;
  model.loss_rate = 1.0;
  const Modem deaf(kSeed, model);
  for (std::uint32_t n = 0; n < 1000; ++n) EXPECT_EQ(deaf.receive(hop(n)).lost, LossCause::kRandom);
}

TEST(Modem, LosesNoMoreFramesWhenTheRateFallsAndLeavesTheRestAsItWas) {
  LinkModel model = {.latency = {.law = LatencyModel::Law::kUniform, .min_ms = 4.0, .max_ms = 100.0}};
  model.loss_rate = 0.1;
  const Modem little(kSeed, model);
  model.loss_rate = 0.4;
  model.burst_rate = 0.1;
  model.burst_mean_length = 3.0;
  model.duplicate_rate = 0.5;
  const Modem much(kSeed, model);
  int heard_of_both = 0;
  for (std::uint32_t n = 0; n < 5000; ++n) {
    const Reception first = little.receive(hop(n));
    const Reception second = much.receive(hop(n));
    EXPECT_TRUE(!first.lost || second.lost) << n;
    if (second.lost || second.second) continue;
    ++heard_of_both;
    EXPECT_EQ(first.first.at_ms, second.first.at_ms) << n;
  }
  EXPECT_GT(heard_of_both, 1000);
}

TEST(Modem, AnswersTheSameInWhateverOrderItIsAsked) {
  LinkModel model = {.latency = {.law = LatencyModel::Law::kGamma, .min_ms = 50.0, .mean_ms = 150.0}};
  model.loss_rate = 0.1;
  model.burst_rate = 0.2;
  model.burst_mean_length = 8.0;
  model.duplicate_rate = 0.3;
  const Modem modem(kSeed, model);
  std::vector<Reception> forwards;
  for (std::uint32_t n = 0; n < 500; ++n) forwards.push_back(modem.receive(hop(n)));
  const Modem other(kSeed, model);
  for (std::uint32_t n = 500; n-- > 0;) {
    const Reception again = other.receive(hop(n));
    EXPECT_EQ(again.lost, forwards[n].lost) << n;
    EXPECT_EQ(again.first.at_ms, forwards[n].first.at_ms) << n;
    EXPECT_EQ(again.second.has_value(), forwards[n].second.has_value()) << n;
  }
}

TEST(Modem, DrawsForAFrameWhateverElseItsSenderSays) {
  // The same frame with another number and in another place, since the RSU advises more cars: the same fate. A frame of
  // another kind in the same step has draws of its own, but shares the state of the link.
  LinkModel model = {.latency = {.law = LatencyModel::Law::kUniform, .min_ms = 4.0, .max_ms = 100.0}};
  model.loss_rate = 0.5;
  const Modem modem(kSeed, model);
  model.loss_rate = 0.0;
  model.burst_rate = 0.5;
  model.burst_mean_length = 5.0;
  const Modem bursty(kSeed, model);
  int differ = 0;
  for (std::uint32_t n = 0; n < 1000; ++n) {
    Hop advice = hop(n);
    advice.kind = 5;
    Hop shifted = advice;
    shifted.sequence += 1000;
    shifted.place = 3;
    EXPECT_EQ(modem.receive(advice).lost, modem.receive(shifted).lost) << n;
    EXPECT_EQ(modem.receive(advice).first.at_ms, modem.receive(shifted).first.at_ms) << n;
    Hop spat = advice;
    spat.kind = 3;
    differ += modem.receive(advice).lost != modem.receive(spat).lost ? 1 : 0;
    EXPECT_EQ(bursty.receive(advice).lost, bursty.receive(spat).lost) << n;
  }
  EXPECT_NEAR(differ, 500, 64);  // 4 deviations of sqrt(1000 / 4)
}

TEST(Modem, DuplicatesTheShareItIsToldAndNeverBeforeTheFirst) {
  LinkModel model = {.latency = {.law = LatencyModel::Law::kUniform, .min_ms = 0.0, .max_ms = 300.0}};
  model.duplicate_rate = 0.2;
  const Modem modem(kSeed, model);
  int twice = 0;
  for (std::uint32_t n = 0; n < 10'000; ++n) {
    const Reception heard = modem.receive(hop(n));
    if (!heard.second) continue;
    ++twice;
    EXPECT_GE(heard.second->at_ms, heard.first.at_ms);
    EXPECT_NE(heard.second->latency_ms, heard.first.latency_ms);
  }
  EXPECT_NEAR(twice / 10'000.0, 0.2, 0.016);  // 4 deviations of sqrt(0.2 * 0.8 / n) = 0.004
}

}  // namespace
}  // namespace lukou
