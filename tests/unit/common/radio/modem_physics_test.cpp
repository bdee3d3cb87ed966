#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "common/radio/modem.hpp"
#include "common/radio/station_speed.hpp"

// What lasts for a reservation, and what depends on place and time.

namespace lukou {
namespace {

Hop hop(Step sent, std::uint64_t sender = 11, std::uint64_t receiver = 22) {
  return {.sender = sender, .receiver = receiver, .sequence = static_cast<std::uint32_t>(sent), .sent = sent};
}

TEST(HalfDuplex, LosesAHundredthBothWaysForAReservation) {
  const Modem modem(3, {.half_duplex = true});
  int lost = 0;
  int changes = 0;
  int steps = 0;
  for (std::uint64_t other = 100; other < 1100; ++other) {
    bool before = false;
    for (Step at = 0; at < 100; ++at, ++steps) {
      const bool now = modem.receive(hop(at, 11, other)).lost == LossCause::kHalfDuplex;
      EXPECT_EQ(modem.receive(hop(at, other, 11)).lost == LossCause::kHalfDuplex, now);
      lost += now ? 1 : 0;
      changes += at > 0 && now != before ? 1 : 0;
      before = now;
    }
  }
  // One subframe in 100. The state lasts until either reserves anew, some 6 steps: n is about 1000 * 100 / 6 = 16,000,
  // but all share the reservations of station 11, about 10 of them: deviation of the share about 0.001.
  EXPECT_NEAR(static_cast<double>(lost) / steps, 0.01, 4 * 0.001);
  EXPECT_LT(changes, lost);  // a loss lasts longer than a step: begin and end are two changes
  EXPECT_GT(changes, 0);
}

TEST(HalfDuplex, IsWorseForAStationThatSendsMore) {
  const Modem modem(3, {.half_duplex = true});
  int lost = 0;
  for (std::uint64_t sender = 100; sender < 20'100; ++sender) {
    Hop to_busy = hop(50, sender, 7);
    to_busy.receiver_frames = 4;
    lost += modem.receive(to_busy).lost ? 1 : 0;
  }
  // At most 4 of 100 subframes, fewer if two of the four coincide (6 pairs of a hundredth).
  EXPECT_GE(lost / 20'000.0, 0.03 - 4 * 0.0014);
  EXPECT_LE(lost / 20'000.0, 0.04 + 4 * 0.0014);
  Hop to_silent = hop(50, 100, 7);
  to_silent.receiver_frames = 0;
  EXPECT_FALSE(modem.receive(to_silent).lost);
}

TEST(Collision, LastsAsLongAsTheReservationOfTheSender) {
  const Modem modem(3, {.collisions = true});
  Stations stations(3, 0.0);
  int lost = 0;
  constexpr int kSenders = 20'000;
  for (std::uint64_t sender = 100; sender < 100 + kSenders; ++sender) {
    const Reservation reservation = stations.reservation(sender, 200);
    Hop sent = hop(200, sender);
    sent.collision_probability = 0.2;
    const auto first = modem.receive(sent).lost;
    lost += first == LossCause::kCollision ? 1 : 0;
    for (Step at = reservation.from; at < reservation.to; ++at) {
      sent.sent = at;
      sent.sequence = static_cast<std::uint32_t>(at);
      ASSERT_EQ(modem.receive(sent).lost, first);
    }
  }
  EXPECT_NEAR(lost / static_cast<double>(kSenders), 0.2, 4 * 0.0028);  // sqrt(0.16 / n)
}

TEST(Latency, OfAReservationIsTheSameForItsFramesAndAtAllReceivers) {
  const Modem modem(
      3, {.latency = {.law = LatencyModel::Law::kUniform, .min_ms = 4.0, .max_ms = 100.0, .per_reservation = true}});
  Stations stations(3, 0.0);
  double sum_ms = 0.0;
  constexpr int kSenders = 10'000;
  for (std::uint64_t sender = 100; sender < 100 + kSenders; ++sender) {
    const Reservation reservation = stations.reservation(sender, 200);
    const double first_ms = modem.receive(hop(reservation.from, sender)).first.latency_ms;
    EXPECT_EQ(modem.receive(hop(reservation.to - 1, sender, 5)).first.latency_ms, first_ms);
    EXPECT_NE(modem.receive(hop(reservation.to, sender)).first.latency_ms, first_ms);
    sum_ms += first_ms;
  }
  EXPECT_NEAR(sum_ms / kSenders, 52.0, 4 * 0.277);  // 96 / sqrt(12 n)
}

TEST(Latency, OfACellGrowsWithSpeed) {
  LinkModel model{.latency = {.law = LatencyModel::Law::kGamma, .min_ms = 50.0, .mean_ms = 150.0}};
  const Modem plain(3, model);
  model.latency.speed_factor = true;
  const Modem fast(3, model);
  Hop moving = hop(40);
  // At 50 km/h 1 - 9.258e-4 * 50 + 7.357e-5 * 2500 = 1.137635; at 10 km/h below 1, so 1.
  moving.car_speed_mps = 50.0 / 3.6;
  EXPECT_NEAR(fast.receive(moving).first.latency_ms, 1.137635 * plain.receive(moving).first.latency_ms, 1e-6);
  moving.car_speed_mps = 10.0 / 3.6;
  EXPECT_EQ(fast.receive(moving).first.latency_ms, plain.receive(moving).first.latency_ms);
}

TEST(StationSpeed, IsTheWayOfOneStep) {
  StationSpeed speeds;
  EXPECT_EQ(speeds.of(1, {0.0, 0.0}, 10), 0.0);
  EXPECT_NEAR(speeds.of(1, {0.9, 1.2}, 11), 15.0, 1e-9);
  EXPECT_EQ(speeds.of(2, {5.0, 5.0}, 11), 0.0);
  EXPECT_EQ(speeds.of(1, {3.0, 3.0}, 13), 0.0);  // silent at step 12
}

TEST(RestartedRsu, HasLinksOfItsOwn) {
  const Modem modem(3, {.loss_rate = 0.5});
  int equal = 0;
  for (Step at = 0; at < 10'000; ++at) {
    Hop again = hop(at);
    again.epoch = 2;
    equal += modem.receive(hop(at)).lost == modem.receive(again).lost ? 1 : 0;
  }
  EXPECT_NEAR(equal / 10'000.0, 0.5, 4 * 0.005);  // as two independent coins
}

TEST(Outage, LosesWhatItNamesAndNothingElse) {
  RadioParameters radio{.seed = 3};
  radio.outages = {{.from = 10, .to = 20, .downlink = false, .arm = Arm::kWest},
                   {.from = 30, .to = 40, .uplink = false, .rsu = 1},
                   {.from = 50, .to = 60, .area = Outage::Area{-50.0, 50.0, -50.0, 50.0}}};
  const Modem up(3, {}, uplink_surroundings(radio));
  const Modem down(3, {}, downlink_surroundings(radio));
  const auto lost = [](const Modem& modem, Step at, PlanePoint car, std::uint32_t rsu = 0) {
    Hop sent = hop(at);
    sent.car = car;
    sent.rsu = rsu;
    return modem.receive(sent).lost == LossCause::kOutage;
  };
  const PlanePoint west{-100.0, 2.0};
  EXPECT_FALSE(lost(up, 9, west));
  EXPECT_TRUE(lost(up, 10, west));
  EXPECT_TRUE(lost(up, 19, west));
  EXPECT_FALSE(lost(up, 20, west));
  EXPECT_FALSE(lost(up, 15, {100.0, 2.0}));
  EXPECT_FALSE(lost(down, 15, west));
  EXPECT_TRUE(lost(down, 35, west, 1));
  EXPECT_FALSE(lost(down, 35, west, 0));
  EXPECT_FALSE(lost(up, 35, west, 1));
  EXPECT_TRUE(lost(up, 55, {20.0, 20.0}));
  EXPECT_TRUE(lost(down, 55, {20.0, 20.0}));
  EXPECT_FALSE(lost(down, 55, west));
}

}  // namespace
}  // namespace lukou
