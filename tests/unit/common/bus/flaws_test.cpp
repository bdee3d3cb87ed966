#include "common/bus/flaws.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "tests/unit/common/bus/members.hpp"

namespace lukou::bus {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinite = std::numeric_limits<double>::infinity();

template <class Member>
constexpr bool kIsColumn = requires(Member member) { member.push_back({}); } && !std::is_same_v<Member, std::string>;

/// One row in every column, each value a 1: a kind of frame, a lane, an aspect, a step, a number.
template <class Batch>
Batch of_ones() {
  Batch batch;
  const auto fill = []<class Member>(Member& member) {
    if constexpr (kIsColumn<Member>) {
      member.assign(1, {});
      if constexpr (requires { member.front() = 1; }) member.front() = 1;
    }
  };
  std::apply([&](auto&... member) { (fill(member), ...); }, members(batch));
  if constexpr (std::is_same_v<Batch, SignalBatch>) batch.heads.assign(12, 1);
  if constexpr (std::is_same_v<Batch, TrafficBatch>) {
    for (auto* column : {&batch.arrived, &batch.waiting, &batch.arrived_equipped, &batch.waiting_equipped}) {
      column->assign(4, 1);
    }
  }
  return batch;
}

/// A batch is well with all its columns alike, and is not as soon as any one of them is longer or shorter.
template <class Batch>
void expect_every_column_is_watched() {
  auto good = of_ones<Batch>();
  EXPECT_EQ(flaw_of(good), "");
  int columns = 0;
  const auto spoil = [&]<class Member>(Member& member) {
    if constexpr (kIsColumn<Member>) {
      ++columns;
      const auto before = member;
      member.push_back(member.front());
      EXPECT_NE(flaw_of(good), "") << "column " << columns << " may be longer than the others";
      member.clear();
      EXPECT_NE(flaw_of(good), "") << "column " << columns << " may be empty";
      member = before;
    }
  };
  std::apply([&](auto&... member) { (spoil(member), ...); }, members(good));
  EXPECT_GT(columns, 1);
  // Four approaches and twelve heads are always there.
  EXPECT_EQ(flaw_of(Batch{}).empty(), (!std::is_same_v<Batch, TrafficBatch> && !std::is_same_v<Batch, SignalBatch>));
}

TEST(Flaws, OfAirAreColumnsOfDifferentLength) { expect_every_column_is_watched<AirBatch>(); }
TEST(Flaws, OfRoadsideAreColumnsOfDifferentLength) { expect_every_column_is_watched<RoadsideBatch>(); }
TEST(Flaws, OfRequestAreColumnsOfDifferentLength) { expect_every_column_is_watched<RequestBatch>(); }
TEST(Flaws, OfSignalAreColumnsOfDifferentLength) { expect_every_column_is_watched<SignalBatch>(); }
TEST(Flaws, OfTrafficAreColumnsOfDifferentLength) { expect_every_column_is_watched<TrafficBatch>(); }
TEST(Flaws, OfControlAreColumnsOfDifferentLength) { expect_every_column_is_watched<Control>(); }

TEST(Flaws, NameTheColumnThePlaceAndWhatWouldBeRight) {
  auto air = of_ones<AirBatch>();
  air.frames.kind[0] = 9;
  EXPECT_EQ(flaw_of(air), "frames.kind[0] is 9, must be 1 to 5");
  air.frames.kind.clear();
  EXPECT_EQ(flaw_of(air), "frames.kind has 0 values, frames.sender has 1");
  auto traffic = of_ones<TrafficBatch>();
  traffic.arrived.pop_back();
  EXPECT_EQ(flaw_of(traffic), "arrived has 3 values, the junction has 4");
  auto signal = of_ones<SignalBatch>();
  signal.heads.pop_back();
  EXPECT_EQ(flaw_of(signal), "heads must be twelve for each step");
}

/// The flaw of a batch with one thing changed; "" means that it passed.
template <class Batch, class Change>
std::string with(Change change) {
  auto batch = of_ones<Batch>();
  change(batch);
  return flaw_of(batch);
}

TEST(Flaws, OfAirAreValuesOutOfRange) {
  EXPECT_NE(with<AirBatch>([](auto& b) { b.step = -1; }), "");
  EXPECT_NE(with<AirBatch>([](auto& b) { b.frames.kind[0] = 0; }), "");
  EXPECT_NE(with<AirBatch>([](auto& b) { b.frames.wire_bytes[0] = 65'536; }), "");
  EXPECT_NE(with<AirBatch>([](auto& b) { b.frames.antenna_x_m[0] = kNaN; }), "");
  EXPECT_NE(with<AirBatch>([](auto& b) { b.frames.antenna_y_m[0] = kInfinite; }), "");
  EXPECT_NE(with<AirBatch>([](auto& b) { b.frames.payload_end[0] = 2; }), "") << "beyond the payload";
  EXPECT_NE(with<AirBatch>([](auto& b) { b.frames.payload_end[0] = 0; }), "") << "bytes of nobody";
  EXPECT_NE(with<AirBatch>([](auto& b) { b.sensed.x_m[0] = kNaN; }), "");
  EXPECT_NE(with<AirBatch>([](auto& b) { b.sensed.speed_mps[0] = -0.5; }), "");
  EXPECT_NE(with<AirBatch>([](auto& b) { b.sensed.heading_rad[0] = kInfinite; }), "");
  EXPECT_NE(with<AirBatch>([](auto& b) { b.sensed.length_class[0] = 4; }), "");
  EXPECT_NE(with<AirBatch>([](auto& b) { b.sensed.measured[0] = -3; }), "");
}

TEST(Flaws, OfFramesAreEndsThatFallBack) {
  AirBatch air = of_ones<AirBatch>();
  const Frames one = air.frames;
  for (int more = 0; more < 2; ++more) {
    std::apply([&](auto&... column) { (column.push_back(column.front()), ...); }, members(air.frames));
  }
  air.frames.payload_end = {2, 1, 3};
  EXPECT_EQ(flaw_of(air), "frames.payload_end must be rising, within the payload");
  air.frames.payload_end = {2, 2, 3};
  EXPECT_EQ(flaw_of(air), "") << "an empty frame is none";
}

TEST(Flaws, OfFramesAreMoreThanAnyStationSends) {
  AirBatch air;
  const auto rows = [&](std::size_t count) {
    std::apply([&](auto&... column) { (column.assign(count, 1), ...); }, members(air.frames));
    for (std::size_t i = 0; i < count; ++i) air.frames.payload_end[i] = static_cast<std::uint32_t>(i + 1);
  };
  rows(kFramesMax);
  EXPECT_EQ(flaw_of(air), "");
  rows(kFramesMax + 1);
  EXPECT_EQ(flaw_of(air), "frames must be at most 65536 in a step");
}

TEST(Flaws, OfRoadsideAreValuesOutOfRange) {
  EXPECT_NE(with<RoadsideBatch>([](auto& b) { b.step = -1; }), "");
  EXPECT_NE(with<RoadsideBatch>([](auto& b) { b.reception.direction[0] = 3; }), "");
  EXPECT_NE(with<RoadsideBatch>([](auto& b) { b.reception.kind[0] = 6; }), "");
  EXPECT_NE(with<RoadsideBatch>([](auto& b) { b.reception.heard[0] = 4'000'000'000U; }), "")
      << "latencies that are not there";
  EXPECT_NE(with<RoadsideBatch>([](auto& b) { b.reception.latency_ms[0] = kNaN; }), "");
  EXPECT_NE(with<RoadsideBatch>([](auto& b) { b.reception.busy_ratio[0] = 1.01; }), "");
  EXPECT_EQ(with<RoadsideBatch>([](auto& b) { b.reception.busy_ratio[0] = kNaN; }), "") << "not counted";
  EXPECT_NE(with<RoadsideBatch>([](auto& b) { b.uplink.fate[0] = 8; }), "");
  EXPECT_NE(with<RoadsideBatch>([](auto& b) { b.uplink.due[0] = -2; }), "");
  EXPECT_EQ(with<RoadsideBatch>([](auto& b) { b.uplink.latency_ms[0] = kNaN; }), "") << "lost";
  EXPECT_NE(with<RoadsideBatch>([](auto& b) { b.uplink.latency_ms[0] = kInfinite; }), "");
  EXPECT_NE(with<RoadsideBatch>([](auto& b) { b.request_lanes = {1, 1}, b.request_lifetime = {1, 1}; }), "");
  EXPECT_EQ(with<RoadsideBatch>([](auto& b) { b.frames_heard = 4'000'000'000U; }), "") << "a count is a count";
}

TEST(Flaws, OfSignalAreValuesOutOfRange) {
  EXPECT_NE(with<SignalBatch>([](auto& b) { b.first = -1; }), "");
  EXPECT_NE(with<SignalBatch>([](auto& b) { b.heads[11] = 0; }), "");
  EXPECT_NE(with<SignalBatch>([](auto& b) { b.change_lane[0] = 12; }), "");
  EXPECT_NE(with<SignalBatch>([](auto& b) { b.change_aspect[0] = 4; }), "");
  EXPECT_NE(with<SignalBatch>([](auto& b) { b.change_step[0] = -1; }), "");
  EXPECT_NE(with<SignalBatch>([](auto& b) { b.request_outcome[0] = 7; }), "");
  EXPECT_EQ(with<SignalBatch>([](auto& b) { b.request_lanes[0] = 0xFFFF; }), "") << "as asked, whatever was in it";
}

TEST(Flaws, OfTrafficAreValuesOutOfRange) {
  EXPECT_NE(with<TrafficBatch>([](auto& b) { b.lane[0] = 12; }), "");
  EXPECT_NE(with<TrafficBatch>([](auto& b) { b.state[0] = 4; }), "");
  EXPECT_NE(with<TrafficBatch>([](auto& b) { b.equipped[0] = 2; }), "");
  for (auto column : {&TrafficBatch::position_m, &TrafficBatch::speed_mps, &TrafficBatch::acceleration_mps2,
                      &TrafficBatch::noise_mps2, &TrafficBatch::crossed_time_s, &TrafficBatch::left_time_s,
                      &TrafficBatch::entered_speed_mps, &TrafficBatch::entered_desired_speed_mps}) {
    EXPECT_NE(with<TrafficBatch>([&](auto& b) { (b.*column)[0] = kNaN; }), "");
  }
  for (auto column :
       {&TrafficBatch::commanded_mps2, &TrafficBatch::fate_commanded_mps2, &TrafficBatch::fate_speed_mps}) {
    EXPECT_EQ(with<TrafficBatch>([&](auto& b) { (b.*column)[0] = kNaN; }), "") << "none";
    EXPECT_NE(with<TrafficBatch>([&](auto& b) { (b.*column)[0] = kInfinite; }), "");
  }
  EXPECT_NE(with<TrafficBatch>([](auto& b) { b.guidance[0] = 9; }), "");
  EXPECT_NE(with<TrafficBatch>([](auto& b) { b.bound_by[0] = 7; }), "");
  EXPECT_NE(with<TrafficBatch>([](auto& b) { b.missed[0] = 23; }), "");
  EXPECT_EQ(with<TrafficBatch>([](auto& b) { b.missed[0] = 255; }), "") << "nothing missed";
  EXPECT_NE(with<TrafficBatch>([](auto& b) { b.fate[0] = 23; }), "");
  EXPECT_NE(with<TrafficBatch>([](auto& b) { b.fate_kind[0] = 4; }), "");
  EXPECT_NE(with<TrafficBatch>([](auto& b) { b.fate_issued[0] = -2; }), "");
  EXPECT_NE(with<TrafficBatch>([](auto& b) { b.overflow = 2; }), "");
  EXPECT_NE(with<TrafficBatch>([](auto& b) { b.uplink.fate[0] = 8; }), "");
  EXPECT_EQ(with<TrafficBatch>([](auto& b) { b.air.kind[0] = 9; }), "air: frames.kind[0] is 9, must be 1 to 5");
  EXPECT_EQ(with<TrafficBatch>([](auto& b) { b.said.kind[0] = 9; }), "said: frames.kind[0] is 9, must be 1 to 5");
}

TEST(Flaws, OfMessagesAreKindsThatNobodyKnows) {
  EXPECT_NE(flaw_of(Control{.kind = static_cast<Control::Kind>(9)}), "");
  EXPECT_NE(flaw_of(Control{.kind = static_cast<Control::Kind>(0)}), "");
  EXPECT_NE(flaw_of(Up{.kind = static_cast<Up::Kind>(10)}), "");
  EXPECT_NE(flaw_of(RunState{.phase = static_cast<RunPhase>(6)}), "");
  EXPECT_NE(flaw_of(RunState{.pace = kNaN}), "");
  EXPECT_EQ(flaw_of(RunState{}), "");
  EXPECT_NE(flaw_of(View{}), "") << "without its lanes and groups";
}

}  // namespace
}  // namespace lukou::bus
