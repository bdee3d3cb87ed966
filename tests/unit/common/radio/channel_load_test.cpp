#include "common/radio/channel_load.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <iterator>
#include <string>
#include <utility>

#include "common/radio/between_cars.hpp"
#include "common/radio/modem.hpp"

// The reference is the analytical model of mode 4 by Gonzalez-Martin, Sepulcre, Molina-Masegosa, Gozalvez (IEEE TVT
// 68(2), 2019) for a straight road with cars both ways, 23 dBm, 4 sub-channels of 190 bytes, 10 Hz, WINNER+ B1 with
// h = 1.5 m; its busy ratios and delivery ratios stand in docs/radio.md.

namespace lukou {
namespace {

constexpr double kReach_m = 1500.0;

PathLossModel reference_path_loss() {
  return {.law = PathLossModel::Law::kWinnerB1, .antenna_gain_dbi = 0.0, .sensitivity_dbm = -90.5};
}

/// Cars at equal distances from -1500 m to 1500 m, alternately on either side of the road; 95 bytes and 95 of security
/// fill one sub-channel.
Frames road(double cars_per_m) {
  Frames frames;
  const auto cars = static_cast<int>(std::lround(2.0 * kReach_m * cars_per_m));
  for (int n = 0; n < cars; ++n) {
    frames.sender.push_back(1000 + static_cast<std::uint64_t>(n));
    frames.sequence.push_back(0);
    frames.kind.push_back(static_cast<std::uint8_t>(FrameKind::kBsm));
    frames.wire_bytes.push_back(95);
    frames.antenna_x_m.push_back(-kReach_m + (n + 0.5) / cars_per_m);
    frames.antenna_y_m.push_back(n % 2 == 0 ? 5.0 : -5.0);
    frames.payload_end.push_back(0);
  }
  return frames;
}

constexpr double kAway_m[] = {50.0, 100.0, 150.0, 200.0, 300.0, 400.0, 500.0};

struct Reference {
  double cars_per_m;
  double busy;
  double delivered[7];  ///< at the distances above
};
constexpr Reference kReferences[] = {{0.05, 0.14, {0.987, 0.985, 0.983, 0.979, 0.955, 0.899, 0.669}},
                                     {0.1, 0.27, {0.982, 0.976, 0.971, 0.961, 0.907, 0.821, 0.595}},
                                     {0.2, 0.51, {0.968, 0.954, 0.941, 0.918, 0.804, 0.666, 0.455}},
                                     {0.3, 0.69, {0.953, 0.929, 0.909, 0.872, 0.701, 0.528, 0.340}}};

/// Share of frames that cars within 300 m of the centre deliver to a car `away_m` ahead: all causes together.
double delivery_ratio(const Frames& air, ChannelLoad& load, double cars_per_m, double away_m) {
  const auto ahead = static_cast<std::size_t>(std::lround(away_m * cars_per_m));
  double sent = 0.0;
  double heard = 0.0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Modem modem(seed, {.path_loss = reference_path_loss(), .half_duplex = true, .collisions = true});
    for (std::size_t from = 0; from + ahead < air.size(); ++from) {
      if (std::fabs(air.antenna_x_m[from]) > 300.0) continue;
      const std::size_t to = from + ahead;
      Hop hop{.sender = air.sender[from],
              .receiver = air.sender[to],
              .distance_m = away_m,
              .car = {air.antenna_x_m[from], air.antenna_y_m[from]},
              .other = {air.antenna_x_m[to], air.antenna_y_m[to]},
              .between_cars = true};
      hop.collision_probability = load.collision_between(hop.car, hop.other, load.width(air.wire_bytes[from]));
      for (int n = 0; n < 20; ++n) {  // 15 steps apart: in each another reservation
        hop.sequence = static_cast<std::uint32_t>(n);
        hop.sent = 15 * n;
        sent += 1.0;
        heard += modem.receive(hop).lost ? 0.0 : 1.0;
      }
    }
  }
  return heard / sent;
}

TEST(ChannelLoad, GivesTheBusyAndDeliveryRatiosOfMode4) {
  // At least 12,000 frames a figure. They share 600 pairs' shadowing, which at 500 m gives a deviation of 0.018.
  for (const Reference& known : kReferences) {
    const Frames air = road(known.cars_per_m);
    ChannelLoad load({.counted = true, .path_loss = reference_path_loss()}, kReach_m);
    load.add_air(air, 0);
    EXPECT_NEAR(load.busy_ratio({0.0, 5.0}), known.busy, 0.01) << known.cars_per_m;
    const std::string name = "per_km_" + std::to_string(std::lround(1000.0 * known.cars_per_m));
    RecordProperty(name + "_busy", std::to_string(load.busy_ratio({0.0, 5.0})));
    for (std::size_t i = 0; i < std::size(kAway_m); ++i) {
      const double ratio = delivery_ratio(air, load, known.cars_per_m, kAway_m[i]);
      RecordProperty(name + "_at_" + std::to_string(std::lround(kAway_m[i])), std::to_string(ratio));
      // At 0.2 cars/m and at 400 m the deviations are larger: docs/radio.md says why.
      const bool loose = known.cars_per_m == 0.2 || kAway_m[i] >= 400.0;
      EXPECT_NEAR(ratio, known.delivered[i], loose ? 0.06 : 0.03) << known.cars_per_m << ", " << kAway_m[i] << " m";
    }
  }
}

/// So many cars in one place of a street.
Frames crowd(std::size_t cars) {
  Frames frames;
  for (std::size_t n = 0; n < cars; ++n) {
    frames.sender.push_back(n), frames.sequence.push_back(0), frames.kind.push_back(1), frames.wire_bytes.push_back(95);
    frames.antenna_x_m.push_back(200.0), frames.antenna_y_m.push_back(2.0), frames.payload_end.push_back(0);
  }
  return frames;
}

TEST(ChannelLoad, CountsHalfOfWhatIsHeardAndTheOtherHalfWhereItDoesNotCoincide) {
  // 101 stations in one place hear each other: half = 50.5, left = 349.5; 50.5 + 50.5 - 50.5 * 51.5 / 699 = 97.28 of
  // 400 resources. Of 300: 150 + 150 - 150 * 151 / 500 = 254.7. Half of 700 leaves 50, of which (50 - 1) / 2 are taken:
  // 350 + 24.5. More than 800 fill the channel.
  for (const auto& [cars, used] : {std::pair(101U, 97.28), {300U, 254.7}, {700U, 374.5}, {900U, 400.0}}) {
    ChannelLoad load({.counted = true, .path_loss = reference_path_loss()}, 500.0);
    load.add_air(crowd(cars), 10);
    EXPECT_NEAR(load.busy_ratio({200.0, 2.0}), used / 400.0, 1e-4) << cars;
    EXPECT_NEAR(load.busy_ratio_of_cars(), used / 400.0, 1e-4) << cars;
  }
}

TEST(ChannelLoad, HoldsAFrameInAsManySubChannelsAsItNeeds) {
  const ChannelLoad load({.counted = true, .path_loss = reference_path_loss()}, 500.0);
  EXPECT_EQ(load.width(41), 1U);   // 41 + 95 = 136
  EXPECT_EQ(load.width(95), 1U);   // 190
  EXPECT_EQ(load.width(96), 2U);   // 191
  EXPECT_EQ(load.width(540), 4U);  // 635
}

TEST(ChannelLoad, SpeaksOfASecondAndBeginsWithTheStepThatItIsTold) {
  ChannelLoad load({}, 500.0);
  EXPECT_FALSE(load.counted());
  EXPECT_EQ(load.collision_to_mast({100.0, 0.0}, 1), 0.0);
  load.use({.counted = true, .path_loss = reference_path_loss()}, 12);
  const Frames air = crowd(20);
  load.add_air(air, 10);
  EXPECT_EQ(load.busy_ratio_at_mast(), 0.0);
  load.add_air(air, 19);
  EXPECT_EQ(load.busy_ratio_at_mast(), 0.0);
  load.add_air(air, 20);
  const double busy = load.busy_ratio_at_mast();
  EXPECT_NEAR(busy, 19.859 / 400.0, 1e-5);  // 10 + 10 - 10 * 11 / 780
  // An RSU's frames count with those of the second that ends: 10 frames of 4 sub-channels in it are 4 uses in
  // 100 ms: 12 + 12 - 12 * 13 / 776 = 23.799.
  Frames advice;
  advice.sender.push_back(1), advice.sequence.push_back(0), advice.kind.push_back(5), advice.wire_bytes.push_back(540);
  advice.antenna_x_m.push_back(0.0), advice.antenna_y_m.push_back(0.0), advice.payload_end.push_back(0);
  for (Step at = 20; at < 30; ++at) load.add_roadside(advice, at);
  load.add_air(air, 30);
  EXPECT_NEAR(load.busy_ratio_at_mast(), 23.799 / 400.0, 1e-5);
  load.add_air(Frames{}, 40);
  EXPECT_EQ(load.busy_ratio_at_mast(), 0.0);
  EXPECT_EQ(load.collision_to_mast({100.0, 0.0}, 1), 0.0);
}

TEST(ChannelLoad, MakesWideAndDistantFramesCollideMore) {
  ChannelLoad load({.counted = true, .path_loss = reference_path_loss()}, 500.0);
  load.add_air(road(0.2), 0);
  EXPECT_GT(load.collision_to_mast({400.0, 0.0}, 1), load.collision_to_mast({100.0, 0.0}, 1));
  EXPECT_GT(load.collision_from_mast({400.0, 0.0}, 1), load.collision_from_mast({100.0, 0.0}, 1));
  // Against frames of one sub-channel a frame of four has four times the expected colliders.
  const double one_misses = 1.0 - load.collision_from_mast({200.0, 0.0}, 1);
  EXPECT_NEAR(load.collision_from_mast({200.0, 0.0}, 4), 1.0 - std::pow(one_misses, 4), 1e-9);
}

TEST(BetweenCars, CountsEachPairWithinReachOnceASecond) {
  RadioParameters radio{.seed = 3, .modelled = true};
  radio.vehicle_to_vehicle = LinkModel{};
  radio.awareness_m = 25.0;
  BetweenCars between(radio);
  ChannelLoad load({}, 500.0);
  Frames air =
      road(0.1);  // 300 cars 10 m apart, alternately on two sides 10 m apart: neighbours 14.1, next but one 20 m
  between.hear(air, 9, load);
  EXPECT_EQ(between.tally().sent, 0U);
  between.hear(air, 10, load);
  EXPECT_EQ(between.tally().sent, 2U * (299U + 298U));
  EXPECT_EQ(between.tally().heard, between.tally().sent);
  between.use(radio);  // a change does not lose what was counted
  EXPECT_EQ(between.tally().sent, 2U * (299U + 298U));
  between.hear(air, 11, load);
  EXPECT_EQ(between.tally().sent, 0U);
}

}  // namespace
}  // namespace lukou
