#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "common/scenario/scenario.hpp"
#include "scenario.pb.h"

namespace lukou::scenario {
namespace {

Expected<Resolved> loaded(const std::string& text, const std::vector<std::string>& sets = {}) {
  return load_text(text, "my.textproto", "/nowhere", sets);
}

TEST(Sensors, AreNoneAndUnitsAreExactUnlessTheScenarioSaysOtherwise) {
  const auto result = loaded("");
  ASSERT_TRUE(result.ok());
  EXPECT_EQ(result.value().message().rsus(0).sensors_size(), 0);
  EXPECT_FALSE(result.value().message().vehicles().has_positioning());
  EXPECT_EQ(result.value().message().vehicles().clock_offset_ms(), 0.0);
  // A scenario that does not speak of them reads as it did before there were any.
  for (const char* word : {"sensors", "positioning", "clock_offset_ms"}) {
    EXPECT_EQ(text(result.value()).find(word), std::string::npos) << word;
  }
}

TEST(Sensors, SeeTheLastHundredAndFiftyMetresWithoutAnError) {
  const auto result = loaded("rsus { sensors { approach: NORTH } }");
  ASSERT_TRUE(result.ok()) << result.error().text();
  const Sensor& sensor = result.value().message().rsus(0).sensors(0);
  EXPECT_EQ(sensor.approach(), Sensor::NORTH);
  EXPECT_EQ(sensor.kind(), Sensor::CAMERA);
  EXPECT_EQ(sensor.from_m(), 0.0);
  EXPECT_EQ(sensor.to_m(), 150.0);
  EXPECT_EQ(sensor.miss_rate(), 0.0);
  EXPECT_EQ(sensor.position_noise_m(), 0.0);
  EXPECT_EQ(sensor.speed_noise_mps(), 0.0);
  EXPECT_EQ(sensor.latency_ms(), 0.0);
}

TEST(Sensors, MayBeSetOneByOne) {
  const auto result = loaded("", {"rsus[0].sensors[0].approach=WEST", "rsus[0].sensors[1]={approach: EAST kind: RADAR}",
                                  "rsus[0].sensors[0].to_m=80"});
  ASSERT_TRUE(result.ok()) << result.error().text();
  const Rsu& rsu = result.value().message().rsus(0);
  ASSERT_EQ(rsu.sensors_size(), 2);
  EXPECT_EQ(rsu.sensors(0).to_m(), 80.0);
  EXPECT_EQ(rsu.sensors(1).kind(), Sensor::RADAR);
}

TEST(Sensors, ReadTheirCanonicalTextBackToTheSameText) {
  const auto first = loaded(
      "vehicles { positioning { bias_m: 1 } clock_offset_ms: 5 } rsus { sensors { approach: EAST kind: RADAR } }");
  ASSERT_TRUE(first.ok()) << first.error().text();
  const auto second = loaded(text(first.value()));
  ASSERT_TRUE(second.ok()) << second.error().text();
  EXPECT_EQ(text(second.value()), text(first.value()));
  EXPECT_EQ(second.value().message().vehicles().positioning().correlation_s(), 60.0);
  EXPECT_EQ(second.value().message().vehicles().clock_offset_ms(), 5.0);
}

TEST(Sensors, AreToldInOneLineEach) {
  const auto result = loaded(
      "rsus {} rsus { sensors { approach: WEST kind: RADAR from_m: 20 to_m: 120 miss_rate: 0.05 position_noise_m: 0.5 "
      "latency_ms: 80 } sensors { approach: EAST } }");
  ASSERT_TRUE(result.ok()) << result.error().text();
  EXPECT_EQ(sensor_lines(result.value()),
            (std::vector<std::string>{
                "rsus[1].sensors[0]: RADAR, WEST, 20 to 120 m before the line; misses 5 %, errs by 0.5 m and 0 m/s, "
                "late by 80 ms",
                "rsus[1].sensors[1]: CAMERA, EAST, 0 to 150 m before the line; misses 0 %, errs by 0 m and 0 m/s, late "
                "by 0 ms"}));
}

struct Bad {
  const char* text;
  const char* error;
};

constexpr Bad kBad[] = {
    {"rsus { sensors { kind: CAMERA } }",
     "my.textproto:1:8: rsus[0].sensors[0].approach is missing; it takes one of WEST, SOUTH, EAST, NORTH"},
    {"rsus {\n  sensors { approach: WEST from_m: 50 to_m: 50 }\n}",
     "my.textproto:2:39: rsus[0].sensors[0].to_m is 50 m, must be above from_m, 50 m"},
    {"rsus { sensors { approach: WEST from_m: 200 } }",
     "my.textproto:1:33: rsus[0].sensors[0].to_m is 150 m, must be above from_m, 200 m"},
    {"rsus { sensors { approach: WEST to_m: 501 } }",
     "my.textproto:1:33: rsus[0].sensors[0].to_m is 501 m, must be at most traffic.approach_length_m, 500 m"},
    {"rsus { sensors { approach: WEST miss_rate: 1 } }",
     "my.textproto:1:33: rsus[0].sensors[0].miss_rate is 1, must be within [0, 0.999]"},
    {"rsus { sensors { approach: WEST latency_ms: -5 } }",
     "my.textproto:1:33: rsus[0].sensors[0].latency_ms is -5 ms, must be within [0, 5000] ms"},
    {"rsus { sensors { approach: WEST position_noise_m: 21 } }",
     "my.textproto:1:33: rsus[0].sensors[0].position_noise_m is 21 m, must be within [0, 20] m"},
    {"rsus { sensors { approach: UP } }",
     "my.textproto:1:28: `UP` is no value of approach: radio.outages[].approach takes WEST, SOUTH, EAST, NORTH, ALL; "
     "rsus[].sensors[].approach takes WEST, SOUTH, EAST, NORTH"},
    {"vehicles { positioning { noise_m: 51 } }",
     "my.textproto:1:26: vehicles.positioning.noise_m is 51 m, must be within [0, 50] m"},
    {"vehicles { positioning { noise_m: 1 correlation_s: 0 } }",
     "my.textproto:1:37: vehicles.positioning.correlation_s is 0 s, must be within [0.1, 3600] s"},
    {"vehicles { clock_offset_ms: 1001 }",
     "my.textproto:1:12: vehicles.clock_offset_ms is 1001 ms, must be within [0, 1000] ms"},
};

TEST(Sensors, SayWhereTheyAreWrongAndWhatWouldBeRight) {
  for (const Bad& bad : kBad) {
    const auto result = loaded(bad.text);
    ASSERT_FALSE(result.ok()) << bad.text;
    EXPECT_EQ(result.error().text(), bad.error) << bad.text;
  }
}

TEST(Sensors, ChangeWhatTheySeeWhileARunGoesOnButNotWhereTheyLook) {
  auto result = loaded("rsus { sensors { approach: WEST } }");
  ASSERT_TRUE(result.ok());
  Resolved live = std::move(result).value();
  EXPECT_TRUE(change(live, "rsus[0].sensors[0].miss_rate=0.4").ok());
  EXPECT_TRUE(change(live, "rsus[0].sensors[0].latency_ms=250").ok());
  EXPECT_EQ(live.message().rsus(0).sensors(0).miss_rate(), 0.4);
  EXPECT_FALSE(change(live, "rsus[0].sensors[0].to_m=100").ok());
  EXPECT_FALSE(change(live, "rsus[0].sensors[1].miss_rate=0.4").ok());  // there is no second one
  EXPECT_FALSE(change(live, "rsus[0].sensors[1]={approach: WEST}").ok());
  EXPECT_EQ(live.message().rsus(0).sensors_size(), 1);
}

TEST(Sensors, LetUnitsBecomeWrongWhileARunGoesOn) {
  auto result = loaded("");
  ASSERT_TRUE(result.ok());
  Resolved live = std::move(result).value();
  EXPECT_TRUE(change(live, "vehicles.positioning.noise_m=1.5").ok());
  EXPECT_TRUE(change(live, "vehicles.clock_offset_ms=30").ok());
  EXPECT_EQ(live.message().vehicles().positioning().noise_m(), 1.5);
  EXPECT_EQ(live.message().vehicles().positioning().correlation_s(), 60.0);
}

}  // namespace
}  // namespace lukou::scenario
