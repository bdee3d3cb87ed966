// The way of an advice through the whole system: algorithm, RSC frame, radio, on-board unit, motion, fate, figure.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <utility>

#include "common/lockstep/edge.hpp"
#include "common/measures/run_measures.hpp"
#include "common/scenario/scenario.hpp"
#include "services/rsu/rsu_config.hpp"
#include "services/rsu/rsu_node.hpp"
#include "services/signal_controller/signal_controller_node.hpp"
#include "services/traffic_engine/engine_node.hpp"

namespace lukou {
namespace {

constexpr Step kPromise = 10;

/// Gives every car that is heard the same advice.
class SameForAll final : public RsuAlgorithm {
 public:
  explicit SameForAll(Advice advice) : advice_(advice) {}
  void on_step(const RsuView& heard, RsuAnswer& answer) override {
    for (const LaneView& lane : heard.lanes)
      for (const HeardCar& car : lane.cars) answer.advise(car.id, advice_);
  }

 private:
  Advice advice_;
};

/// Controller, engine, RSU and measures, called in the order of their edges.
class Intersection {
 public:
  Intersection(const std::vector<std::string>& sets, std::unique_ptr<RsuAlgorithm> algorithm)
      : scenario_(scenario::load_text("", "test", "/", sets).value()),
        controller_(scenario::signal_plan(scenario_).value(), kPromise),
        engine_(engine_config(scenario_).value()),
        rsu_(rsu_config(scenario_.message(), 0).value(), std::move(algorithm)),
        measures_({.warmup_s = 0.0}) {}

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
    measures_.add(traffic_);
    ++next_;
  }

  [[nodiscard]] const TrafficBatch& traffic() const { return traffic_; }
  [[nodiscard]] RunFigures figures() const { return measures_.figures(); }

 private:
  scenario::Resolved scenario_;
  SignalControllerNode controller_;
  EngineNode engine_;
  RsuNode rsu_;
  RunMeasures measures_;
  Edge<SignalBatch> engine_signal_{signal_timing(kPromise)};
  Edge<SignalBatch> rsu_signal_{signal_timing(kPromise)};
  RoadsideBatch roadside_;
  TrafficBatch traffic_;
  AirBatch air_;
  Step next_ = 0;
};

TEST(GuidancePath, AppliesACommandedAccelerationExactly) {
  // Light traffic, no noise, everybody equipped: nothing but the command acts until the limits or the guard do.
  Intersection crossing(
      {"vehicles.equipped_ratio=1", "vehicles.actuation_noise_mps2=0", "traffic.west.flow_veh_per_h=120",
       "traffic.south.flow_veh_per_h=120", "traffic.east.flow_veh_per_h=120", "traffic.north.flow_veh_per_h=120"},
      std::make_unique<SameForAll>(Advice{.acceleration_mps2 = -0.37, .lifetime = 5}));
  std::map<std::uint32_t, double> speed_mps;
  int commanded = 0;
  for (Step k = 0; k < 6000; ++k) {
    crossing.step();
    const TrafficBatch& now = crossing.traffic();
    std::map<std::uint32_t, bool> changed;
    for (std::size_t i = 0; i < now.fate.size(); ++i)
      if (now.fate[i] != static_cast<std::uint8_t>(AdviceFate::kApplied)) changed[now.fate_vehicle[i]] = true;
    for (std::size_t i = 0; i < now.vehicle.size(); ++i) {
      const bool applied = !std::isnan(now.commanded_mps2[i]) && !changed[now.vehicle[i]];
      if (applied) {
        ++commanded;
        EXPECT_EQ(now.commanded_mps2[i], -0.37);
        // v' = v + a dt, with the rounding of one product and one sum.
        EXPECT_NEAR(now.speed_mps[i], speed_mps.at(now.vehicle[i]) - 0.037, 1e-12);
      }
      speed_mps[now.vehicle[i]] = now.speed_mps[i];
    }
  }
  EXPECT_GT(commanded, 1000);
}

TEST(GuidancePath, CountsEveryAdviceOnce) {
  Intersection crossing({}, std::make_unique<SameForAll>(Advice{.acceleration_mps2 = 0.5, .lifetime = 1}));
  for (Step k = 0; k < 1500; ++k) crossing.step();
  const RunFigures figures = crossing.figures();
  std::uint64_t with_fate = 0;
  for (const std::uint64_t count : figures.advice_by_fate) with_fate += count;
  EXPECT_GT(figures.advice_sent, 10000U);
  EXPECT_EQ(figures.advice_sent, with_fate);
  EXPECT_EQ(figures.collisions, 0U);
  EXPECT_EQ(figures.reversals, 0U);
}

TEST(GuidancePath, RefusesWhatIsNoNumberOrOutOfRangeAndLeavesTheTrafficAlone) {
  Intersection unguided({}, std::make_unique<SameForAll>(Advice{.acceleration_mps2 = 0.0, .lifetime = 0}));
  for (Step k = 0; k < 600; ++k) unguided.step();
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double value : {std::nan(""), infinity, -infinity, 1e300, 7.0, -3.01}) {
    Intersection crossing({}, std::make_unique<SameForAll>(Advice{.acceleration_mps2 = value, .lifetime = 5}));
    for (Step k = 0; k < 600; ++k) crossing.step();
    EXPECT_EQ(crossing.traffic().position_m, unguided.traffic().position_m) << value;
    const RunFigures figures = crossing.figures();
    EXPECT_EQ(figures.advice(AdviceFate::kApplied), 0U) << value;
    EXPECT_GT(figures.advice(AdviceFate::kMalformed) + figures.advice(AdviceFate::kOutOfLimit), 1000U) << value;
    EXPECT_EQ(figures.advice_sent, figures.advice(AdviceFate::kMalformed) + figures.advice(AdviceFate::kOutOfLimit) +
                                       figures.advice(AdviceFate::kPastStopLine))
        << value;
  }
}

TEST(GuidancePath, LeavesArrivalsAndDriversAlone) {
  // Common random numbers: another strategy, or another ratio, must not touch a draw.
  const auto drivers = [](double advice_mps2, const std::string& ratio) {
    Intersection crossing({"vehicles.equipped_ratio=" + ratio},
                          std::make_unique<SameForAll>(Advice{.acceleration_mps2 = advice_mps2, .lifetime = 5}));
    std::map<std::uint32_t, double> desired_mps;
    std::vector<std::uint32_t> arrived;
    for (Step k = 0; k < 1000; ++k) {
      crossing.step();
      const TrafficBatch& now = crossing.traffic();
      arrived.insert(arrived.end(), now.arrived.begin(), now.arrived.end());
      for (std::size_t i = 0; i < now.entered_vehicle.size(); ++i)
        desired_mps[now.entered_vehicle[i]] = now.entered_desired_speed_mps[i];
    }
    return std::pair(arrived, desired_mps);
  };
  const auto plain = drivers(0.0, "0");
  const auto guided = drivers(-0.2, "1");
  EXPECT_EQ(plain.first, guided.first);
  int common = 0;
  for (const auto& [vehicle, desired_mps] : plain.second) {
    const auto other = guided.second.find(vehicle);
    if (other == guided.second.end()) continue;  // still waits outside in that run
    ++common;
    EXPECT_EQ(other->second, desired_mps);
  }
  EXPECT_GT(common, 100);
}

}  // namespace
}  // namespace lukou
