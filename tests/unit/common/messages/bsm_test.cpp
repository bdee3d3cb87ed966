#include "common/messages/bsm.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/unit/common/messages/one_frame.hpp"
#include "v2x.pb.h"

namespace lukou {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kPi = 3.14159265358979323846;

BasicSafety typical() {
  BasicSafety message;
  message.temporary_id = 0xfedcba9876543210;
  message.count = 127;
  message.second_mark_ms = 59'900;
  message.centre = {-123.456, -5.25};
  message.speed_mps = 13.37;
  message.heading_rad = kPi / 2;
  message.acceleration_mps2 = -1.234;
  message.braking = true;
  message.width_m = 1.8;
  message.length_m = 4.5;
  return message;
}

BasicSafety decoded(const BasicSafety& message) {
  const auto result = decode_bsm(one_frame(message).payload);
  EXPECT_TRUE(result) << result.error().text();
  return result.value();
}

v2x::BasicSafetyMessage on_the_wire(const BasicSafety& message) {
  v2x::BasicSafetyMessage wire;
  EXPECT_TRUE(wire.ParseFromString(bytes_of(one_frame(message))));
  return wire;
}

TEST(Bsm, ReturnsEachFieldWithinHalfAUnit) {
  const BasicSafety message = decoded(typical());
  EXPECT_EQ(message.temporary_id, 0xfedcba9876543210U);
  EXPECT_EQ(message.count, 127);
  EXPECT_EQ(message.second_mark_ms, 59'900);
  EXPECT_NEAR(message.centre.x_m, -123.456, 0.0056);
  EXPECT_NEAR(message.centre.y_m, -5.25, 0.0056);
  EXPECT_NEAR(message.speed_mps.value(), 13.37, 0.01 + 1e-12);
  EXPECT_NEAR(message.heading_rad.value(), kPi / 2, 1e-12);  // 90 degrees are 7200 units
  EXPECT_NEAR(message.acceleration_mps2.value(), -1.234, 0.005 + 1e-12);
  EXPECT_TRUE(message.braking);
  EXPECT_NEAR(message.width_m, 1.8, 1e-12);
  EXPECT_NEAR(message.length_m, 4.5, 1e-12);
}

TEST(Bsm, ErrsByHalfAUnitAtMostOverTheWholeRange) {
  BasicSafety message = typical();
  for (int i = 0; i <= 1000; ++i) {
    message.speed_mps = 163.8 * i / 1000.0;
    message.acceleration_mps2 = -20.0 + 40.0 * i / 1000.0;
    message.heading_rad = 2 * kPi * i / 1001.0;
    const BasicSafety back = decoded(message);
    EXPECT_NEAR(back.speed_mps.value(), *message.speed_mps, 0.01 + 1e-9);
    EXPECT_NEAR(back.acceleration_mps2.value(), *message.acceleration_mps2, 0.005 + 1e-9);
    EXPECT_NEAR(back.heading_rad.value(), *message.heading_rad, 0.5 * 0.0125 * kPi / 180 + 1e-9);
  }
}

TEST(Bsm, ErrsByHalfAUnitInSizesAndAccuracyToo) {
  BasicSafety message = typical();
  for (int i = 0; i <= 1000; ++i) {
    message.width_m = 10.23 * i / 1000.0;
    message.length_m = 40.95 * i / 1000.0;
    message.accuracy_m = 12.7 * i / 1000.0;
    const BasicSafety back = decoded(message);
    EXPECT_NEAR(back.width_m, message.width_m, 0.005 + 1e-9);
    EXPECT_NEAR(back.length_m, message.length_m, 0.005 + 1e-9);
    EXPECT_NEAR(back.accuracy_m.value(), *message.accuracy_m, 0.025 + 1e-9);
  }
}

TEST(Bsm, SaysHowAccurateItsPositionIsOnlyIfItKnows) {
  BasicSafety message = typical();
  EXPECT_FALSE(on_the_wire(message).has_accuracy());
  EXPECT_FALSE(decoded(message).accuracy_m);
  message.accuracy_m = 1.52;
  const v2x::BasicSafetyMessage wire = on_the_wire(message);
  EXPECT_EQ(wire.accuracy().semi_major_5cm(), 30U);  // 1.52 / 0.05 = 30.4
  EXPECT_EQ(wire.accuracy().semi_minor_5cm(), 30U);
  EXPECT_EQ(wire.accuracy().orientation(), 65'535U);
  EXPECT_EQ(wire.SerializeAsString(), bytes_of(one_frame(message)));
  // 326 bits and twice 8 for the axes, 16 for the orientation: 358.
  EXPECT_EQ(one_frame(message).wire_bytes[0], 45U);
  message.accuracy_m = 300.0;
  EXPECT_DOUBLE_EQ(decoded(message).accuracy_m.value(), 12.7);
  message.accuracy_m = kNan;
  EXPECT_FALSE(decoded(message).accuracy_m);
}

TEST(Bsm, SpeaksTheContract) {
  const v2x::BasicSafetyMessage wire = on_the_wire(typical());
  EXPECT_EQ(wire.msg_count(), 127U);
  EXPECT_EQ(wire.id(), 0xfedcba9876543210U);
  EXPECT_EQ(wire.second_mark_ms(), 59'900U);
  EXPECT_EQ(wire.transmission(), 2U);
  EXPECT_EQ(wire.speed_2cmps(), 669U);  // 13.37 / 0.02 = 668.5
  EXPECT_EQ(wire.heading_80th_deg(), 7200U);
  EXPECT_EQ(wire.acceleration().longitudinal_cmps2(), -123);
  EXPECT_FALSE(wire.acceleration().has_lateral_cmps2());
  EXPECT_EQ(wire.brakes().pedal(), 2U);
  EXPECT_EQ(wire.size().width_cm(), 180U);
  EXPECT_EQ(wire.size().length_cm(), 450U);
  EXPECT_EQ(wire.vehicle_class(), 10U);
  EXPECT_EQ(wire.position().latitude_e7(), to_geo(typical().centre).latitude_e7);
  EXPECT_EQ(wire.position().longitude_e7(), to_geo(typical().centre).longitude_e7);
  // What Protobuf writes is what we write.
  EXPECT_EQ(wire.SerializeAsString(), bytes_of(one_frame(typical())));
}

TEST(Bsm, SaturatesWhatLeavesItsRange) {
  BasicSafety message = typical();
  message.speed_mps = 500.0;
  message.acceleration_mps2 = -99.0;
  message.width_m = 30.0;
  message.length_m = 99.0;
  const BasicSafety back = decoded(message);
  EXPECT_DOUBLE_EQ(back.speed_mps.value(), 163.8);
  EXPECT_DOUBLE_EQ(back.acceleration_mps2.value(), -20.0);
  EXPECT_DOUBLE_EQ(back.width_m, 10.23);
  EXPECT_DOUBLE_EQ(back.length_m, 40.95);
  message.speed_mps = -0.3;
  EXPECT_EQ(decoded(message).speed_mps, 0.0);
}

TEST(Bsm, SaysUnavailableByTheStandardsSentinels) {
  BasicSafety message = typical();
  message.speed_mps.reset();
  message.heading_rad.reset();
  message.acceleration_mps2.reset();
  const v2x::BasicSafetyMessage wire = on_the_wire(message);
  EXPECT_EQ(wire.speed_2cmps(), 8191U);
  EXPECT_EQ(wire.heading_80th_deg(), 28'800U);
  EXPECT_EQ(wire.acceleration().longitudinal_cmps2(), 2001);
  const BasicSafety back = decoded(message);
  EXPECT_FALSE(back.speed_mps);
  EXPECT_FALSE(back.heading_rad);
  EXPECT_FALSE(back.acceleration_mps2);
}

TEST(Bsm, TakesWhatIsNotANumberForUnavailable) {
  BasicSafety message = typical();
  message.speed_mps = kNan;
  message.heading_rad = kNan;
  message.acceleration_mps2 = kNan;
  message.length_m = kNan;
  const BasicSafety back = decoded(message);
  EXPECT_FALSE(back.speed_mps);
  EXPECT_FALSE(back.heading_rad);
  EXPECT_FALSE(back.acceleration_mps2);
  EXPECT_EQ(back.length_m, 0.0);
  message.heading_rad = 7.0;  // beyond a turn
  EXPECT_FALSE(decoded(message).heading_rad);
}

TEST(Bsm, CallsWhatRoundsToAFullTurnNorth) {
  BasicSafety message = typical();
  message.heading_rad = 2 * kPi - 1e-6;
  EXPECT_EQ(decoded(message).heading_rad, 0.0);
}

TEST(Bsm, RefusesAPositionThatIsUnavailable) {
  BasicSafety message = typical();
  message.centre.x_m = kNan;
  EXPECT_FALSE(decode_bsm(one_frame(message).payload));
}

TEST(Bsm, PutsTheEnvelopeOnTheFrame) {
  Frames frames = one_frame(typical());
  append(frames, {.sender = 8, .sequence = 4, .antenna_x_m = 9.0, .antenna_y_m = 10.0}, typical());
  ASSERT_EQ(frames.size(), 2U);
  EXPECT_EQ(frames.sender[0], 7U);
  EXPECT_EQ(frames.sequence[1], 4U);
  EXPECT_EQ(frames.kind[0], static_cast<std::uint8_t>(FrameKind::kBsm));
  EXPECT_EQ(frames.antenna_x_m[1], 9.0);
  EXPECT_EQ(frames.antenna_y_m[0], -2.5);
  EXPECT_EQ(frames.payload_end[1], frames.payload.size());
  EXPECT_TRUE(decode_bsm(frames.payload_of(1)));
  // 326 bits: see the count in bsm.cpp.
  EXPECT_EQ(frames.wire_bytes[0], 41U);
}

TEST(Bsm, FindsTheCentreHalfALengthBehindTheFront) {
  // Heading east: 2.25 m to the west; heading south: 2.25 m to the north.
  const PlanePoint east = centre_of_car({10.0, 20.0}, kPi / 2, 4.5);
  EXPECT_NEAR(east.x_m, 7.75, 1e-12);
  EXPECT_NEAR(east.y_m, 20.0, 1e-12);
  const PlanePoint south = centre_of_car({10.0, 20.0}, kPi, 4.5);
  EXPECT_NEAR(south.x_m, 10.0, 1e-12);
  EXPECT_NEAR(south.y_m, 22.25, 1e-12);
}

TEST(Bsm, IsMalformedWithoutAnyOneOfItsRequiredFields) {
  for (const int field : {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11}) {
    v2x::BasicSafetyMessage wire = on_the_wire(typical());
    ASSERT_TRUE(decode_bsm(as_payload(wire.SerializeAsString())));
    wire.GetReflection()->ClearField(&wire, wire.GetDescriptor()->FindFieldByNumber(field));
    EXPECT_FALSE(decode_bsm(as_payload(wire.SerializeAsString()))) << "field " << field;
  }
}

TEST(Bsm, IsMalformedWithAValueBeyondTheStandardsRange) {
  const auto refused = [](auto change) {
    v2x::BasicSafetyMessage wire = on_the_wire(typical());
    change(wire);
    return !decode_bsm(as_payload(wire.SerializeAsString()));
  };
  EXPECT_TRUE(refused([](auto& wire) { wire.set_msg_count(128); }));
  EXPECT_TRUE(refused([](auto& wire) { wire.set_second_mark_ms(60'000); }));
  EXPECT_TRUE(refused([](auto& wire) { wire.set_speed_2cmps(8192); }));
  EXPECT_TRUE(refused([](auto& wire) { wire.set_heading_80th_deg(28'801); }));
  EXPECT_TRUE(refused([](auto& wire) { wire.mutable_acceleration()->set_longitudinal_cmps2(2002); }));
  EXPECT_TRUE(refused([](auto& wire) { wire.mutable_acceleration()->set_longitudinal_cmps2(-2001); }));
  EXPECT_TRUE(refused([](auto& wire) { wire.mutable_position()->set_latitude_e7(900'000'002); }));
  EXPECT_TRUE(refused([](auto& wire) { wire.mutable_position()->set_longitude_e7(-1'800'000'000); }));
  EXPECT_TRUE(refused([](auto& wire) { wire.mutable_size()->set_length_cm(4096); }));
  EXPECT_TRUE(refused([](auto& wire) { wire.mutable_brakes()->set_pedal(3); }));
  EXPECT_TRUE(refused([](auto& wire) { wire.set_transmission(8); }));
  EXPECT_TRUE(refused([](auto& wire) { wire.mutable_accuracy()->set_semi_major_5cm(3); }));  // not whole
  EXPECT_FALSE(refused([](auto& wire) { wire.set_vehicle_class(255); }));
}

TEST(Bsm, ReadsTheFieldsInAnyOrder) {
  const v2x::BasicSafetyMessage wire = on_the_wire(typical());
  v2x::BasicSafetyMessage first;  // its fields come before those that are lower
  first.set_speed_2cmps(wire.speed_2cmps());
  first.set_vehicle_class(wire.vehicle_class());
  v2x::BasicSafetyMessage rest = wire;
  rest.clear_speed_2cmps();
  rest.clear_vehicle_class();
  const auto shuffled = decode_bsm(as_payload(first.SerializeAsString() + rest.SerializeAsString()));
  ASSERT_TRUE(shuffled) << shuffled.error().text();
  const BasicSafety in_order = decoded(typical());
  EXPECT_EQ(shuffled.value().speed_mps, in_order.speed_mps);
  EXPECT_EQ(shuffled.value().centre.x_m, in_order.centre.x_m);
  EXPECT_EQ(shuffled.value().temporary_id, in_order.temporary_id);
  EXPECT_EQ(shuffled.value().length_m, in_order.length_m);
}

TEST(Bsm, StepsOverFieldsOfALaterEdition) {
  std::string bytes = bytes_of(one_frame(typical()));
  bytes += std::string("\x92\x03\x02hi", 5);  // field 50, two bytes
  bytes += std::string("\x9d\x03zzzz", 6);    // field 51, fixed32
  EXPECT_TRUE(decode_bsm(as_payload(bytes)));
}

}  // namespace
}  // namespace lukou
