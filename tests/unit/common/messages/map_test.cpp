#include "common/messages/map.hpp"

#include <gtest/gtest.h>

#include "tests/unit/common/messages/one_frame.hpp"
#include "v2x.pb.h"

namespace lukou {
namespace {

MapData some_map() {
  MapData message;
  message.count = 9;
  message.minute_of_year = 527'039;
  message.node = 1;
  message.lane_width_m = 3.5;
  message.speed_limit_mps = 60.0 / 3.6;
  for (std::size_t lane = 0; lane < message.lanes.size(); ++lane) {
    const double shift_m = 3.5 * static_cast<double>(lane);
    message.lanes[lane] = {{-515.5, -shift_m}, {-15.5, -shift_m}};
  }
  return message;
}

TEST(Map, ReturnsEachFieldWithinHalfAUnit) {
  const auto result = decode_map(one_frame(some_map()).payload);
  ASSERT_TRUE(result) << result.error().text();
  const MapData& message = result.value();
  EXPECT_EQ(message.count, 9);
  EXPECT_EQ(message.minute_of_year, 527'039U);
  EXPECT_EQ(message.node, 1);
  EXPECT_NEAR(message.lane_width_m, 3.5, 1e-12);
  EXPECT_NEAR(message.speed_limit_mps, 60.0 / 3.6, 0.01);
  for (std::size_t lane = 0; lane < message.lanes.size(); ++lane) {
    EXPECT_NEAR(message.lanes[lane].entrance.x_m, -515.5, 0.0056);
    EXPECT_NEAR(message.lanes[lane].stop_line.x_m, -15.5, 0.0056);
    EXPECT_NEAR(message.lanes[lane].stop_line.y_m, -3.5 * static_cast<double>(lane), 0.0056);
  }
}

TEST(Map, ErrsByHalfAUnitAtMostOverTheWholeRange) {
  MapData message = some_map();
  for (int i = 0; i <= 1000; ++i) {
    message.lane_width_m = 109.22 * i / 1000.0;
    message.speed_limit_mps = 163.8 * i / 1000.0;
    message.lanes[7].entrance = {-5500.0 + 11.0 * i, 5500.0 - 11.0 * i};
    const auto back = decode_map(one_frame(message).payload);
    ASSERT_TRUE(back);
    EXPECT_NEAR(back.value().lane_width_m, message.lane_width_m, 0.005 + 1e-9);
    EXPECT_NEAR(back.value().speed_limit_mps, message.speed_limit_mps, 0.01 + 1e-9);
    EXPECT_NEAR(back.value().lanes[7].entrance.x_m, message.lanes[7].entrance.x_m, 0.0056);
    EXPECT_NEAR(back.value().lanes[7].entrance.y_m, message.lanes[7].entrance.y_m, 0.0056);
  }
}

TEST(Map, SpeaksTheContract) {
  const std::string bytes = bytes_of(one_frame(some_map()));
  v2x::MapMessage wire;
  ASSERT_TRUE(wire.ParseFromString(bytes));
  ASSERT_EQ(wire.nodes_size(), 1);
  ASSERT_EQ(wire.nodes(0).in_links_size(), 4);
  EXPECT_EQ(wire.nodes(0).reference().latitude_e7(), kGeoReference.latitude_e7);
  const v2x::Link& west = wire.nodes(0).in_links(0);
  EXPECT_EQ(west.upstream_node_id(), 11U);
  EXPECT_EQ(west.width_cm(), 1050U);
  EXPECT_EQ(west.speed_limits(0).speed_2cmps(), 833U);  // 16.667 / 0.02 = 833.3
  ASSERT_EQ(west.lanes_size(), 3);
  // From the west a left turn leads north (14), straight on east (13), a right turn south (12).
  EXPECT_EQ(west.lanes(0).connections(0).remote_node_id(), 14U);
  EXPECT_EQ(west.lanes(1).connections(0).remote_node_id(), 13U);
  EXPECT_EQ(west.lanes(2).connections(0).remote_node_id(), 12U);
  EXPECT_EQ(west.lanes(2).connections(0).phase_id(), 3U);
  EXPECT_EQ(west.lanes(0).maneuver_bits(), 2U);
  EXPECT_EQ(wire.SerializeAsString(), bytes);
}

TEST(Map, CostsTheBytesOfThePublishedCount) {
  // Four links of three lanes with two points each, as published: 354 and 74 bytes a point. The 74 are 37 bits in each
  // of sixteen lists (presence 2, kind of the offset 3, offset 2 * 16): a centre line of each link is among them.
  // What this message holds is less. Bits: head 160 (frame 4, presence 2, count 7, minute 20, nodes 6, presence 3, node
  // with region 33, position 80, links 5); link 81 (presence 6, node 33, limits 4 + 18, width 15, lanes 5); lane 115
  // (presence 7, id 8, width 15, manoeuvres 12, connection 4 + 64, points 5) and two points of 41 at most (offset
  // 2 * 18 beyond 362 m). 160 + 4 * 81 + 12 * (115 + 82) = 2848: 356 bytes. A real one has the optional lists too.
  EXPECT_EQ(one_frame(some_map()).wire_bytes[0], 502U);
}

TEST(Map, IsMalformedWithoutALaneOrWithOneTwice) {
  v2x::MapMessage wire;
  ASSERT_TRUE(wire.ParseFromString(bytes_of(one_frame(some_map()))));
  v2x::MapMessage fewer = wire;
  fewer.mutable_nodes(0)->mutable_in_links(2)->mutable_lanes()->RemoveLast();
  EXPECT_FALSE(decode_map(as_payload(fewer.SerializeAsString())));
  v2x::MapMessage twice = wire;
  twice.mutable_nodes(0)->mutable_in_links(2)->mutable_lanes(0)->mutable_connections(0)->set_phase_id(1);
  EXPECT_FALSE(decode_map(as_payload(twice.SerializeAsString())));
  v2x::MapMessage short_lane = wire;
  short_lane.mutable_nodes(0)->mutable_in_links(2)->mutable_lanes(0)->mutable_points()->RemoveLast();
  EXPECT_FALSE(decode_map(as_payload(short_lane.SerializeAsString())));
  v2x::MapMessage nowhere = wire;
  nowhere.mutable_nodes(0)->mutable_reference()->set_latitude_e7(900'000'001);
  EXPECT_FALSE(decode_map(as_payload(nowhere.SerializeAsString())));
}

}  // namespace
}  // namespace lukou
