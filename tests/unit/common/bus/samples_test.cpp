#include "common/bus/samples.hpp"

#include <gtest/gtest.h>

#include <tuple>

#include "tests/unit/common/bus/members.hpp"

namespace lukou::bus {
namespace {

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
