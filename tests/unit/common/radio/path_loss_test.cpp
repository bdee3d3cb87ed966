#include "common/radio/path_loss.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <utility>

#include "common/radio/modem.hpp"

// Losses are computed by hand from the published formulas: f = 5.9 GHz, log10(5.9) = 0.77085.

namespace lukou {
namespace {

PathLossModel urban() { return {.law = PathLossModel::Law::kTr37885}; }
PathLossModel winner(double height_m) { return {.law = PathLossModel::Law::kWinnerB1, .antenna_height_m = height_m}; }

double clear_db(const PathLossModel& model, double away_m) {
  return path_loss_db(model, Sight::kClear, {20.0, 0.0}, {20.0 + away_m, 0.0});
}

TEST(PathLoss, OfTheUrbanLawIsThatOfTr37885) {
  // 38.77 + 16.7 * 2 + 18.2 * 0.77085 = 86.20; 36.85 + 30 * 2 + 18.9 * 0.77085 = 111.42.
  EXPECT_NEAR(clear_db(urban(), 100.0), 86.20, 0.005);
  EXPECT_NEAR(path_loss_db(urban(), Sight::kCorner, {0.0, 60.0}, {80.0, 0.0}), 111.42, 0.005);
  EXPECT_NEAR(path_loss_db(urban(), Sight::kBlocked, {20.0, 0.0}, {120.0, 0.0}), 86.20, 0.005);
  // 9 dB in the middle, more only where 15 log10 d > 41.
  EXPECT_EQ(blocker_mean_db(100.0), 9.0);
  EXPECT_NEAR(blocker_mean_db(1000.0), 13.0, 1e-9);
  // 1.05 e^(-0.0114 * 100) = 0.3358; certain up to ln(1.05) / 0.0114 = 4.28 m.
  EXPECT_NEAR(clear_probability(urban(), 100.0), 0.3358, 0.0001);
  EXPECT_EQ(clear_probability(urban(), 4.2), 1.0);
}

TEST(PathLoss, OfWinnerB1BreaksWhereTheHeightSays) {
  // h = 1.5: break at 4 * 2.25 * 5.9e9 / c = 177 m. Before it, at 20 m, 22.7 * 1.30103 + 27 + 15.417 = 71.95, but
  // free space takes 20 * 1.30103 + 46.4 + 1.438 = 73.86; at 150 m 22.7 * 2.17609 + 42.417 = 91.81 and 91.36. After it
  // at 500 m 40 * 2.69897 + 7.56 - 34.6 * 0.17609 + 2.7 * 0.77085 = 111.51. h = 0.5: + 34.6 * log10(3) = 16.51 more.
  EXPECT_NEAR(clear_db(winner(1.5), 20.0), 73.86, 0.005);
  EXPECT_NEAR(clear_db(winner(1.5), 150.0), 91.81, 0.005);
  EXPECT_NEAR(clear_db(winner(1.5), 500.0), 111.51, 0.005);
  EXPECT_NEAR(clear_db(winner(0.5), 500.0), 128.02, 0.01);
  // In free space at 3 m: 20 log10 3 + 46.4 + 20 log10(5.9 / 5) = 57.38; what is nearer counts as 3 m.
  EXPECT_NEAR(clear_db(winner(1.5), 1.0), 57.38, 0.01);
  EXPECT_EQ(clear_probability(winner(1.5), 400.0), 1.0);
}

TEST(PathLoss, OfWinnerB1AroundACornerTakesTheBetterLeg) {
  // 100 m and 50 m. Leg 100 first: n = 2.8 - 0.24 = 2.56; 87.84 + 17.3 + 2.31 - 32.0 + 25.6 * 1.69897 = 118.94. Leg 50
  // first: free space 81.82, n = 2.68: 81.82 + 19.61 - 33.5 + 26.8 * 2 = 121.53.
  EXPECT_NEAR(path_loss_db(winner(1.5), Sight::kCorner, {100.0, 0.0}, {0.0, -50.0}), 118.94, 0.01);
  EXPECT_NEAR(path_loss_db(winner(1.5), Sight::kCorner, {0.0, -50.0}, {100.0, 0.0}), 118.94, 0.01);
}

TEST(Streets, MeetInTheSquareBetweenTheStopLines) {
  EXPECT_EQ(street_of({-100.0, 5.0}), Street::kEastWest);
  EXPECT_EQ(street_of({3.0, 40.0}), Street::kNorthSouth);
  EXPECT_EQ(street_of({15.0, -15.0}), Street::kJunction);
  EXPECT_TRUE(around_corner({-100.0, 5.0}, {3.0, 40.0}));
  EXPECT_FALSE(around_corner({-100.0, 5.0}, {80.0, -5.0}));
  EXPECT_FALSE(around_corner({-100.0, 5.0}, {1.0, 2.0}));
  EXPECT_EQ(arm_of({-100.0, 5.0}), Arm::kWest);
  EXPECT_EQ(arm_of({100.0, 5.0}), Arm::kEast);
  EXPECT_EQ(arm_of({1.0, -50.0}), Arm::kSouth);
  EXPECT_EQ(arm_of({1.0, 50.0}), Arm::kNorth);
}

double phi(double x) { return 0.5 * std::erfc(-x / std::numbers::sqrt2); }

/// Share of many cars at that distance from a mast that hear it.
double heard_share(const PathLossModel& model, double away_m) {
  const Modem modem(5, {.path_loss = model});
  int heard = 0;
  for (std::uint64_t car = 0; car < 20'000; ++car) {
    const Hop hop{.sender = 900'000, .receiver = car, .distance_m = away_m, .car = {away_m, 0.0}, .other = {0.0, 0.0}};
    const Reception reception = modem.receive(hop);
    heard += reception.lost ? 0 : 1;
    if (reception.lost) {
      EXPECT_EQ(reception.lost, LossCause::kPathLoss);
    }
  }
  return heard / 20'000.0;
}

TEST(Reception, FallsWithDistanceAsTheNormalDistributionSays) {
  // PRR = Phi((P + G - L(d) - S) / sigma), sigma = 3 dB; deviation of a share at most sqrt(0.25 / n) = 0.0035.
  for (const double away_m : {50.0, 200.0, 500.0}) {
    for (const double over_db : {-4.0, 0.0, 2.5, 6.0}) {
      PathLossModel model = urban();
      const double loss_db = 38.77 + 16.7 * std::log10(away_m) + 18.2 * std::log10(5.9);
      model.sensitivity_dbm = 23.0 + 6.0 - loss_db - over_db;
      EXPECT_NEAR(heard_share(model, away_m), phi(over_db / 3.0), 4 * 0.0035) << away_m << " m, " << over_db << " dB";
    }
  }
  // The published parameters: WINNER+ B1, h = 1.5 m, no gain, -90.5 dBm: at 500 m (23 - 111.51 + 90.5) / 3 = 0.663.
  PathLossModel published = winner(1.5);
  published.antenna_gain_dbi = 0.0;
  EXPECT_EQ(heard_share(published, 50.0), 1.0);
  EXPECT_NEAR(heard_share(published, 200.0), 1.0, 1e-3);
  EXPECT_NEAR(heard_share(published, 500.0), phi(0.663), 4 * 0.0035);
}

TEST(Reception, BetweenCarsDependsOnWhatStandsBetween) {
  // 100 m apart with 29 dBm, -75 dBm: in clear sight 29 - 86.20 + 75 = 17.8 dB over, always heard; behind a car
  // 17.8 - 9 = 8.8 dB over with sqrt(3^2 + 4.5^2) = 5.41 dB: Phi(1.627) = 0.948; around a corner
  // 29 - 111.42 + 75 = -7.42 dB with 4 dB: Phi(-1.855) = 0.0318.
  PathLossModel model = urban();
  model.sensitivity_dbm = -75.0;
  const Modem modem(5, {.path_loss = model});
  int heard = 0;
  int around = 0;
  constexpr int kPairs = 20'000;
  for (std::uint64_t car = 0; car < kPairs; ++car) {
    Hop hop{.sender = 900'000,
            .receiver = car,
            .distance_m = 100.0,
            .car = {30.0, 0.0},
            .other = {130.0, 0.0},
            .between_cars = true};
    const bool first = !modem.receive(hop).lost;
    heard += first ? 1 : 0;
    std::swap(hop.sender, hop.receiver);
    std::swap(hop.car, hop.other);
    EXPECT_EQ(!modem.receive(hop).lost, first);  // both directions meet the same
    hop.car = {0.0, 60.0};
    hop.other = {80.0, 0.0};
    around += modem.receive(hop).lost ? 0 : 1;
  }
  // 0.3358 + 0.6642 * 0.948 = 0.965. The floor of the blocker at 0 dB moves this by less than 0.003.
  EXPECT_NEAR(heard / static_cast<double>(kPairs), 0.965, 0.003 + 4 * 0.0013);
  EXPECT_NEAR(around / static_cast<double>(kPairs), 0.0318, 4 * 0.0013);
}

}  // namespace
}  // namespace lukou
