#include "services/traffic_engine/model/roadside_sensors.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

#include "tests/unit/services/traffic_engine/model/rides.hpp"

// Limits of the statistics: what a true law misses once in a thousand seeds (3.3 standard deviations).

namespace lukou::traffic {
namespace {

constexpr SensorParameters kPerfect = {.approach = Approach::kWest, .from_m = 20.0, .to_m = 120.0};

/// The paper's demand.
EngineParameters busy() { return {}; }

/// Everything that sensors deliver while the lights are green and cars drive through, step by step.
std::vector<std::vector<Detection>> seen(const std::vector<SensorParameters>& sensors, Step steps,
                                         const EngineParameters& parameters = busy()) {
  Ride ride(parameters);
  RoadsideSensors roadside(parameters.seed, sensors);
  std::vector<std::vector<Detection>> all;
  for (Step step = 0; step < steps; ++step) {
    if (step > 0) ride.step();
    all.push_back(roadside.look(step, ride.engine()));
  }
  return all;
}

/// A detection's key: which car in which step. Tracks of one sensor are distinct in these runs.
using Key = std::tuple<std::uint32_t, std::uint32_t, Step>;
std::map<Key, Detection> by_key(const std::vector<std::vector<Detection>>& all) {
  std::map<Key, Detection> detections;
  for (const auto& step : all)
    for (const Detection& one : step) detections[{one.sensor, one.track, one.measured}] = one;
  return detections;
}

TEST(RoadsideSensors, SeeACarWhereItIsWhileItIsInTheirZone) {
  Ride ride(with_arrivals(calm_parameters(), {0.05}));
  RoadsideSensors sensors(1, {kPerfect});
  int detections = 0;
  for (Step step = 1; step < 400; ++step) {
    ride.step();
    const auto& found = sensors.look(step, ride.engine());
    ASSERT_FALSE(ride.cars().empty());
    const Motion& motion = ride.cars()[0].motion;
    const double distance_m = 500.0 - motion.position_m;
    ASSERT_EQ(found.size(), distance_m >= 20.0 && distance_m <= 120.0 ? 1U : 0U) << distance_m;
    if (found.empty()) continue;
    ++detections;
    // The front of a car from the west: the line is 15.5 m west of the centre, WC 1.5 lanes south of the axis.
    EXPECT_NEAR(found[0].x_m, -15.5 - distance_m, 1e-9);
    EXPECT_NEAR(found[0].y_m, -5.25, 1e-9);
    EXPECT_EQ(found[0].speed_mps, motion.speed_mps);
    EXPECT_NEAR(found[0].heading_rad, std::acos(0.0), 1e-12);
    EXPECT_EQ(found[0].measured, step);
  }
  EXPECT_NEAR(detections, 100.0 / 1.5, 1.0);  // 100 m at 1.5 m a step
}

TEST(RoadsideSensors, DoNotTellACarWithAUnitFromOneWithout) {
  EngineParameters equipped = busy();
  equipped.equipped_ratio = 1.0;
  EngineParameters plain = busy();
  plain.equipped_ratio = 0.0;
  const std::vector<SensorParameters> sensors = {{.position_noise_m = 1.0, .speed_noise_mps = 0.5}};
  const auto a = by_key(seen(sensors, 1000, equipped));
  const auto b = by_key(seen(sensors, 1000, plain));
  EXPECT_GT(a.size(), 1000U);
  ASSERT_EQ(a.size(), b.size());
  for (const auto& [key, one] : a) EXPECT_EQ(b.at(key).x_m, one.x_m);
}

TEST(RoadsideSensors, MissTheShareThatTheyAreSaidTo) {
  SensorParameters blind = kPerfect;
  blind.miss_rate = 0.3;
  const auto whole = by_key(seen({kPerfect}, 3000));
  const auto some = by_key(seen({blind}, 3000));
  const auto n = static_cast<double>(whole.size());
  ASSERT_GT(n, 5000.0);
  // Binomial: the share has a standard deviation of sqrt(0.3 * 0.7 / n).
  EXPECT_NEAR(1.0 - static_cast<double>(some.size()) / n, 0.3, 3.3 * std::sqrt(0.21 / n));
  for (const auto& [key, one] : some) EXPECT_EQ(whole.at(key).x_m, one.x_m);
}

TEST(RoadsideSensors, ErrAlongTheLaneAcrossItAndInSpeedAsTheyAreSaidTo) {
  SensorParameters noisy = kPerfect;
  noisy.position_noise_m = 2.0;
  noisy.speed_noise_mps = 0.5;
  const auto truth = by_key(seen({kPerfect}, 3000));
  const auto errors = by_key(seen({noisy}, 3000));
  ASSERT_EQ(truth.size(), errors.size());
  double along = 0.0, across = 0.0, speed = 0.0, product = 0.0;
  for (const auto& [key, one] : errors) {
    const Detection& right = truth.at(key);  // heads east: x is along the lane, y across it
    along += (one.x_m - right.x_m) * (one.x_m - right.x_m);
    across += (one.y_m - right.y_m) * (one.y_m - right.y_m);
    speed += (one.speed_mps - right.speed_mps) * (one.speed_mps - right.speed_mps);
    product += (one.x_m - right.x_m) * (one.y_m - right.y_m);
  }
  const auto n = static_cast<double>(errors.size());
  const double limit = 3.3 * std::sqrt(2.0 / n);  // of a sample variance
  EXPECT_NEAR(along / n / 4.0, 1.0, limit);
  EXPECT_NEAR(across / n / 0.04, 1.0, limit);
  EXPECT_NEAR(speed / n / 0.25, 1.0, limit);
  EXPECT_NEAR(product / n / (2.0 * 0.2), 0.0, 3.3 / std::sqrt(n));
}

TEST(RoadsideSensors, DeliverAtTheFirstStepThatIsNotBeforeTheirLatency) {
  for (const auto& [latency_ms, steps] :
       std::map<double, Step>{{0.0, 0}, {1.0, 1}, {100.0, 1}, {101.0, 2}, {250.0, 3}}) {
    SensorParameters late = kPerfect;
    late.latency_ms = latency_ms;
    const auto all = seen({late}, 600);
    std::size_t delivered = 0;
    for (std::size_t step = 0; step < all.size(); ++step) {
      for (const Detection& one : all[step]) EXPECT_EQ(static_cast<Step>(step) - one.measured, steps) << latency_ms;
      delivered += all[step].size();
    }
    EXPECT_GT(delivered, 100U);
  }
}

TEST(RoadsideSensors, DeliverWhatWasUnderWayWhenTheLatencyChanged) {
  Ride ride(with_arrivals(calm_parameters(), {0.05}));
  SensorParameters slow = kPerfect;
  slow.latency_ms = 300.0;
  RoadsideSensors sensors(1, {slow});
  for (Step step = 1; step <= 300; ++step) ride.step(), sensors.look(step, ride.engine());
  sensors.use({kPerfect});
  std::vector<Step> measured;
  for (Step step = 301; step <= 304; ++step) {
    ride.step();
    for (const Detection& one : sensors.look(step, ride.engine())) measured.push_back(one.measured);
  }
  EXPECT_EQ(measured, (std::vector<Step>{298, 301, 299, 302, 300, 303, 304}));
}

TEST(RoadsideSensors, FollowACarUnderOneNumberThatDiffersFromSensorToSensor) {
  SensorParameters second = kPerfect;
  second.sensor = 1;
  std::map<std::uint32_t, std::set<std::uint32_t>> tracks;
  std::size_t detections = 0;
  for (const auto& step : seen({kPerfect, second}, 1000)) {
    for (const Detection& one : step) tracks[one.sensor].insert(one.track), ++detections;
  }
  ASSERT_EQ(tracks.size(), 2U);
  // 1800 veh/h: some 40 cars have come as far in 100 s. Each is followed over many steps, by both sensors.
  EXPECT_EQ(tracks[0].size(), tracks[1].size());
  EXPECT_GT(tracks[0].size(), 20U);
  EXPECT_GT(detections, 40 * tracks[0].size());
  for (const std::uint32_t track : tracks[0]) EXPECT_FALSE(tracks[1].contains(track));
}

TEST(RoadsideSensors, TellCarsInTheOrderOfTheirTracks) {
  std::size_t front_first = 0;
  std::size_t back_first = 0;
  for (const auto& step : seen({kPerfect}, 1000)) {
    EXPECT_TRUE(std::ranges::is_sorted(step, {}, &Detection::track));
    for (std::size_t i = 1; i < step.size(); ++i) ++(step[i - 1].x_m > step[i].x_m ? front_first : back_first);
  }
  // An order that knew of lanes or places would have one of the two only.
  EXPECT_GT(front_first, 100U);
  EXPECT_GT(back_first, 100U);
}

TEST(RoadsideSensors, DrawTheSameWhateverTheOthersDo) {
  SensorParameters noisy = kPerfect;
  noisy.position_noise_m = 1.0;
  SensorParameters other = noisy;
  other.sensor = 1;
  other.miss_rate = 0.5;
  const auto alone = by_key(seen({noisy}, 600));
  const auto both = by_key(seen({noisy, other}, 600));
  for (const auto& [key, one] : alone) EXPECT_EQ(both.at(key).x_m, one.x_m);
  EXPECT_GT(both.size(), alone.size());
}

TEST(RoadsideSensors, DrawTheSameWhateverGuidanceDoesToTheCar) {
  const SensorParameters noisy = {.from_m = 0.0, .to_m = 500.0, .position_noise_m = 1.0, .speed_noise_mps = 0.5};
  const EngineParameters parameters = with_arrivals(calm_parameters(), {0.05});
  Ride plain(parameters);
  Ride guided(parameters);
  RoadsideSensors of_plain(1, {noisy});
  RoadsideSensors of_guided(1, {noisy});
  for (Step step = 1; step < 200; ++step) {
    plain.step();
    const Advice brake = guided.cars().empty() ? Advice{} : guided.advise(0, -0.3);
    guided.step({&brake, guided.cars().empty() ? 0U : 1U});
    const auto a = of_plain.look(step, plain.engine());
    const auto b = of_guided.look(step, guided.engine());
    ASSERT_EQ(a.size(), 1U);
    ASSERT_EQ(b.size(), 1U);
    EXPECT_NEAR(a[0].x_m - plain.cars()[0].motion.position_m, b[0].x_m - guided.cars()[0].motion.position_m, 1e-9);
    EXPECT_EQ(a[0].y_m, b[0].y_m);
    EXPECT_EQ(a[0].track, b[0].track);
  }
  EXPECT_GT(plain.cars()[0].motion.position_m, guided.cars()[0].motion.position_m + 10.0);
}

}  // namespace
}  // namespace lukou::traffic
