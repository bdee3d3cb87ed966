#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/services/traffic_engine/drive.hpp"

namespace lukou {
namespace {

/// Under a radio with this latency; without one it is the ideal radio.
EngineConfig with_latency(std::optional<double> latency_ms = {}) {
  EngineConfig config = lone_car_from_the_west();
  config.radio.seed = 1;
  if (!latency_ms) return config;
  config.radio.modelled = true;
  config.radio.downlink.latency = {.law = LatencyModel::Law::kConstant, .min_ms = *latency_ms};
  return config;
}

/// The first step in which an advice of step 100 acts, if RSU 2 says that it computed for so long.
Step first_used(Drive& drive, std::uint32_t computing_ms) {
  drive.run_to(100);
  RoadsideBatch batch = guidance(100, drive.air().frames.sender[0], -0.37, 1000);
  batch.computing_ms = computing_ms;
  drive.step(&batch);
  while (drive.now() < 112 && std::isnan(drive.traffic().commanded_mps2[0])) drive.step();
  return drive.now();
}

Step first_used(const EngineConfig& config, std::uint32_t computing_ms) {
  Drive drive(config);
  return first_used(drive, computing_ms);
}

// A frame is generated in (t_99, t_100], so one that is late by n whole steps is heard at t_(100 + n) and used from the
// next step on.

TEST(ComputingTime, IsNothingUnlessAnRsuSaysSo) {
  EXPECT_EQ(first_used(with_latency(), 0), 101);
  EXPECT_EQ(first_used(with_latency(0.0), 0), 101);
}

TEST(ComputingTime, DelaysGuidanceUnderTheIdealRadioAsUnderAModelledOne) {
  for (const auto& config : {with_latency(), with_latency(0.0)}) {
    EXPECT_EQ(first_used(config, 100), 102);
    EXPECT_EQ(first_used(config, 300), 104);
  }
}

TEST(ComputingTime, AddsToTheLatencyOfTheRadio) {
  EXPECT_EQ(first_used(with_latency(100.0), 200), 104);
  EXPECT_EQ(first_used(with_latency(40.0), 60), 102);
}

TEST(ComputingTime, OfAFifthOfAStepMakesAFifthOfTheStationsAStepLate) {
  int late = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    EngineConfig config = with_latency();
    config.radio.seed = seed;
    const Step used = first_used(config, 20);
    ASSERT_TRUE(used == 101 || used == 102);
    if (used == 102) ++late;
  }
  EXPECT_NEAR(late, 40, 20);  // binomial, deviation 5.7
}

TEST(ComputingTime, IsReportedByRsu) {
  Drive drive(with_latency());
  drive.run_to(100);
  RoadsideBatch batch = guidance(100, drive.air().frames.sender[0], -0.37, 1000);
  batch.computing_ms = 130;
  drive.step(&batch);
  EXPECT_EQ(drive.traffic().computing_ms, (std::vector<std::uint32_t>{130}));
  drive.step();
  EXPECT_EQ(drive.traffic().computing_ms, (std::vector<std::uint32_t>{0}));
}

TEST(ComputingTime, ThatIsMeasuredIsReplacedInAReplayByWhatWasRecorded) {
  EngineConfig config = with_latency();
  config.rsu_measured = {false, false, true};
  Drive late(config);
  late.node().replay({{.rsu = 2, .step = 100, .delay_ms = 200}});
  EXPECT_EQ(first_used(late, 7), 103);
  Drive early(config);
  early.node().replay({{.rsu = 2, .step = 99, .delay_ms = 200}, {.rsu = 1, .step = 100, .delay_ms = 200}});
  EXPECT_EQ(first_used(early, 700), 101) << "nothing was recorded of this step";
  config.rsu_measured = {false, false, false};
  Drive declared(config);
  declared.node().replay({});
  EXPECT_EQ(first_used(declared, 200), 103) << "a declared time is what the scenario says";
}

}  // namespace
}  // namespace lukou
