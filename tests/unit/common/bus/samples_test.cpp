#include "common/bus/samples.hpp"

#include <gtest/gtest.h>

#include <tuple>

namespace lukou::bus {
namespace {

// Each type's members stand in one structured binding: a member that is added to a batch and not to its list here does
// not compile, one that the bus forgets arrives empty.

auto members(Frames& f) {
  auto& [sender, sequence, kind, bytes, x, y, end, payload] = f;
  return std::tie(sender, sequence, kind, bytes, x, y, end, payload);
}

auto members(SensedColumns& s) {
  auto& [rsu, sensor, track, x, y, speed, heading, length, measured] = s;
  return std::tie(rsu, sensor, track, x, y, speed, heading, length, measured);
}

auto members(AirBatch& b) {
  auto& [step, frames, sensed] = b;
  return std::tuple_cat(std::tie(step), members(frames), members(sensed));
}

auto members(ReceptionReport& r) {
  auto& [direction, kind, sent, heard, lost_random, lost_burst, lost_range, duplicates, path_loss, collision,
         half_duplex, outage, busy, latency] = r;
  return std::tie(direction, kind, sent, heard, lost_random, lost_burst, lost_range, duplicates, path_loss, collision,
                  half_duplex, outage, busy, latency);
}

auto members(FrameFates& f) {
  auto& [fate, due, latency] = f;
  return std::tie(fate, due, latency);
}

auto members(RoadsideBatch& b) {
  auto& [rsu, epoch, step, frames, heard, malformed, answers, reception, requests, computing, uplink] = b;
  return std::tuple_cat(std::tie(rsu, epoch, step, heard, malformed, answers, requests, computing), members(frames),
                        members(reception), members(uplink));
}

auto members(RequestBatch& b) {
  auto& [rsu, epoch, step, lanes, lifetime] = b;
  return std::tie(rsu, epoch, step, lanes, lifetime);
}

auto members(SignalBatch& b) {
  auto& [step, first, heads, lane, aspect, at, request_step, asked, rsu, lanes, outcome] = b;
  return std::tie(step, first, heads, lane, aspect, at, request_step, asked, rsu, lanes, outcome);
}

auto members(TrafficBatch& b) {
  auto& [step, vehicle, lane, state, equipped, position, speed, acceleration, commanded, noise, guidance, bound_by,
         missed, arrived, waiting, arrived_equipped, waiting_equipped, entered, entered_lane, entered_equipped,
         entered_speed, entered_desired, crossed, crossed_time, crossed_aspect, crossed_committed, left, left_time,
         fate_vehicle, fate_rsu, fate_sequence, fate, fate_again, fate_issued, fate_commanded, answers, guard, overflow,
         heard, requests, reception, fate_kind, fate_speed, computing, uplink_vehicle, uplink_rsu, uplink] = b;
  return std::tuple_cat(
      std::tie(step, vehicle, lane, state, equipped, position, speed, acceleration, commanded, noise, guidance,
               bound_by, missed, arrived, waiting, arrived_equipped, waiting_equipped, entered, entered_lane,
               entered_equipped, entered_speed, entered_desired, crossed, crossed_time, crossed_aspect,
               crossed_committed, left, left_time, fate_vehicle, fate_rsu, fate_sequence, fate, fate_again, fate_issued,
               fate_commanded, answers, guard, overflow, heard, requests, fate_kind, fate_speed, computing,
               uplink_vehicle, uplink_rsu),
      members(reception), members(uplink));
}

auto members(Control& m) {
  auto& [kind, clock, sequence, to, epoch, rsu, through, last, ok, number, version, roster_incarnation, roster_role,
         directive_step, directive_set, attach_rsu, attach_epoch, attach_from, text, culprit] = m;
  return std::tie(kind, clock, sequence, to, epoch, rsu, through, last, ok, number, version, roster_incarnation,
                  roster_role, directive_step, directive_set, attach_rsu, attach_epoch, attach_from, text, culprit);
}

auto members(Up& m) {
  auto& [kind, incarnation, role, protocol, number, step, text, hash] = m;
  return std::tie(kind, incarnation, role, protocol, number, step, text, hash);
}

auto members(RunState& m) {
  auto& [run, phase, granted, recorded, end, pace, text, culprit] = m;
  return std::tie(run, phase, granted, recorded, end, pace, text, culprit);
}

auto members(FigureColumns& f) {
  auto& [arrived, waiting, in_system, left, standing, stops, throughput, per_vehicle, stop_time, mean_stop_time,
         mean_delay] = f;
  return std::tie(arrived, waiting, in_system, left, standing, stops, throughput, per_vehicle, stop_time,
                  mean_stop_time, mean_delay);
}

auto members(View& m) {
  auto& [step, figures, queue, arrived, waiting, heard, vehicle, lane, state, equipped, position, speed, acceleration,
         commanded, guidance, bound_by, missed, stood, advice, heads, change, next, direction, kind, sent, radio_heard,
         lost, latency, uplink, heard_step] = m;
  return std::tuple_cat(std::tie(step, queue, arrived, waiting, heard, vehicle, lane, state, equipped, position, speed,
                                 acceleration, commanded, guidance, bound_by, missed, stood, advice, heads, change,
                                 next, direction, kind, sent, radio_heard, lost, latency, uplink, heard_step),
                        members(figures));
}

/// Gives every member a value that no other one has.
class Filler {
 public:
  template <class T>
  void operator()(T& member) {
    if constexpr (std::is_same_v<T, bool>) {
      member = !member;  // there is only one other value
    } else if constexpr (std::is_same_v<T, std::string>) {
      member = "text " + std::to_string(++next_);
    } else if constexpr (requires { member.push_back({}); }) {
      // Lengths differ, too: swapped columns of equal type cannot pass.
      ++length_;
      member.assign(static_cast<std::size_t>(length_), {});
      for (auto& element : member) (*this)(element);
    } else {
      member = static_cast<T>(++next_);
    }
  }

