#include <gtest/gtest.h>

#include <vector>

#include "common/messages/rsm.hpp"
#include "services/rsu/rsu_node.hpp"
#include "tests/unit/services/rsu/rsu_rig.hpp"

namespace lukou {
namespace {

/// RSU number 2 with a camera and a radar.
RsuConfig seeing() {
  RsuConfig changed = config();
  changed.rsu = 2;
  changed.sensors = {{.radar = false, .accuracy_m = 0.3}, {.radar = true, .accuracy_m = 1.0}};
  return changed;
}

/// A car on WC, its front `distance_m` before the line.
void add_sensed(AirBatch& air, std::uint32_t rsu, std::uint32_t sensor, std::uint32_t track, double distance_m) {
  SensedColumns& sensed = air.sensed;
  sensed.rsu.push_back(rsu);
  sensed.sensor.push_back(sensor);
  sensed.track.push_back(track);
  sensed.x_m.push_back(-15.5 - distance_m);
  sensed.y_m.push_back(-5.25);
  sensed.speed_mps.push_back(8.0);
  sensed.heading_rad.push_back(math::kPi / 2);
  sensed.length_class.push_back(static_cast<std::uint8_t>(LengthClass::kShort));
  sensed.measured.push_back(air.step - 1);
}

std::vector<RoadsideSafety> safety_messages(const RoadsideBatch& out) {
  std::vector<RoadsideSafety> messages;
  for (std::size_t i = 0; i < out.frames.size(); ++i) {
    if (out.frames.kind[i] != static_cast<std::uint8_t>(FrameKind::kRsm)) continue;
    const auto message = decode_rsm(out.frames.payload_of(i));
    EXPECT_TRUE(message) << message.error().text();
    messages.push_back(message.value());
  }
  return messages;
}

/// Answers one step of step 5.
RoadsideBatch answer(const AirBatch& air, Scripted::Script script) {
  RsuNode node(seeing(), std::make_unique<Scripted>(std::move(script)));
  const SignalBatch signal = signals(air.step);
  RoadsideBatch out;
  node.step(air.step, &signal, air, out);
  return out;
}

AirBatch at_step(Step step) {
  AirBatch air;
  air.step = step;
  return air;
}

TEST(RsuNodeSensing, ShowsItsAlgorithmWhatItsOwnSensorsSee) {
  AirBatch air = at_step(5);
  add_sensed(air, 2, 1, 40, 90.0);
  add_sensed(air, 2, 0, 30, 60.0);
  add_sensed(air, 1, 0, 50, 20.0);  // of another RSU
  add_sensed(air, 2, 9, 60, 20.0);  // of a sensor that it does not know
  // An algorithm of a researcher who holds back a heard car that has a sensed one close ahead.
  const RoadsideBatch out = [&] {
    add_car(air, 77, 70.0, 12.0);
    return answer(air, [](const RsuView& heard, RsuAnswer& reply) {
      const LaneView& lane = heard.lanes[1];
      ASSERT_EQ(lane.sensed.size(), 2U);
      EXPECT_EQ(lane.sensed[0].track, 30U);
      EXPECT_EQ(lane.sensed[0].sensor, 0U);
      EXPECT_EQ(lane.sensed[0].age, 1);
      EXPECT_NEAR(lane.sensed[0].distance_m, 60.0, 1e-9);
      EXPECT_EQ(lane.sensed[1].track, 40U);
      EXPECT_TRUE(heard.lanes[0].sensed.empty());
      for (const HeardCar& car : lane.cars) {
        for (const SensedCar& ahead : lane.sensed) {
          const double gap_m = car.distance_m - ahead.distance_m;
          if (gap_m > 2.0 && gap_m < 30.0) reply.advise(car.id, {.acceleration_mps2 = -1.0, .lifetime = 5});
        }
      }
    });
  }();
  std::size_t advices = 0;
  for (const std::uint8_t kind : out.frames.kind) advices += kind == static_cast<std::uint8_t>(FrameKind::kRsc);
  EXPECT_EQ(advices, 1U);
}

TEST(RsuNodeSensing, TellsInItsRsmWhatItsSensorsSee) {
  AirBatch air = at_step(5);
  add_sensed(air, 2, 1, 40, 90.0);
  add_sensed(air, 2, 0, 30, 60.0);
  const auto messages = safety_messages(answer(air, [](const RsuView&, RsuAnswer&) {}));
  ASSERT_EQ(messages.size(), 1U);
  EXPECT_EQ(messages[0].rsu, 900U);
  ASSERT_EQ(messages[0].participants.size(), 2U);
  const Participant& radar = messages[0].participants[0];
  EXPECT_EQ(radar.number, 1);
  EXPECT_EQ(radar.type, ParticipantType::kMotor);
  EXPECT_EQ(radar.source, ParticipantSource::kMicrowaveRadar);
  EXPECT_FALSE(radar.vehicle);
  EXPECT_EQ(radar.second_mark_ms, 400);  // seen a step ago
  // The front is 90 m before the line; the centre half of the class's 4.5 m behind it.
  EXPECT_NEAR(radar.centre.x_m, -15.5 - 90.0 - 2.25, 0.0056);
  EXPECT_NEAR(radar.centre.y_m, -5.25, 0.0056);
  EXPECT_EQ(radar.accuracy_m, 1.0);
  EXPECT_NEAR(radar.speed_mps.value(), 8.0, 0.01);
  EXPECT_NEAR(radar.length_m, 4.5, 1e-9);
  const Participant& camera = messages[0].participants[1];
  EXPECT_EQ(camera.number, 2);
  EXPECT_EQ(camera.source, ParticipantSource::kVideo);
  EXPECT_EQ(camera.accuracy_m, 0.5);  // the finest class that is not better than 0.3 m
}

TEST(RsuNodeSensing, SaysNoRsmIfItSeesNothing) {
  AirBatch air = at_step(5);
  add_car(air, 77, 70.0, 12.0);
  add_sensed(air, 1, 0, 50, 20.0);  // of another RSU
  EXPECT_TRUE(safety_messages(answer(air, [](const RsuView&, RsuAnswer&) {})).empty());
}

TEST(RsuNodeSensing, TellsAtMostSixteenInAFrame) {
  AirBatch air = at_step(5);
  for (std::uint32_t track = 0; track < 35; ++track) add_sensed(air, 2, 0, track, 20.0 + 6.0 * track);
  const auto messages = safety_messages(answer(air, [](const RsuView&, RsuAnswer&) {}));
  ASSERT_EQ(messages.size(), 3U);
  EXPECT_EQ(messages[0].participants.size(), 16U);
  EXPECT_EQ(messages[1].participants.size(), 16U);
  EXPECT_EQ(messages[2].participants.size(), 3U);
  EXPECT_EQ(messages[2].count, 2);
}

/// What an RSU knows of the one car that says `message`.
std::vector<HeardCar> heard_of(const BasicSafety& message, Step now) {
  std::vector<HeardCar> cars;
  RsuNode node = node_with([&](const RsuView& heard, RsuAnswer&) {
    for (const LaneView& lane : heard.lanes) cars.insert(cars.end(), lane.cars.begin(), lane.cars.end());
  });
  AirBatch air = at_step(now);
  append(air.frames, {.sender = message.temporary_id}, message);
  append(air.frames, {.sender = message.temporary_id}, message);  // said twice
  const SignalBatch signal = signals(now);
  RoadsideBatch out;
  node.step(now, &signal, air, out);
  EXPECT_EQ(out.frames_malformed, 0U);
  return cars;
}

BasicSafety car_on_the_road(Step now, double ahead_ms) {
  BasicSafety message;
  message.temporary_id = 5;
  message.second_mark_ms = second_mark_ms(now, ahead_ms);
  message.centre = {-215.5, -5.25};
  message.speed_mps = 10.0;
  message.heading_rad = math::kPi / 2;
  return message;
}

TEST(RsuNodeErrors, TakesAMarkOfTheNearFutureForNow) {
  for (const Step now : {5, 599, 600, 605}) {
    for (const double ahead_ms : {-40.0, 0.0, 30.0, 700.0}) {
      const auto cars = heard_of(car_on_the_road(now, ahead_ms), now);
      ASSERT_EQ(cars.size(), 1U) << now << " " << ahead_ms;
      EXPECT_EQ(cars[0].age, 0);
    }
    EXPECT_EQ(heard_of(car_on_the_road(now, -420.0), now).at(0).age, 4);
    EXPECT_TRUE(heard_of(car_on_the_road(now, 2000.0), now).empty());
    EXPECT_TRUE(heard_of(car_on_the_road(now, -2000.0), now).empty());
  }
}

TEST(RsuNodeErrors, TellsHowAccurateACarTakesItsPositionToBe) {
  BasicSafety message = car_on_the_road(5, 0.0);
  EXPECT_FALSE(heard_of(message, 5).at(0).accuracy_m);
  message.accuracy_m = 1.5;
  EXPECT_NEAR(heard_of(message, 5).at(0).accuracy_m.value(), 1.5, 1e-9);
}

TEST(RsuNodeErrors, KnowsNoCarWhosePositionIsOffTheRoad) {
  for (const PlanePoint centre : {PlanePoint{-215.5, 40.0}, {-215.5, -11.0}, {9000.0, 0.0}, {-800.0, -5.25}}) {
    BasicSafety message = car_on_the_road(5, 0.0);
    message.centre = centre;
    EXPECT_TRUE(heard_of(message, 5).empty()) << centre.x_m << " " << centre.y_m;
  }
  BasicSafety beside = car_on_the_road(5, 0.0);
  beside.centre.y_m = -2.0;  // 3.25 m to the left: the lane of those who turn left
  EXPECT_EQ(heard_of(beside, 5).at(0).lane, lane_of(Approach::kWest, Turn::kLeft));
}

}  // namespace
}  // namespace lukou
