#include <gtest/gtest.h>

#include <limits>

#include "common/messages/rsc.hpp"
#include "tests/unit/common/messages/one_frame.hpp"
#include "v2x.pb.h"

namespace lukou {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

Coordination with(const GuidedPath& path) {
  Coordination message;
  message.rsu = 1;
  message.vehicles = {{.vehicle = 7, .path = path, .binding = Binding::kGuard}};
  return message;
}

GuidedPath profile() {
  return {.centre = {-200.0, -5.25},
          .acceleration_mps2 = -1.37,
          .lifetime_ms = 3000,
          .later = {{.from_ms = 1000, .acceleration_mps2 = 0.0, .centre = {-185.0, -5.25}},
                    {.from_ms = 2500, .acceleration_mps2 = 2.01, .centre = {-170.0, -5.25}}}};
}

GuidedPath speed(double speed_mps) { return {.centre = {-200.0, -5.25}, .lifetime_ms = 500, .speed_mps = speed_mps}; }

Coordination lanes() {
  Coordination message;
  message.rsu = 1;
  message.node = 4;
  for (int lane = 0; lane < 8; ++lane) {
    message.lanes.push_back({.lane = static_cast<Lane>(lane + 4), .speed_mps = lane * 2.5, .lifetime_ms = 1000});
  }
  return message;
}

v2x::RoadsideCoordination on_the_wire(const Coordination& message) {
  v2x::RoadsideCoordination wire;
  EXPECT_TRUE(wire.ParseFromString(bytes_of(one_frame(message))));
  EXPECT_EQ(wire.SerializeAsString(), bytes_of(one_frame(message)));
  return wire;
}

template <class Change>
bool refused(const Coordination& message, Change change) {
  v2x::RoadsideCoordination wire = on_the_wire(message);
  change(wire);
  return !decode_rsc(as_payload(wire.SerializeAsString()));
}

TEST(RscPath, ReturnsEachOfItsPoints) {
  const auto result = decode_rsc(one_frame(with(profile())).payload);
  ASSERT_TRUE(result) << result.error().text();
  const GuidedPath& path = *result.value().vehicles.at(0).path;
  EXPECT_EQ(path.acceleration_mps2, -1.37);
  EXPECT_EQ(path.lifetime_ms, 3000U);
  EXPECT_FALSE(path.speed_mps);
  ASSERT_EQ(path.later.size(), 2U);
  EXPECT_EQ(path.later[0].from_ms, 1000U);
  EXPECT_EQ(path.later[0].acceleration_mps2, 0.0);
  EXPECT_NEAR(path.later[0].centre.x_m, -185.0, 0.0056);
  EXPECT_EQ(path.later[1].from_ms, 2500U);
  EXPECT_EQ(path.later[1].acceleration_mps2, 2.01);
}

TEST(RscPath, DecodesEveryAccelerationOfEveryPointToExactlyItsHundredths) {
  for (int units = -2000; units <= 2000; ++units) {
    GuidedPath path = profile();
    path.later[1].acceleration_mps2 = units / 100.0;
    const auto result = decode_rsc(one_frame(with(path)).payload);
    ASSERT_TRUE(result);
    EXPECT_EQ(result.value().vehicles[0].path->later[1].acceleration_mps2, units / 100.0);
  }
}

TEST(RscPath, SpeaksTheContract) {
  const v2x::RoadsideCoordination wire = on_the_wire(with(profile()));
  const v2x::PathPlanning& path = wire.coordinates(0).path();
  ASSERT_EQ(path.points_size(), 3);
  EXPECT_EQ(wire.coordinates(0).suggestion().lifetime_10ms(), 300U);
  EXPECT_EQ(path.points(0).estimated_time_10ms(), 0U);
  EXPECT_EQ(path.points(1).estimated_time_10ms(), 100U);
  EXPECT_EQ(path.points(2).estimated_time_10ms(), 250U);
  EXPECT_EQ(path.points(2).acceleration().longitudinal_cmps2(), 201);
  EXPECT_FALSE(path.points(2).has_speed_2cmps());
}

TEST(RscPath, CostsTheBytesOfEachPoint) {
  EXPECT_EQ(one_frame(with(profile())).wire_bytes[0], 24U + 14U + 3U * 17U);
  EXPECT_EQ(one_frame(with(speed(10.0))).wire_bytes[0], 24U + 14U + 13U);
  EXPECT_EQ(one_frame(lanes()).wire_bytes[0], 24U + 8U * 14U);
}

TEST(RscPath, FitsIfItsTimesAscendWithinItsLife) {
  const auto fit = [](auto change) {
    GuidedPath path = profile();
    change(path);
    return fits(path);
  };
  EXPECT_TRUE(fit([](GuidedPath&) {}));
  EXPECT_FALSE(fit([](GuidedPath& path) { path.later[0].from_ms = 0; }));
  EXPECT_FALSE(fit([](GuidedPath& path) { path.later[1].from_ms = 1000; }));
  EXPECT_FALSE(fit([](GuidedPath& path) { path.later[1].from_ms = 3000; }));
  EXPECT_FALSE(fit([](GuidedPath& path) { path.later[1].from_ms = 2505; }));
  EXPECT_FALSE(fit([](GuidedPath& path) { path.later[1].acceleration_mps2 = kNaN; }));
  EXPECT_FALSE(fit([](GuidedPath& path) { path.later[0].acceleration_mps2 = -20.01; }));
  EXPECT_FALSE(fit([](GuidedPath& path) { path.speed_mps = 3.0; })) << "a speed or a profile, not both";
  const auto of_points = [](std::uint32_t points) {
    GuidedPath path{.lifetime_ms = 100 * points};
    for (std::uint32_t i = 1; i < points; ++i) path.later.push_back({.from_ms = 100 * i});
    return path;
  };
  EXPECT_TRUE(fits(of_points(32)));
  EXPECT_TRUE(decode_rsc(one_frame(with(of_points(32))).payload));
  EXPECT_FALSE(fits(of_points(33)));
}

TEST(RscPath, IsMalformedIfItsTimesDoNotAscendOrAPointIsNotWhole) {
  const auto with_point = [](int place, auto change) {
    return refused(with(profile()), [&](v2x::RoadsideCoordination& wire) {
      change(*wire.mutable_coordinates(0)->mutable_path()->mutable_points(place));
    });
  };
  EXPECT_FALSE(with_point(1, [](v2x::PathPoint&) {}));
  EXPECT_TRUE(with_point(0, [](v2x::PathPoint& point) { point.set_estimated_time_10ms(1); }));
  EXPECT_TRUE(with_point(1, [](v2x::PathPoint& point) { point.set_estimated_time_10ms(0); }));
  EXPECT_TRUE(with_point(1, [](v2x::PathPoint& point) { point.clear_estimated_time_10ms(); }));
  EXPECT_TRUE(with_point(2, [](v2x::PathPoint& point) { point.set_estimated_time_10ms(100); }));
  EXPECT_TRUE(with_point(2, [](v2x::PathPoint& point) { point.set_estimated_time_10ms(300); })) << "the end of life";
  EXPECT_TRUE(with_point(2, [](v2x::PathPoint& point) { point.clear_acceleration(); }));
  EXPECT_TRUE(with_point(2, [](v2x::PathPoint& point) { point.clear_position(); }));
  EXPECT_TRUE(with_point(1, [](v2x::PathPoint& point) { point.mutable_acceleration()->set_longitudinal_cmps2(2001); }));
  EXPECT_TRUE(refused(with(profile()), [](v2x::RoadsideCoordination& wire) {
    v2x::PathPlanning& path = *wire.mutable_coordinates(0)->mutable_path();
    for (std::uint32_t i = 0; i < 30; ++i) {
      *path.add_points() = path.points(2);
      path.mutable_points(path.points_size() - 1)->set_estimated_time_10ms(251 + i);
    }
  })) << "33 points";
}

TEST(RscSpeed, IsReturnedToExactlyItsUnits) {
  for (int units = 0; units <= 8190; units += 7) {
    const auto result = decode_rsc(one_frame(with(speed(units / 50.0))).payload);
    ASSERT_TRUE(result) << result.error().text();
    const GuidedPath& path = *result.value().vehicles[0].path;
    EXPECT_EQ(path.speed_mps, units / 50.0);
    EXPECT_EQ(path.lifetime_ms, 500U);
    EXPECT_TRUE(path.later.empty());
  }
}

TEST(RscSpeed, StandsInAPointWithoutAcceleration) {
  const v2x::RoadsideCoordination wire = on_the_wire(with(speed(12.5)));
  const v2x::PathPoint& point = wire.coordinates(0).path().points(0);
  EXPECT_EQ(point.speed_2cmps(), 625U);
  EXPECT_FALSE(point.has_acceleration());
  EXPECT_TRUE(refused(with(speed(12.5)), [](v2x::RoadsideCoordination& changed) {
    changed.mutable_coordinates(0)->mutable_path()->mutable_points(0)->set_speed_2cmps(8191);
  })) << "unavailable is no advice";
}

TEST(RscSpeed, FitsOnlyWhatTheFieldCanCarry) {
  EXPECT_TRUE(fits(speed(0.0)));
  EXPECT_TRUE(fits(speed(163.8)));
  EXPECT_FALSE(fits(speed(163.82)));
  EXPECT_FALSE(fits(speed(-0.1)));
  EXPECT_FALSE(fits(speed(kNaN)));
}

TEST(RscLanes, AreReturnedWithTheirSpeeds) {
  const auto result = decode_rsc(one_frame(lanes()).payload);
  ASSERT_TRUE(result) << result.error().text();
  EXPECT_EQ(result.value().node, 4);
  ASSERT_EQ(result.value().lanes.size(), 8U);
  for (std::size_t i = 0; i < 8; ++i) {
    EXPECT_EQ(result.value().lanes[i].lane, static_cast<Lane>(i + 4));
    EXPECT_EQ(result.value().lanes[i].speed_mps, static_cast<double>(i) * 2.5);
    EXPECT_EQ(result.value().lanes[i].lifetime_ms, 1000U);
  }
}

TEST(RscLanes, AreNamedByTheNodesOfTheMap) {
  const v2x::RoadsideCoordination wire = on_the_wire(lanes());
  // SC: cars come from the south, node 12, and the lane is the second from the centre line.
  EXPECT_EQ(wire.lane_coordinates(0).target_lane().upstream_node_id(), 12U);
  EXPECT_EQ(wire.lane_coordinates(0).target_lane().downstream_node_id(), 4U);
  EXPECT_EQ(wire.lane_coordinates(0).target_lane().lane_bits(), 1U << 2U);
  EXPECT_EQ(wire.lane_coordinates(7).target_lane().upstream_node_id(), 14U);
  EXPECT_EQ(wire.lane_coordinates(7).target_lane().lane_bits(), 1U << 3U);
  EXPECT_EQ(wire.lane_coordinates(7).speed_2cmps(), 875U);
}

TEST(RscLanes, AreMalformedIfTheyAreNoneOfOurs) {
  const auto with_lane = [](auto change) {
    return refused(lanes(), [&](v2x::RoadsideCoordination& wire) { change(*wire.mutable_lane_coordinates(3)); });
  };
  EXPECT_FALSE(with_lane([](v2x::LaneCoordination&) {}));
  EXPECT_TRUE(with_lane([](v2x::LaneCoordination& lane) { lane.clear_target_lane(); }));
  EXPECT_TRUE(with_lane([](v2x::LaneCoordination& lane) { lane.clear_speed_2cmps(); }));
  EXPECT_TRUE(with_lane([](v2x::LaneCoordination& lane) { lane.set_speed_2cmps(8191); }));
  EXPECT_TRUE(with_lane([](v2x::LaneCoordination& lane) { lane.clear_lifetime_10ms(); }));
  EXPECT_TRUE(with_lane([](v2x::LaneCoordination& lane) { lane.set_lifetime_10ms(65'535); }));
  EXPECT_TRUE(with_lane([](auto& lane) { lane.mutable_target_lane()->set_upstream_node_id(15); }));
  EXPECT_TRUE(with_lane([](auto& lane) { lane.mutable_target_lane()->set_lane_bits(1); }));
  EXPECT_TRUE(with_lane([](auto& lane) { lane.mutable_target_lane()->set_lane_bits(16); }));
  EXPECT_TRUE(with_lane([](auto& lane) { lane.mutable_target_lane()->set_lane_bits(6); }));
  EXPECT_TRUE(refused(lanes(), [](v2x::RoadsideCoordination& wire) {
    *wire.add_lane_coordinates() = wire.lane_coordinates(0);
  })) << "nine lanes";
  EXPECT_FALSE(fits(LaneSpeed{.lane = {}, .speed_mps = kNaN, .lifetime_ms = 100}));
  EXPECT_FALSE(fits(LaneSpeed{.lane = {}, .speed_mps = 10.0, .lifetime_ms = 0}));
}

}  // namespace
}  // namespace lukou
