#include "common/messages/rsc.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "tests/unit/common/messages/one_frame.hpp"
#include "v2x.pb.h"

namespace lukou {
namespace {

VehicleCoordination advised(std::uint64_t car, double acceleration_mps2) {
  return {.vehicle = car,
          .path = GuidedPath{.centre = {-200.0, -5.25}, .acceleration_mps2 = acceleration_mps2, .lifetime_ms = 500},
          .binding = Binding::kFollowing};
}

Coordination two_cars() {
  Coordination message;
  message.rsu = 0x5253550000000000;
  message.count = 1;
  message.second_mark_ms = 100;
  message.vehicles = {advised(0xffffffffffffffff, -0.5), {.vehicle = 2, .path = {}, .binding = Binding::kGuard}};
  return message;
}

v2x::RoadsideCoordination on_the_wire(const Coordination& message) {
  v2x::RoadsideCoordination wire;
  EXPECT_TRUE(wire.ParseFromString(bytes_of(one_frame(message))));
  return wire;
}

TEST(Rsc, ReturnsAdviceAndRelease) {
  const auto result = decode_rsc(one_frame(two_cars()).payload);
  ASSERT_TRUE(result) << result.error().text();
  const Coordination& message = result.value();
  EXPECT_EQ(message.rsu, 0x5253550000000000U);
  EXPECT_EQ(message.count, 1);
  EXPECT_EQ(message.second_mark_ms, 100);
  ASSERT_EQ(message.vehicles.size(), 2U);
  EXPECT_EQ(message.vehicles[0].vehicle, 0xffffffffffffffffU);
  ASSERT_TRUE(message.vehicles[0].path);
  EXPECT_EQ(message.vehicles[0].path->acceleration_mps2, -0.5);
  EXPECT_EQ(message.vehicles[0].path->lifetime_ms, 500U);
  EXPECT_NEAR(message.vehicles[0].path->centre.x_m, -200.0, 0.0056);
  EXPECT_EQ(message.vehicles[0].binding, Binding::kFollowing);
  EXPECT_FALSE(message.vehicles[1].path);
  EXPECT_EQ(message.vehicles[1].binding, Binding::kGuard);
}

TEST(Rsc, DecodesAnAccelerationToExactlyItsHundredths) {
  for (int units = -2000; units <= 2000; ++units) {
    Coordination message = two_cars();
    message.vehicles = {advised(1, units / 100.0)};
    const auto result = decode_rsc(one_frame(message).payload);
    ASSERT_TRUE(result);
    EXPECT_EQ(result.value().vehicles[0].path->acceleration_mps2, units / 100.0);
  }
}

TEST(Rsc, ReturnsEveryLifetimeAndEachPointWithinHalfAUnit) {
  for (std::uint32_t units = 1; units <= 65'534; units += 61) {
    Coordination message = two_cars();
    const double along_m = 0.1 * units - 3000.0;
    message.vehicles[0].path->lifetime_ms = 10 * units;
    message.vehicles[0].path->centre = {along_m, -along_m};
    const auto result = decode_rsc(one_frame(message).payload);
    ASSERT_TRUE(result);
    EXPECT_EQ(result.value().vehicles[0].path->lifetime_ms, 10 * units);
    EXPECT_NEAR(result.value().vehicles[0].path->centre.x_m, along_m, 0.0056);
    EXPECT_NEAR(result.value().vehicles[0].path->centre.y_m, -along_m, 0.0056);
  }
}

TEST(Rsc, SpeaksTheContract) {
  const v2x::RoadsideCoordination wire = on_the_wire(two_cars());
  EXPECT_EQ(wire.reference().longitude_e7(), kGeoReference.longitude_e7);
  ASSERT_EQ(wire.coordinates_size(), 2);
  const v2x::VehicleCoordination& car = wire.coordinates(0);
  EXPECT_EQ(car.suggestion().lifetime_10ms(), 50U);
  EXPECT_EQ(car.suggestion().behavior_bits(), 1U << 11U);  // slow down
  ASSERT_EQ(car.path().points_size(), 1);
  EXPECT_EQ(car.path().points(0).acceleration().longitudinal_cmps2(), -50);
  EXPECT_EQ(car.binding(), v2x::FOLLOWING);
  EXPECT_FALSE(wire.coordinates(1).has_path());
  EXPECT_FALSE(wire.coordinates(1).has_binding());
  EXPECT_EQ(wire.SerializeAsString(), bytes_of(one_frame(two_cars())));
}

TEST(Rsc, CostsTheBytesOfThePublishedCount) {
  // 24 + 2 * 14 + 1 * 17; with sixteen cars 24 + 16 * (14 + 17).
  EXPECT_EQ(one_frame(two_cars()).wire_bytes[0], 69U);
  Coordination full = two_cars();
  full.vehicles.assign(16, advised(1, 1.0));
  EXPECT_EQ(one_frame(full).wire_bytes[0], 520U);
  EXPECT_TRUE(decode_rsc(one_frame(full).payload));
}

TEST(Rsc, FitsOnlyWhatTheFieldsCanCarry) {
  const GuidedPath good = {.centre = {}, .acceleration_mps2 = -20.0, .lifetime_ms = 655'340};
  EXPECT_TRUE(fits(good));
  const auto with = [&](double acceleration_mps2, std::uint32_t lifetime_ms) {
    return fits({.centre = {}, .acceleration_mps2 = acceleration_mps2, .lifetime_ms = lifetime_ms});
  };
  EXPECT_FALSE(with(20.01, 500));
  EXPECT_FALSE(with(std::numeric_limits<double>::quiet_NaN(), 500));
  EXPECT_FALSE(with(std::numeric_limits<double>::infinity(), 500));
  EXPECT_FALSE(with(1.0, 0));
  EXPECT_FALSE(with(1.0, 655'350));
  EXPECT_FALSE(with(1.0, 505));
}

TEST(Rsc, IsMalformedIfAnAdviceIsNotWhole) {
  const auto refused = [](auto change) {
    v2x::RoadsideCoordination wire = on_the_wire(two_cars());
    change(wire, *wire.mutable_coordinates(0));
    return !decode_rsc(as_payload(wire.SerializeAsString()));
  };
  EXPECT_FALSE(refused([](auto&, auto&) {}));
  EXPECT_TRUE(refused([](auto& wire, auto&) { wire.clear_id(); }));
  EXPECT_TRUE(refused([](auto& wire, auto&) { wire.clear_second_mark_ms(); }));
  EXPECT_TRUE(refused([](auto& wire, auto&) { wire.set_second_mark_ms(65'535); }));
  EXPECT_TRUE(refused([](auto& wire, auto&) { wire.clear_reference(); }));
  EXPECT_TRUE(refused([](auto&, auto& car) { car.clear_vehicle_id(); }));
  EXPECT_TRUE(refused([](auto&, auto& car) { car.clear_suggestion(); }));
  EXPECT_TRUE(refused([](auto&, auto& car) { car.mutable_suggestion()->set_lifetime_10ms(0); }));
  EXPECT_TRUE(refused([](auto&, auto& car) { car.mutable_suggestion()->set_lifetime_10ms(65'535); }));
  EXPECT_TRUE(refused([](auto&, auto& car) { car.mutable_path()->mutable_points(0)->clear_acceleration(); }));
  EXPECT_TRUE(refused([](auto&, auto& car) {
    car.mutable_path()->mutable_points(0)->mutable_acceleration()->set_longitudinal_cmps2(2001);
  }));
  EXPECT_TRUE(refused([](auto&, auto& car) { car.mutable_path()->mutable_points(0)->clear_position(); }));
  EXPECT_TRUE(refused([](auto&, auto& car) { *car.mutable_path()->add_points() = car.path().points(0); }));
  EXPECT_TRUE(refused([](auto&, auto& car) { car.set_binding(static_cast<v2x::Binding>(2)); }));
}

TEST(Rsc, NamesSixteenCarsAtMost) {
  Coordination full = two_cars();
  full.vehicles.assign(16, advised(1, 1.0));
  v2x::RoadsideCoordination wire = on_the_wire(full);
  wire.add_coordinates()->set_vehicle_id(17);
  EXPECT_FALSE(decode_rsc(as_payload(wire.SerializeAsString())));
}

TEST(Rsc, TakesAnEmptyPathForARelease) {
  v2x::RoadsideCoordination wire = on_the_wire(two_cars());
  wire.mutable_coordinates(0)->mutable_path()->clear_points();
  const auto result = decode_rsc(as_payload(wire.SerializeAsString()));
  ASSERT_TRUE(result);
  EXPECT_FALSE(result.value().vehicles[0].path);
}

}  // namespace
}  // namespace lukou
