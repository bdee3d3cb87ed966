#include "services/rsu/rsu_config.hpp"

#include <gtest/gtest.h>

#include "scenario.pb.h"

namespace lukou {
namespace {

scenario::Scenario two_rsus() {
  scenario::Scenario from;
  from.mutable_run()->set_seed(3);
  from.mutable_radio()->mutable_uplink()->mutable_loss()->set_rate(0.25);
  from.mutable_traffic()->set_approach_length_m(400.0);
  from.mutable_traffic()->set_exit_length_m(80.0);
  from.mutable_vehicles()->set_speed_limit_kmh(72.0);
  from.mutable_vehicles()->set_acceleration_max_mps2(2.5);
  from.add_rsus()->set_algorithm("none");
  scenario::Rsu& second = *from.add_rsus();
  second.set_algorithm("arrive_on_green");
  second.mutable_arrive_on_green()->set_headway_s(1.5);
  second.mutable_arrive_on_green()->set_final_braking_mps2(1.1);
  second.mutable_arrive_on_green()->set_lifetime_s(2.0);
  second.add_sensors()->set_kind(scenario::Sensor::CAMERA);
  second.add_sensors()->set_kind(scenario::Sensor::RADAR);
  second.mutable_sensors(1)->set_position_noise_m(0.7);
  return from;
}

TEST(RsuConfig, KnowsWhatTheControllerKeepsIfItHearsRequests) {
  scenario::Scenario from = two_rsus();
  EXPECT_FALSE(rsu_config(from, 0).value().actuation);
  scenario::Actuation& said = *from.mutable_signals()->mutable_actuation();
  said.set_min_green_s(7.5);
  said.set_yellow_s(4.0);
  said.set_all_red_s(1.2);
  said.set_max_wait_s(90.0);
  EXPECT_EQ(rsu_config(from, 1).value().actuation,
            (Actuation{.min_green = 75, .yellow = 40, .all_red = 12, .max_wait = 900}));
}

TEST(RsuConfig, SaysWhatTheScenarioSays) {
  const auto config = rsu_config(two_rsus(), 1);
  ASSERT_TRUE(config) << config.error().text();
  EXPECT_EQ(config.value().rsu, 1U);
  EXPECT_EQ(config.value().algorithm, "arrive_on_green");
  EXPECT_EQ(config.value().road.approach_m, 400.0);
  EXPECT_EQ(config.value().road.exit_m, 80.0);
  EXPECT_DOUBLE_EQ(config.value().speed_limit_mps, 20.0);
  const ArriveOnGreenParameters& parameters = config.value().parameters.arrive_on_green;
  EXPECT_EQ(parameters.acceleration_max_mps2, 2.5);
  EXPECT_EQ(parameters.headway_s, 1.5);
  EXPECT_EQ(parameters.rates.final_braking_mps2, 1.1);
  EXPECT_EQ(parameters.lifetime_s, 2.0);
  EXPECT_TRUE(config.value().radio.modelled);
  EXPECT_EQ(config.value().radio.seed, 3U);
  EXPECT_EQ(config.value().radio.uplink.loss_rate, 0.25);
  ASSERT_EQ(config.value().sensors.size(), 2U);
  EXPECT_FALSE(config.value().sensors[0].radar);
  EXPECT_TRUE(config.value().sensors[1].radar);
  EXPECT_EQ(config.value().sensors[1].accuracy_m, 0.7);
  EXPECT_NE(config.value().station_id, rsu_config(two_rsus(), 0).value().station_id);
}

TEST(RsuConfig, RefusesAnRsuThatIsNotThere) {
  const auto config = rsu_config(two_rsus(), 2);
  ASSERT_FALSE(config);
  EXPECT_EQ(config.error().where, "rsus");
}

TEST(RsuConfig, TakesTheParametersOfEachAlgorithmInMetresAndSeconds) {
  scenario::Scenario from = two_rsus();
  scenario::Rsu& rsu = *from.mutable_rsus(0);
  rsu.mutable_glosa()->set_speed_min_kmh(25.2);
  rsu.mutable_glosa()->set_activation_distance_m(150.0);
  rsu.mutable_glosa_queue()->set_headway_s(1.8);
  rsu.mutable_glosa_queue()->set_equipped_share(0.7);
  rsu.mutable_eco()->set_end_speed_kmh(36.0);
  rsu.mutable_eco()->set_slack_s(0.5);
  rsu.mutable_platoon()->set_gap_s(2.5);
  rsu.mutable_platoon()->set_end_speed_kmh(45.0);
  rsu.mutable_speed_harmonisation()->set_speed_change_kmh_per_s(7.2);
  rsu.mutable_speed_harmonisation()->set_spacing_m(6.0);
  const AlgorithmParameters parameters = rsu_config(from, 0).value().parameters;
  EXPECT_DOUBLE_EQ(parameters.glosa.approach.speed_min_mps, 7.0);
  EXPECT_EQ(parameters.glosa.approach.activation_distance_m, 150.0);
  EXPECT_EQ(parameters.glosa.approach.acceleration_max_mps2, 2.5);
  EXPECT_FALSE(parameters.glosa.queue);
  ASSERT_TRUE(parameters.glosa_queue.queue);
  EXPECT_EQ(parameters.glosa_queue.queue->headway_s, 1.8);
  EXPECT_EQ(parameters.glosa_queue.queue->equipped_share, 0.7);
  ASSERT_TRUE(parameters.eco.end_speed_mps);
  EXPECT_DOUBLE_EQ(*parameters.eco.end_speed_mps, 10.0);
  EXPECT_EQ(parameters.eco.approach.slack_s, 0.5);
  EXPECT_EQ(parameters.platoon.gap_s, 2.5);
  EXPECT_DOUBLE_EQ(parameters.platoon.end_speed_mps, 12.5);
  EXPECT_DOUBLE_EQ(parameters.speed_harmonisation.speed_change_mps2, 2.0);
  EXPECT_EQ(parameters.speed_harmonisation.queue.spacing_m, 6.0);
  rsu.mutable_eco()->set_end_speed_kmh(0.0);
  EXPECT_FALSE(rsu_config(from, 0).value().parameters.eco.end_speed_mps) << "0 = free";
}

}  // namespace
}  // namespace lukou
