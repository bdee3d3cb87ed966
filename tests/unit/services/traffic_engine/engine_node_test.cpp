#include "services/traffic_engine/engine_node.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "common/messages/bsm.hpp"
#include "tests/unit/services/traffic_engine/drive.hpp"

namespace lukou {
namespace {

TEST(EngineNode, PublishesTheEmptyRoadAtStepZero) {
  Drive drive(lone_car_from_the_west());
  drive.step();
  EXPECT_EQ(drive.traffic().step, 0);
  EXPECT_TRUE(drive.traffic().vehicle.empty());
  EXPECT_EQ(drive.traffic().arrived, (std::vector<std::uint32_t>{0, 0, 0, 0}));
  EXPECT_EQ(drive.air().frames.size(), 0U);
}

TEST(EngineNode, SendsABsmFromEveryEquippedCarInEveryStep) {
  Drive drive(lone_car_from_the_west());
  drive.run_to(101);
  ASSERT_EQ(drive.air().frames.size(), 1U);
  EXPECT_EQ(drive.air().step, 101);
  EXPECT_EQ(drive.air().frames.sequence[0], 100U);  // came at step 1
  const auto heard = decode_bsm(drive.air().frames.payload_of(0));
  ASSERT_TRUE(heard) << heard.error().text();
  const BasicSafety& bsm = heard.value();
  EXPECT_EQ(bsm.temporary_id, drive.air().frames.sender[0]);
  EXPECT_EQ(bsm.count, 100);
  EXPECT_EQ(bsm.second_mark_ms, 10100);
  // 10 s at 15 m/s: the front is 150 m from the entrance, 350 m before the line, which is 15.5 m west of the centre;
  // the centre of the car is half a length behind. WC lies 1.5 lanes south of the axis.
  EXPECT_NEAR(bsm.centre.x_m, -15.5 - 350.0 - 2.25, 0.02);
  EXPECT_NEAR(bsm.centre.y_m, -5.25, 0.02);
  EXPECT_NEAR(*bsm.speed_mps, 15.0, 0.01 + 1e-9);
  EXPECT_NEAR(*bsm.heading_rad, std::acos(0.0), 0.001);
  EXPECT_FALSE(bsm.braking);
}

TEST(EngineNode, SendsOnTheExitAndFallsSilentAtItsEnd) {
  Drive drive(lone_car_from_the_west());
  drive.run_to(390);  // 15 m/s * 38.9 s = 583.5 m of 600
  EXPECT_EQ(drive.air().frames.size(), 1U);
  drive.run_to(402);
  EXPECT_EQ(drive.air().frames.size(), 0U);
}

TEST(EngineNode, SendsNothingFromCarsWithoutAUnit) {
  EngineConfig config = lone_car_from_the_west();
  config.traffic.equipped_ratio = 0.0;
  Drive drive(config);
  drive.run_to(10);
  EXPECT_EQ(drive.traffic().vehicle.size(), 1U);
  EXPECT_EQ(drive.air().frames.size(), 0U);
}

TEST(EngineNode, LetsGuidanceOfOneStepActInTheNext) {
  Drive drive(lone_car_from_the_west());
  drive.run_to(100);
  const RoadsideBatch batch = guidance(100, drive.air().frames.sender[0], -0.37, 250);
  drive.step(&batch);
  EXPECT_NEAR(drive.traffic().acceleration_mps2[0], -0.37, 1e-12);
  EXPECT_EQ(drive.traffic().commanded_mps2[0], -0.37);
  EXPECT_EQ(drive.traffic().heard_epoch, (std::vector<std::uint32_t>{7}));
  ASSERT_EQ(drive.traffic().fate.size(), 1U);
  EXPECT_EQ(drive.traffic().fate[0], static_cast<std::uint8_t>(AdviceFate::kApplied));
  EXPECT_EQ(drive.traffic().fate_vehicle[0], 0U);
  EXPECT_EQ(drive.traffic().fate_rsu[0], 2U);
  EXPECT_EQ(drive.traffic().fate_sequence[0], 41U);
  EXPECT_EQ(drive.traffic().fate_issued[0], 100);
  EXPECT_EQ(drive.traffic().fate_commanded_mps2[0], -0.37);
  EXPECT_EQ(drive.traffic().guidance[0], static_cast<std::uint8_t>(GuidanceState::kInForce));
  EXPECT_EQ(drive.traffic().bound_by[0], static_cast<std::uint8_t>(BoundBy::kAdvice));
  // 250 ms: the steps that begin 0, 100 and 200 ms after the issue.
  drive.run_to(103);
  EXPECT_NEAR(drive.traffic().acceleration_mps2[0], -0.37, 1e-12);
  drive.step();
  // A tenth of the way to natural driving: the wish to be at 15 m/s again, which is 0.111 m/s away.
  EXPECT_NEAR(drive.traffic().acceleration_mps2[0], 0.9 * -0.37 + 0.1 * 0.111, 1e-6);
  EXPECT_TRUE(std::isnan(drive.traffic().commanded_mps2[0]));
  EXPECT_EQ(drive.traffic().guidance[0], static_cast<std::uint8_t>(GuidanceState::kExpired));
  EXPECT_EQ(drive.traffic().heard_epoch, (std::vector<std::uint32_t>{0}));
}

TEST(EngineNode, ReleasesACar) {
  Drive drive(lone_car_from_the_west());
  drive.run_to(100);
  const std::uint64_t car = drive.air().frames.sender[0];
  const RoadsideBatch brake = guidance(100, car, -1.0, 5000);
  drive.step(&brake);
  const RoadsideBatch release = guidance(101, car, std::nullopt);
  drive.step(&release);
  EXPECT_GT(drive.traffic().acceleration_mps2[0], 0.0);
  EXPECT_TRUE(drive.traffic().fate.empty());
}

TEST(EngineNode, ReportsAFrameThatCannotBeDecoded) {
  Drive drive(lone_car_from_the_west());
  drive.run_to(100);
  RoadsideBatch batch = guidance(100, drive.air().frames.sender[0], -0.37);
  std::ranges::fill(batch.frames.payload, std::uint8_t{0xFF});
  drive.step(&batch);
  ASSERT_EQ(drive.traffic().fate.size(), 1U);
  EXPECT_EQ(drive.traffic().fate[0], static_cast<std::uint8_t>(AdviceFate::kMalformed));
  EXPECT_EQ(drive.traffic().fate_vehicle[0], 4294967295U);
  EXPECT_EQ(drive.traffic().fate_sequence[0], 41U);
}

TEST(EngineNode, RefusesGuidanceForAStranger) {
  Drive drive(lone_car_from_the_west());
  drive.run_to(100);
  const RoadsideBatch batch = guidance(100, drive.air().frames.sender[0] + 1, -0.37);
  drive.step(&batch);
  ASSERT_EQ(drive.traffic().fate.size(), 1U);
  EXPECT_EQ(drive.traffic().fate[0], static_cast<std::uint8_t>(AdviceFate::kUnknownVehicle));
}

TEST(EngineNode, NeedsThePromiseOfTheLastStep) {
  EngineNode node(lone_car_from_the_west());
  TrafficBatch traffic;
  AirBatch air;
  ASSERT_TRUE(node.step(0, nullptr, {}, traffic, air));  // the heads of step 0 matter from step 1 on
  EXPECT_FALSE(node.step(1, nullptr, {}, traffic, air));
}

TEST(EngineNode, RefusesAPromiseWithAGap) {
  EngineNode node(lone_car_from_the_west());
  TrafficBatch traffic;
  AirBatch air;
  SignalBatch signal;
  signal.heads.assign(kLanes, static_cast<std::uint8_t>(Aspect::kGreen));
  ASSERT_TRUE(node.step(0, &signal, {}, traffic, air));
  signal.first = 5;
  EXPECT_FALSE(node.step(1, &signal, {}, traffic, air));
}

TEST(EngineNode, TakesOverFlowsAndRatioAlone) {
  EngineConfig config;
  config.traffic.equipped_ratio = 0.0;
  for (auto& demand : config.traffic.demand) demand.flows = {{.from_s = 0.0, .flow_veh_per_h = 900.0}};
  Drive steady(config);
  Drive changed(config);
  steady.run_to(1000);
  changed.run_to(1000);
  config.traffic.demand[index(Approach::kEast)].flows[0].flow_veh_per_h = 3600.0;
  config.traffic.equipped_ratio = 1.0;
  changed.node().change(config);
  steady.run_to(2000);
  std::size_t entered = 0;
  while (changed.now() < 2000) {
    changed.step();
    for (const std::uint8_t equipped : changed.traffic().entered_equipped) {
      EXPECT_EQ(equipped, 1);
      ++entered;
    }
  }
  EXPECT_GT(entered, 100U);
  for (const std::size_t same : {0U, 1U, 3U})
    EXPECT_EQ(changed.traffic().arrived[same], steady.traffic().arrived[same]);
  EXPECT_GT(changed.traffic().arrived[index(Approach::kEast)], steady.traffic().arrived[index(Approach::kEast)] + 40U);
}

}  // namespace
}  // namespace lukou
