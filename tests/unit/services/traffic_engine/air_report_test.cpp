#include "services/traffic_engine/air_report.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "common/messages/bsm.hpp"
#include "tests/unit/services/traffic_engine/drive.hpp"

namespace lukou {
namespace {

BasicSafety first_message(const AirBatch& air) {
  const auto message = decode_bsm(air.frames.payload_of(0));
  EXPECT_TRUE(message) << message.error().text();
  return message.value();
}

TEST(AirReport, SaysTheSameBytesWhenEveryErrorIsZero) {
  EngineConfig zero = lone_car_from_the_west();
  zero.unit_errors.correlation_s = 1.0;
  Drive plain(lone_car_from_the_west());
  Drive same(zero);
  for (Step step = 0; step < 300; ++step) {
    plain.step(), same.step();
    EXPECT_EQ(plain.air().frames.payload, same.air().frames.payload);
    EXPECT_EQ(plain.air().frames.wire_bytes, same.air().frames.wire_bytes);
  }
}

TEST(AirReport, PutsTheErrorIntoTheMessageAndTheTruthOnTheEnvelope) {
  EngineConfig config = lone_car_from_the_west();
  config.unit_errors = {.bias_m = 4.0, .noise_m = 3.0, .correlation_s = 10.0, .clock_offset_ms = 200.0};
  Drive plain(lone_car_from_the_west());
  Drive wrong(config);
  traffic::UnitErrors expected(config.traffic.seed, config.unit_errors);
  for (Step step = 0; step <= 300; ++step) {
    plain.step(), wrong.step();
    if (step == 0) continue;
    const BasicSafety truth = first_message(plain.air());
    const BasicSafety said = first_message(wrong.air());
    const traffic::UnitError error = expected.of(0, step);
    EXPECT_NEAR(said.centre.x_m - truth.centre.x_m, error.east_m, 0.0112);  // twice half a unit
    EXPECT_NEAR(said.centre.y_m - truth.centre.y_m, error.north_m, 0.0112);
    EXPECT_EQ(said.second_mark_ms, second_mark_ms(step, error.clock_ms));
    EXPECT_DOUBLE_EQ(said.accuracy_m.value(), 5.0);
    EXPECT_EQ(said.speed_mps, truth.speed_mps);
    EXPECT_EQ(wrong.air().frames.antenna_x_m[0], plain.air().frames.antenna_x_m[0]);
    EXPECT_EQ(wrong.air().frames.antenna_y_m[0], plain.air().frames.antenna_y_m[0]);
  }
  // A standard deviation of 200 ms: the offset is not the one in thousands that rounds to nothing.
  EXPECT_NE(first_message(wrong.air()).second_mark_ms, second_mark_ms(300));
}

TEST(AirReport, LeavesTheTrafficAlone) {
  EngineConfig config = lone_car_from_the_west();
  config.unit_errors = {.bias_m = 5.0, .noise_m = 5.0, .correlation_s = 1.0, .clock_offset_ms = 100.0};
  config.sensors = {{.position_noise_m = 1.0}};
  Drive plain(lone_car_from_the_west());
  Drive watched(config);
  plain.run_to(400), watched.run_to(400);
  EXPECT_EQ(plain.traffic().position_m, watched.traffic().position_m);
}

TEST(AirReport, CarriesWhatSensorsDeliver) {
  EngineConfig config = lone_car_from_the_west();
  config.traffic.equipped_ratio = 0.0;
  config.sensors = {{.rsu = 3, .sensor = 1, .approach = Approach::kWest, .from_m = 0.0, .to_m = 150.0}};
  Drive drive(config);
  drive.run_to(200);  // 15 m/s for 19.9 s: 201.5 m before the line
  EXPECT_EQ(drive.air().sensed.size(), 0U);
  drive.run_to(301);
  EXPECT_EQ(drive.air().frames.size(), 0U);
  const SensedColumns& sensed = drive.air().sensed;
  ASSERT_EQ(sensed.size(), 1U);
  EXPECT_TRUE(sensed.well_formed());
  EXPECT_EQ(sensed.rsu[0], 3U);
  EXPECT_EQ(sensed.sensor[0], 1U);
  EXPECT_NEAR(sensed.x_m[0], -15.5 - 50.0, 1e-6);  // 450 m from the entrance
  EXPECT_EQ(sensed.length_class[0], static_cast<std::uint8_t>(LengthClass::kShort));
  EXPECT_EQ(sensed.measured[0], 301);
}

TEST(AirReport, FollowsALiveChange) {
  EngineConfig config = lone_car_from_the_west();
  Drive drive(config);
  drive.run_to(100);
  EXPECT_FALSE(first_message(drive.air()).accuracy_m);
  config.unit_errors.bias_m = 10.0;
  drive.node().change(config);
  drive.step();
  EXPECT_DOUBLE_EQ(first_message(drive.air()).accuracy_m.value(), 10.0);
}

}  // namespace
}  // namespace lukou
