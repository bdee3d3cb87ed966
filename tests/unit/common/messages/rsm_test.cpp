#include "common/messages/rsm.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "tests/unit/common/messages/one_frame.hpp"
#include "v2x.pb.h"

namespace lukou {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kPi = 3.14159265358979323846;

Participant some_car(std::uint16_t number) {
  return {.type = ParticipantType::kMotor,
          .number = number,
          .source = ParticipantSource::kVideo,
          .vehicle = {},
          .second_mark_ms = 59'900,
          .centre = {-123.456, -5.25},
          .accuracy_m = 0.5,
          .speed_mps = 13.37,
          .heading_rad = kPi / 2,
          .width_m = 1.8,
          .length_m = 4.5};
}

RoadsideSafety seen(std::size_t cars) {
  RoadsideSafety message;
  message.rsu = 0x5253550000000000;
  message.count = 127;
  for (std::size_t i = 0; i < cars; ++i) message.participants.push_back(some_car(static_cast<std::uint16_t>(i + 1)));
  return message;
}

Participant decoded(const Participant& participant) {
  RoadsideSafety message = seen(1);
  message.participants[0] = participant;
  const auto result = decode_rsm(one_frame(message).payload);
  EXPECT_TRUE(result) << result.error().text();
  return result.value().participants.at(0);
}

v2x::RoadsideSafetyMessage on_the_wire(const RoadsideSafety& message) {
  v2x::RoadsideSafetyMessage wire;
  EXPECT_TRUE(wire.ParseFromString(bytes_of(one_frame(message))));
  return wire;
}

TEST(Rsm, ReturnsWhatWasSeen) {
  RoadsideSafety message = seen(2);
  message.participants[1].vehicle = 0xfedcba9876543210;
  message.participants[1].source = ParticipantSource::kSeveral;
  message.participants[1].type = ParticipantType::kPedestrian;
  const auto result = decode_rsm(one_frame(message).payload);
  ASSERT_TRUE(result) << result.error().text();
  EXPECT_EQ(result.value().rsu, 0x5253550000000000U);
  EXPECT_EQ(result.value().count, 127);
  ASSERT_EQ(result.value().participants.size(), 2U);
  const Participant& first = result.value().participants[0];
  EXPECT_EQ(first.type, ParticipantType::kMotor);
  EXPECT_EQ(first.number, 1);
  EXPECT_EQ(first.source, ParticipantSource::kVideo);
  EXPECT_FALSE(first.vehicle);
  EXPECT_EQ(first.second_mark_ms, 59'900);
  EXPECT_EQ(first.accuracy_m, 0.5);
  const Participant& second = result.value().participants[1];
  EXPECT_EQ(second.type, ParticipantType::kPedestrian);
  EXPECT_EQ(second.source, ParticipantSource::kSeveral);
  EXPECT_EQ(second.vehicle, 0xfedcba9876543210U);
}

TEST(Rsm, ErrsByHalfAUnitAtMostOverTheWholeRange) {
  Participant car = some_car(1);
  for (int i = 0; i <= 1000; ++i) {
    car.centre = {-5500.0 + 11.0 * i, 5500.0 - 11.0 * i};
    car.speed_mps = 163.8 * i / 1000.0;
    car.heading_rad = 2 * kPi * i / 1001.0;
    car.width_m = 10.23 * i / 1000.0;
    car.length_m = 40.95 * i / 1000.0;
    const Participant back = decoded(car);
    EXPECT_NEAR(back.centre.x_m, car.centre.x_m, 0.0056);
    EXPECT_NEAR(back.centre.y_m, car.centre.y_m, 0.0056);
    EXPECT_NEAR(back.speed_mps.value(), *car.speed_mps, 0.01 + 1e-9);
    EXPECT_NEAR(back.heading_rad.value(), *car.heading_rad, 0.5 * 0.0125 * kPi / 180 + 1e-9);
    EXPECT_NEAR(back.width_m, car.width_m, 0.005 + 1e-9);
    EXPECT_NEAR(back.length_m, car.length_m, 0.005 + 1e-9);
  }
}

TEST(Rsm, NeverClaimsAPositionThatIsFinerThanItIs) {
  Participant car = some_car(1);
  const auto told = [&](double accuracy_m) {
    car.accuracy_m = accuracy_m;
    return decoded(car).accuracy_m;
  };
  EXPECT_EQ(told(0.0), 0.01);
  EXPECT_EQ(told(0.01), 0.01);
  EXPECT_EQ(told(0.3), 0.5);
  EXPECT_EQ(told(2.0), 2.0);
  EXPECT_EQ(told(2.1), 5.0);
  EXPECT_EQ(told(500.0), 500.0);
  EXPECT_FALSE(told(501.0));
  EXPECT_FALSE(told(kNan));
}

TEST(Rsm, SpeaksTheContract) {
  RoadsideSafety message = seen(2);
  message.participants[1].vehicle = 9;
  const v2x::RoadsideSafetyMessage wire = on_the_wire(message);
  EXPECT_EQ(wire.reference().longitude_e7(), kGeoReference.longitude_e7);
  ASSERT_EQ(wire.participants_size(), 2);
  const v2x::Participant& car = wire.participants(0);
  EXPECT_EQ(car.type(), 1U);
  EXPECT_EQ(car.source(), 3U);
  EXPECT_FALSE(car.has_vehicle_id());
  EXPECT_EQ(car.position_confidence(), 10U);  // 0.5 m
  EXPECT_EQ(car.speed_2cmps(), 669U);         // 13.37 / 0.02 = 668.5
  EXPECT_EQ(car.heading_80th_deg(), 7200U);
  EXPECT_EQ(car.size().length_cm(), 450U);
  EXPECT_EQ(car.vehicle_class(), 10U);
  EXPECT_EQ(wire.participants(1).vehicle_id(), 9U);
  EXPECT_EQ(wire.SerializeAsString(), bytes_of(one_frame(message)));
}

TEST(Rsm, SaysUnavailableByTheStandardsSentinels) {
  RoadsideSafety message = seen(1);
  Participant& car = message.participants[0];
  car.speed_mps = kNan;
  car.heading_rad.reset();
  car.accuracy_m.reset();
  const v2x::RoadsideSafetyMessage wire = on_the_wire(message);
  EXPECT_EQ(wire.participants(0).speed_2cmps(), 8191U);
  EXPECT_EQ(wire.participants(0).heading_80th_deg(), 28'800U);
  EXPECT_EQ(wire.participants(0).position_confidence(), 0U);
  EXPECT_FALSE(decoded(car).speed_mps);
  EXPECT_FALSE(decoded(car).heading_rad);
  EXPECT_FALSE(decoded(car).accuracy_m);
}

TEST(Rsm, HasThePublishedSizesWhenEveryOptionalFieldIsThere) {
  // A participant in bits: presence 7; type 4; number 16; source 4; id 64; second 16; offset 1 + 3 + 2 * 18 (beyond
  // 362 m); confidence 5; gear 3; speed 13; heading 15; steering 8; confidence of the motion 3 + 3 + 3 + 2;
  // accelerations 48; size with height 1 + 10 + 12 + 7; class 10. Together 294. The head has 160.
  const ParticipantFields all = {.vehicle_id = true,
                                 .transmission = true,
                                 .steering_angle = true,
                                 .motion_confidence = true,
                                 .accelerations = true,
                                 .height = true,
                                 .vehicle_class = true};
  const std::uint32_t bits = participant_bits(all, 45'000);
  EXPECT_EQ(bits, 294U);
  EXPECT_EQ(rsm_bytes(bits), 57U);
  EXPECT_EQ(rsm_bytes(4 * bits), 167U);
  EXPECT_EQ(rsm_bytes(8 * bits), 314U);
  EXPECT_EQ(rsm_bytes(16 * bits), 608U);
}

TEST(Rsm, CostsTheBytesOfTheFieldsThatASensorCanFill) {
  // Less id, gear, steering, confidence of the motion, accelerations and height: 294 - 64 - 3 - 8 - 11 - 48 - 7 = 153
  // where the offset needs 2 * 18 bits; 149 where 2 * 16 are enough, up to 362 m. 160 + 149, 160 + 16 * 149 bits.
  EXPECT_EQ(one_frame(seen(1)).wire_bytes[0], 39U);
  EXPECT_EQ(one_frame(seen(16)).wire_bytes[0], 318U);
  RoadsideSafety message = seen(1);
  message.participants[0].centre = {-480.0, -5.25};  // 160 + 153
  EXPECT_EQ(one_frame(message).wire_bytes[0], 40U);
  message.participants[0].vehicle = 1;  // and 64
  EXPECT_EQ(one_frame(message).wire_bytes[0], 48U);
  message.participants[0].centre = {-5.0, -5.0};  // 2 * 12: 160 + 107 + 24 + 64 + 10
  EXPECT_EQ(one_frame(message).wire_bytes[0], 46U);
}

TEST(Rsm, KnowsWhichPointsNoOffsetCanTell) {
  EXPECT_TRUE(fits_offset({5000.0, -5000.0}));
  EXPECT_FALSE(fits_offset({kNan, 0.0}));
  EXPECT_FALSE(fits_offset({100'000.0, 0.0}));  // 1.05 degrees
}

TEST(Rsm, IsMalformedWithoutAnyOneOfItsRequiredFields) {
  for (const int field : {1, 2, 3, 4}) {
    v2x::RoadsideSafetyMessage wire = on_the_wire(seen(1));
    ASSERT_TRUE(decode_rsm(as_payload(wire.SerializeAsString())));
    wire.GetReflection()->ClearField(&wire, wire.GetDescriptor()->FindFieldByNumber(field));
    EXPECT_FALSE(decode_rsm(as_payload(wire.SerializeAsString()))) << "field " << field;
  }
  for (const int field : {1, 2, 3, 5, 6, 7, 8, 9, 10}) {
    v2x::RoadsideSafetyMessage wire = on_the_wire(seen(1));
    v2x::Participant& car = *wire.mutable_participants(0);
    car.GetReflection()->ClearField(&car, car.GetDescriptor()->FindFieldByNumber(field));
    EXPECT_FALSE(decode_rsm(as_payload(wire.SerializeAsString()))) << "field " << field << " of a participant";
  }
}

TEST(Rsm, IsMalformedWithAValueBeyondTheStandardsRange) {
  const auto refused = [](auto change) {
    v2x::RoadsideSafetyMessage wire = on_the_wire(seen(1));
    change(*wire.mutable_participants(0));
    return !decode_rsm(as_payload(wire.SerializeAsString()));
  };
  EXPECT_TRUE(refused([](auto& car) { car.set_type(5); }));
  EXPECT_TRUE(refused([](auto& car) { car.set_id(65'536); }));
  EXPECT_TRUE(refused([](auto& car) { car.set_source(8); }));
  EXPECT_TRUE(refused([](auto& car) { car.set_second_mark_ms(60'000); }));
  EXPECT_TRUE(refused([](auto& car) { car.mutable_position()->set_latitude_e7(8'388'608); }));
  EXPECT_TRUE(refused([](auto& car) { car.set_position_confidence(16); }));
  EXPECT_TRUE(refused([](auto& car) { car.set_speed_2cmps(8192); }));
  EXPECT_TRUE(refused([](auto& car) { car.set_heading_80th_deg(28'801); }));
  EXPECT_TRUE(refused([](auto& car) { car.mutable_size()->set_width_cm(1024); }));
  EXPECT_TRUE(refused([](auto& car) { car.set_vehicle_class(256); }));
  EXPECT_FALSE(refused([](auto& car) { car.clear_vehicle_class(); }));
}

TEST(Rsm, NamesSixteenParticipantsAtMost) {
  v2x::RoadsideSafetyMessage wire = on_the_wire(seen(16));
  *wire.add_participants() = wire.participants(0);
  EXPECT_FALSE(decode_rsm(as_payload(wire.SerializeAsString())));
}

}  // namespace
}  // namespace lukou
