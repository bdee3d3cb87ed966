// The way of a car without a unit to an RSU's algorithm: truth, sensor, bus, map matching, view.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "common/lockstep/edge.hpp"
#include "common/scenario/scenario.hpp"
#include "services/rsu/rsu_config.hpp"
#include "services/rsu/rsu_node.hpp"
#include "services/signal_controller/signal_controller_node.hpp"
#include "services/traffic_engine/engine_node.hpp"

namespace lukou {
namespace {

constexpr Step kPromise = 10;

/// Holds a heard car back that has a sensed one close ahead, and notes what it sees.
class HoldBehindSensed final : public RsuAlgorithm {
 public:
  struct Seen {
    std::array<std::vector<double>, kLanes> sensed_m;
    std::array<std::size_t, kLanes> heard{};
  };
  explicit HoldBehindSensed(Seen& seen) : seen_(seen) {}

  void on_step(const RsuView& heard, RsuAnswer& answer) override {
    for (std::size_t i = 0; i < heard.lanes.size(); ++i) {
      const LaneView& lane = heard.lanes[i];
      seen_.heard[i] = lane.cars.size();
      seen_.sensed_m[i].clear();
      for (const SensedCar& car : lane.sensed) seen_.sensed_m[i].push_back(car.distance_m);
      for (const HeardCar& car : lane.cars) {
        const bool close = std::ranges::any_of(lane.sensed, [&](const SensedCar& ahead) {
          return ahead.distance_m < car.distance_m - 2.0 && ahead.distance_m > car.distance_m - 25.0;
        });
        if (close) answer.advise(car.id, {.acceleration_mps2 = -0.5, .lifetime = 1});
      }
    }
  }

 private:
  Seen& seen_;
};

class Intersection {
 public:
  explicit Intersection(const std::vector<std::string>& sets, std::unique_ptr<RsuAlgorithm> algorithm = nullptr)
      : scenario_(scenario::load_text("", "test", "/", sets).value()),
        controller_(scenario::signal_plan(scenario_).value(), kPromise),
        engine_(engine_config(scenario_).value()),
        rsu_(rsu_config(scenario_.message(), 0).value(),
             algorithm ? std::move(algorithm) : std::make_unique<HoldBehindSensed>(seen_)) {}

  void step() {
    SignalBatch batch;
    if (controller_.step(next_, batch)) {
      SignalBatch copy = batch;
      EXPECT_TRUE(engine_signal_.accept(1, batch).ok());
      EXPECT_TRUE(rsu_signal_.accept(1, copy).ok());
    }
    const RoadsideBatch* heard = next_ > 0 ? &roadside_ : nullptr;
    const auto done = engine_.step(next_, engine_signal_.take(next_), {&heard, 1}, traffic_, air_);
    ASSERT_TRUE(done.ok()) << done.error().text();
    rsu_.step(next_, rsu_signal_.take(next_), air_, roadside_);
    ++next_;
  }

  /// Distances of the fronts of a lane's cars to its stop line, front to back.
  [[nodiscard]] std::vector<double> truth_m(std::size_t lane) const {
    std::vector<double> distances_m;
    for (std::size_t i = 0; i < traffic_.vehicle.size(); ++i) {
      const double distance_m = 500.0 - traffic_.position_m[i];
      if (traffic_.lane[i] == lane && distance_m > 0.0) distances_m.push_back(distance_m);
    }
    return distances_m;
  }
  [[nodiscard]] const TrafficBatch& traffic() const { return traffic_; }
  [[nodiscard]] const HoldBehindSensed::Seen& seen() const { return seen_; }

 private:
  HoldBehindSensed::Seen seen_;
  scenario::Resolved scenario_;
  SignalControllerNode controller_;
  EngineNode engine_;
  RsuNode rsu_;
  Edge<SignalBatch> engine_signal_{signal_timing(kPromise)};
  Edge<SignalBatch> rsu_signal_{signal_timing(kPromise)};
  RoadsideBatch roadside_;
  TrafficBatch traffic_;
  AirBatch air_;
  Step next_ = 0;
};

std::vector<std::string> perfect_sensors(const std::string& ratio) {
  std::vector<std::string> sets = {"vehicles.equipped_ratio=" + ratio};
  int sensor = 0;
  for (const char* approach : {"WEST", "SOUTH", "EAST", "NORTH"}) {
    sets.push_back("rsus[0].sensors[" + std::to_string(sensor++) + "]={approach: " + approach + " to_m: 500}");
  }
  return sets;
}

TEST(SensingPath, ShowsEveryCarOfTheApproachesWhoeverHasAUnit) {
  Intersection crossing(perfect_sensors("0.2"));
  std::size_t sensed = 0;
  std::size_t heard = 0;
  for (Step k = 0; k < 1500; ++k) {
    crossing.step();
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      const std::vector<double> truth_m = crossing.truth_m(lane);
      const std::vector<double>& seen_m = crossing.seen().sensed_m[lane];
      ASSERT_EQ(seen_m.size(), truth_m.size()) << "step " << k << " lane " << lane;
      for (std::size_t i = 0; i < truth_m.size(); ++i) EXPECT_NEAR(seen_m[i], truth_m[i], 1e-6);
      sensed += seen_m.size();
      heard += crossing.seen().heard[lane];
    }
  }
  EXPECT_GT(sensed, 50'000U);
  EXPECT_LT(heard, sensed / 3);  // a fifth has a unit
}

TEST(SensingPath, LeavesTheTrafficAloneUnderAnAlgorithmThatDoesNotLook) {
  Intersection plain({"vehicles.equipped_ratio=0.5"}, make_algorithm("arrive_on_green", {}).value());
  Intersection sensing(perfect_sensors("0.5"), make_algorithm("arrive_on_green", {}).value());
  for (Step k = 0; k < 1500; ++k) {
    plain.step(), sensing.step();
    ASSERT_EQ(plain.traffic().position_m, sensing.traffic().position_m) << k;
  }
}

TEST(SensingPath, LetsAnAlgorithmGuideByWhatIsSensed) {
  Intersection crossing(perfect_sensors("0.5"));
  std::size_t applied = 0;
  for (Step k = 0; k < 1500; ++k) {
    crossing.step();
    for (const std::uint8_t fate : crossing.traffic().fate) {
      applied += fate == static_cast<std::uint8_t>(AdviceFate::kApplied);
    }
  }
  EXPECT_GT(applied, 100U);
}

}  // namespace
}  // namespace lukou