 private:
  int next_ = 0;
  int length_ = 1;
};

template <class Batch>
Batch filled() {
  Batch batch;
  Filler fill;
  std::apply([&](auto&... member) { (fill(member), ...); }, members(batch));
  return batch;
}

/// What a reader gets of a batch: lent to a sample, signed by `sign` as the writer does, copied out of it into a batch
/// that held something else before.
template <class Batch, class Sign>
Batch carried(const Batch& sent, Sign sign) {
  typename TopicOf<Batch>::Sample sample{};
  Scratch scratch;
  lend(sent, sample, scratch);
  sign(sample);
  Batch received = filled<Batch>();
  std::apply([](auto&... member) { ((member = {}), ...); }, members(received));
  copy(sample, received);
  return received;
}

template <class Batch, class Sign>
void expect_carried_whole(Sign sign) {
  Batch sent = filled<Batch>();
  Batch received = carried(sent, sign);
  EXPECT_EQ(members(received), members(sent));
  // An empty one overwrites what the reader's batch held.
  Batch empty;
  typename TopicOf<Batch>::Sample sample{};
  Scratch scratch;
  lend(empty, sample, scratch);
  sign(sample);
  Batch reused = filled<Batch>();
  copy(sample, reused);
  const Batch signed_empty = carried(empty, sign);
  Batch expected = signed_empty;
  EXPECT_EQ(members(reused), members(expected));
}

constexpr auto kUnsigned = [](auto&) {};

TEST(Samples, CarryEveryColumnOfAir) { expect_carried_whole<AirBatch>(kUnsigned); }

TEST(Samples, CarryEveryColumnOfRoadside) {
  // The epoch is the writer's word, as for every lockstep topic.
  const std::uint32_t epoch = filled<RoadsideBatch>().epoch;
  expect_carried_whole<RoadsideBatch>([epoch](lukou_bus_Roadside& sample) { sample.epoch = epoch; });
}

TEST(Samples, CarryEveryColumnOfRequest) {
  const std::uint32_t epoch = filled<RequestBatch>().epoch;
  expect_carried_whole<RequestBatch>([epoch](lukou_bus_Request& sample) { sample.epoch = epoch; });
}

TEST(Samples, CarryEveryColumnOfSignal) { expect_carried_whole<SignalBatch>(kUnsigned); }
TEST(Samples, CarryEveryColumnOfTraffic) { expect_carried_whole<TrafficBatch>(kUnsigned); }
TEST(Samples, CarryEveryFieldOfControl) { expect_carried_whole<Control>(kUnsigned); }
TEST(Samples, CarryEveryFieldOfUp) { expect_carried_whole<Up>(kUnsigned); }
TEST(Samples, CarryEveryFieldOfRunState) { expect_carried_whole<RunState>(kUnsigned); }
TEST(Samples, CarryEveryColumnOfView) { expect_carried_whole<View>(kUnsigned); }

TEST(Samples, LendTheBatchesOwnStorageInPlaceOfACopy) {
  const auto sent = filled<TrafficBatch>();
  lukou_bus_Traffic sample{};
  Scratch scratch;
  lend(sent, sample, scratch);
  EXPECT_EQ(sample.position_m._buffer, sent.position_m.data());
  EXPECT_FALSE(sample.position_m._release) << "not Cyclone's to free";
}

TEST(Samples, TakeAMissingTextForAnEmptyOne) {
  lukou_bus_Up sample{};
  Up message;
  message.text = "before";
  copy(sample, message);
  EXPECT_EQ(message.text, "");
}

TEST(TrafficBatch, IsEmptyAfterItWasCleared) {
  auto batch = filled<TrafficBatch>();
  const Step step = batch.step;
  batch.clear();
  TrafficBatch empty;
  empty.step = step;
  EXPECT_EQ(members(batch), members(empty));
}

TEST(Frames, AreEmptyAfterTheyWereCleared) {
  auto frames = filled<Frames>();
  frames.clear();
  Frames empty;
  EXPECT_EQ(members(frames), members(empty));
}

TEST(Frames, KnowTheBytesOfEach) {
  Frames frames;
  frames.sender = {1, 2, 3};
  frames.payload = {10, 11, 12, 13, 14};
  frames.payload_end = {2, 2, 5};
  const auto bytes = [&](std::size_t frame) {
    const auto span = frames.payload_of(frame);
    return std::vector<std::uint8_t>(span.begin(), span.end());
  };
  EXPECT_EQ(frames.size(), 3U);
  EXPECT_EQ(bytes(0), (std::vector<std::uint8_t>{10, 11}));
  EXPECT_TRUE(bytes(1).empty());
  EXPECT_EQ(bytes(2), (std::vector<std::uint8_t>{12, 13, 14}));
}

}  // namespace
}  // namespace lukou::bus
