#include "common/messages/spat.hpp"

#include <gtest/gtest.h>

#include "tests/unit/common/messages/one_frame.hpp"
#include "v2x.pb.h"

namespace lukou {
namespace {

/// Green for 20 s, red for 45 s, green from then on; the lane's index is added to the first end.
Spat three_states() {
  Spat message;
  message.count = 5;
  message.minute_of_year = 179;
  message.second_mark_ms = 12'300;
  message.node = 1;
  for (std::size_t lane = 0; lane < message.lanes.size(); ++lane) {
    const Step end = 200 + static_cast<Step>(lane);
    message.lanes[lane] = {{Aspect::kGreen, 0, end}, {Aspect::kRed, end, end + 450}, {Aspect::kYellow, end + 450, {}}};
  }
  return message;
}

TEST(Spat, ReturnsWhatTheHeadsShow) {
  const auto result = decode_spat(one_frame(three_states()).payload);
  ASSERT_TRUE(result) << result.error().text();
  const Spat& message = result.value();
  EXPECT_EQ(message.count, 5);
  EXPECT_EQ(message.minute_of_year, 179U);
  EXPECT_EQ(message.second_mark_ms, 12'300);
  EXPECT_EQ(message.node, 1);
  for (std::size_t lane = 0; lane < message.lanes.size(); ++lane) {
    const auto& states = message.lanes[lane];
    ASSERT_EQ(states.size(), 3U);
    const Step end = 200 + static_cast<Step>(lane);
    EXPECT_EQ(states[0].aspect, Aspect::kGreen);
    EXPECT_EQ(states[0].ends_in, end);
    EXPECT_EQ(states[1].aspect, Aspect::kRed);
    EXPECT_EQ(states[1].starts_in, end);
    EXPECT_EQ(states[2].aspect, Aspect::kYellow);
    EXPECT_FALSE(states[2].ends_in);
  }
}

TEST(Spat, SpeaksTheContract) {
  const std::string bytes = bytes_of(one_frame(three_states()));
  v2x::Spat wire;
  ASSERT_TRUE(wire.ParseFromString(bytes));
  ASSERT_EQ(wire.intersections_size(), 1);
  ASSERT_EQ(wire.intersections(0).phases_size(), 12);
  const v2x::Phase& phase = wire.intersections(0).phases(11);
  EXPECT_EQ(phase.id(), 12U);
  EXPECT_EQ(phase.states(0).light(), 5U);
  EXPECT_EQ(phase.states(1).light(), 3U);
  EXPECT_EQ(phase.states(2).light(), 7U);
  EXPECT_EQ(phase.states(1).counting().start_ds(), 211U);
  EXPECT_EQ(phase.states(1).counting().likely_end_ds(), 661U);
  EXPECT_EQ(phase.states(2).counting().likely_end_ds(), 36'001U);
  EXPECT_EQ(wire.SerializeAsString(), bytes);
}

TEST(Spat, SaysAnHourForWhatIsLaterThanAnHour) {
  Spat message = three_states();
  message.lanes[0] = {{Aspect::kRed, 0, 50'000}};
  const auto result = decode_spat(one_frame(message).payload);
  ASSERT_TRUE(result);
  EXPECT_EQ(result.value().lanes[0][0].ends_in, 36'000);
}

TEST(Spat, CostsTheBytesOfThePublishedCount) {
  // Bits: head 113, twelve phases of 12, states of 46 with two times each. 113 + 144 + 36 * 46 = 1913: 240 bytes;
  // with one state a phase 113 + 144 + 12 * 46 = 809: 102 bytes. The head counts a region of 16 bits in the node's id.
  EXPECT_EQ(one_frame(three_states()).wire_bytes[0], 240U);
  Spat message = three_states();
  for (auto& lane : message.lanes) lane.resize(1);
  EXPECT_EQ(one_frame(message).wire_bytes[0], 102U);
  message.lanes[3].push_back({Aspect::kRed, 10, 20});  // 855 bits
  EXPECT_EQ(one_frame(message).wire_bytes[0], 107U);
}

TEST(Spat, ReturnsEveryTimeOfTheHour) {
  for (Step from_now = 0; from_now < 36'000; from_now += 17) {
    Spat message = three_states();
    message.lanes[0] = {{Aspect::kRed, 0, from_now}, {Aspect::kGreen, from_now, {}}};
    const auto result = decode_spat(one_frame(message).payload);
    ASSERT_TRUE(result);
    EXPECT_EQ(result.value().lanes[0][0].ends_in, from_now);
    EXPECT_EQ(result.value().lanes[0][1].starts_in, from_now);
  }
}

TEST(Spat, IsMalformedWithoutAPhaseOrWithOneTwice) {
  v2x::Spat wire;
  ASSERT_TRUE(wire.ParseFromString(bytes_of(one_frame(three_states()))));
  v2x::Spat fewer = wire;
  fewer.mutable_intersections(0)->mutable_phases()->RemoveLast();
  EXPECT_FALSE(decode_spat(as_payload(fewer.SerializeAsString())));
  v2x::Spat twice = wire;
  twice.mutable_intersections(0)->mutable_phases(3)->set_id(1);
  EXPECT_FALSE(decode_spat(as_payload(twice.SerializeAsString())));
  v2x::Spat dark = wire;
  dark.mutable_intersections(0)->mutable_phases(3)->mutable_states(0)->set_light(1);
  EXPECT_FALSE(decode_spat(as_payload(dark.SerializeAsString())));
  v2x::Spat late = wire;
  late.mutable_intersections(0)->mutable_phases(3)->mutable_states(0)->mutable_counting()->set_start_ds(36'001);
  EXPECT_FALSE(decode_spat(as_payload(late.SerializeAsString())));
}

}  // namespace
}  // namespace lukou
