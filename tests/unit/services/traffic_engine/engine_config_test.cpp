#include "services/traffic_engine/engine_config.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "common/scenario/scenario.hpp"

namespace lukou {
namespace {

Expected<EngineConfig> config_of(const std::string& text) {
  const auto scenario = scenario::load_text(text, "test", std::filesystem::temp_directory_path());
  if (!scenario) return scenario.error();
  return engine_config(scenario.value());
}

TEST(EngineConfig, OfAnEmptyScenarioIsTheDefaultOfTheModel) {
  const auto config = config_of("");
  ASSERT_TRUE(config) << config.error().text();
  const traffic::EngineParameters& from = config.value().traffic;
  const traffic::EngineParameters model;
  EXPECT_EQ(from.seed, model.seed);
  EXPECT_EQ(from.equipped_ratio, model.equipped_ratio);
  EXPECT_EQ(from.overflow_wait_s, model.overflow_wait_s);
  EXPECT_EQ(from.road.approach_m, model.road.approach_m);
  EXPECT_EQ(from.road.exit_m, model.road.exit_m);
  EXPECT_EQ(from.vehicles.length_m, model.vehicles.length_m);
  EXPECT_EQ(from.vehicles.width_m, model.vehicles.width_m);
  EXPECT_EQ(from.vehicles.speed_limit_mps, model.vehicles.speed_limit_mps);
  EXPECT_EQ(from.vehicles.acceleration_max_mps2, model.vehicles.acceleration_max_mps2);
  EXPECT_EQ(from.vehicles.actuation_noise_mps2, model.vehicles.actuation_noise_mps2);
  EXPECT_EQ(from.driving.desired_speed_mean, model.driving.desired_speed_mean);
  EXPECT_EQ(from.driving.desired_speed_deviation, model.driving.desired_speed_deviation);
  EXPECT_EQ(from.driving.desired_speed_min, model.driving.desired_speed_min);
  EXPECT_EQ(from.driving.desired_speed_max, model.driving.desired_speed_max);
  EXPECT_EQ(from.driving.initial_speed_min, model.driving.initial_speed_min);
  EXPECT_EQ(from.driving.safe_time_s, model.driving.safe_time_s);
  EXPECT_EQ(from.driving.standstill_spacing_m, model.driving.standstill_spacing_m);
  EXPECT_EQ(from.driving.guard_spacing_m, model.driving.guard_spacing_m);
  EXPECT_EQ(from.driving.reaction_distance_m, model.driving.reaction_distance_m);
  EXPECT_EQ(from.driving.comfortable_braking_mps2, model.driving.comfortable_braking_mps2);
  EXPECT_EQ(from.driving.perception_threshold_radps, model.driving.perception_threshold_radps);
  EXPECT_EQ(from.driving.perception_floor_mps, model.driving.perception_floor_mps);
  EXPECT_EQ(from.driving.band_near, model.driving.band_near);
  EXPECT_EQ(from.driving.band_far, model.driving.band_far);
  EXPECT_EQ(from.driving.singularity_m, model.driving.singularity_m);
  EXPECT_EQ(from.driving.speed_relaxation_s, model.driving.speed_relaxation_s);
  EXPECT_EQ(from.driving.gap_closing_mps2, model.driving.gap_closing_mps2);
  EXPECT_EQ(from.driving.discharge_speed_mps, model.driving.discharge_speed_mps);
  EXPECT_EQ(from.driving.reaction_time_s, model.driving.reaction_time_s);
  EXPECT_EQ(config.value().unit_errors, traffic::UnitErrorParameters{});
  EXPECT_TRUE(config.value().sensors.empty());
  EXPECT_EQ(from.unit.fallback_s, model.unit.fallback_s);
  EXPECT_EQ(from.unit.rsu_lost_after_s, model.unit.rsu_lost_after_s);
  EXPECT_EQ(from.compliance.human_share, model.compliance.human_share);
  EXPECT_EQ(from.compliance.ignoring_share, model.compliance.ignoring_share);
  EXPECT_EQ(from.compliance.reaction_s, model.compliance.reaction_s);
  EXPECT_EQ(from.compliance.gain_deviation, model.compliance.gain_deviation);
  EXPECT_EQ(from.compliance.threshold_mps2, model.compliance.threshold_mps2);
  for (std::size_t i = 0; i < kApproaches; ++i) {
    EXPECT_FALSE(from.demand[i].listed);
    ASSERT_EQ(from.demand[i].flows.size(), 1U);
    EXPECT_EQ(from.demand[i].flows[0].flow_veh_per_h, model.demand[i].flows[0].flow_veh_per_h);
    EXPECT_EQ(from.demand[i].lane_weights, model.demand[i].lane_weights);
  }
}

TEST(EngineConfig, TakesDemandByApproach) {
  const auto config = config_of(R"(traffic {
    west { flow_veh_per_h: 300 shares { left: 2 center: 0 right: 1 } }
    north { flow_series { from_s: 0 flow_veh_per_h: 100 } flow_series { from_s: 60 flow_veh_per_h: 200 } }
  })");
  ASSERT_TRUE(config) << config.error().text();
  const auto& demand = config.value().traffic.demand;
  EXPECT_EQ(demand[index(Approach::kWest)].flows[0].flow_veh_per_h, 300.0);
  EXPECT_EQ(demand[index(Approach::kWest)].lane_weights, (std::array<double, 3>{2.0, 0.0, 1.0}));
  ASSERT_EQ(demand[index(Approach::kNorth)].flows.size(), 2U);
  EXPECT_EQ(demand[index(Approach::kNorth)].flows[1].from_s, 60.0);
  EXPECT_EQ(demand[index(Approach::kSouth)].flows[0].flow_veh_per_h, 1800.0);
}

TEST(EngineConfig, ReadsATraceOfArrivals) {
  const auto file = std::filesystem::temp_directory_path() / "lukou_engine_config_test.csv";
  std::ofstream(file) << "time_s,approach\n1.5,west\n2.25,south\n4,west\n";
  const auto config = config_of("traffic { west { arrivals_csv: \"" + file.filename().string() + "\" } }");
  std::filesystem::remove(file);
  ASSERT_TRUE(config) << config.error().text();
  EXPECT_TRUE(config.value().traffic.demand[index(Approach::kWest)].listed);
  EXPECT_EQ(config.value().traffic.demand[index(Approach::kWest)].arrivals_s, (std::vector<double>{1.5, 4.0}));
}

TEST(EngineConfig, TakesSensorsOfAllRsusAndTheErrorsOfUnits) {
  const auto config = config_of(R"(
    vehicles { positioning { bias_m: 1 noise_m: 2 correlation_s: 3 } clock_offset_ms: 4 }
    rsus { sensors { approach: SOUTH } }
    rsus {
      sensors { approach: WEST }
      sensors { approach: NORTH from_m: 10 to_m: 99 miss_rate: 0.1 position_noise_m: 0.2 speed_noise_mps: 0.3 latency_ms: 40 }
    })");
  ASSERT_TRUE(config) << config.error().text();
  EXPECT_EQ(config.value().unit_errors,
            (traffic::UnitErrorParameters{.bias_m = 1, .noise_m = 2, .correlation_s = 3, .clock_offset_ms = 4}));
  const auto& sensors = config.value().sensors;
  ASSERT_EQ(sensors.size(), 3U);
  EXPECT_EQ(sensors[0].approach, Approach::kSouth);
  EXPECT_EQ(sensors[1].approach, Approach::kWest);
  EXPECT_EQ(sensors[2].rsu, 1U);
  EXPECT_EQ(sensors[2].sensor, 1U);
  EXPECT_EQ(sensors[2].approach, Approach::kNorth);
  EXPECT_EQ(sensors[2].from_m, 10.0);
  EXPECT_EQ(sensors[2].to_m, 99.0);
  EXPECT_EQ(sensors[2].miss_rate, 0.1);
  EXPECT_EQ(sensors[2].position_noise_m, 0.2);
  EXPECT_EQ(sensors[2].speed_noise_mps, 0.3);
  EXPECT_EQ(sensors[2].latency_ms, 40.0);
}

TEST(EngineConfig, RefusesAGuardThatIsWiderThanTheStandstill) {
  EXPECT_FALSE(config_of("driving { standstill_spacing_m: 5.5 guard_spacing_m: 5.6 }"));
  EXPECT_TRUE(config_of("driving { standstill_spacing_m: 5.6 guard_spacing_m: 5.6 }"));
}

TEST(EngineConfig, RefusesInitialSpeedsThatNobodyDraws) {
  EXPECT_FALSE(config_of("driving { initial_speed_min: 0.95 }"));
}

}  // namespace
}  // namespace lukou
