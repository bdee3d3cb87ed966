#include "services/rsu/rsu_node.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "common/messages/bsm.hpp"
#include "common/messages/time_marks.hpp"
#include "services/rsu/sdk/planning.hpp"
#include "tests/unit/services/rsu/rsu_rig.hpp"

namespace lukou {
namespace {

std::vector<std::size_t> frames_of(const RoadsideBatch& out, FrameKind kind) {
  std::vector<std::size_t> frames;
  for (std::size_t i = 0; i < out.frames.size(); ++i) {
    if (out.frames.kind[i] == static_cast<std::uint8_t>(kind)) frames.push_back(i);
  }
  return frames;
}

TEST(RsuNode, ShowsItsAlgorithmWhatItHeard) {
  int calls = 0;
  RsuNode node = node_with([&](const RsuView& heard, RsuAnswer&) {
    ++calls;
    EXPECT_EQ(heard.step, 0);
    EXPECT_NEAR(heard.map.speed_limit_mps, 16.6667, 1e-3);
    const LaneView& lane = heard.lanes[1];
    ASSERT_EQ(lane.cars.size(), 2U);
    EXPECT_EQ(lane.cars[0].id, TemporaryId{5});
    EXPECT_NEAR(lane.cars[0].distance_m, 100.0, 0.0056);
    EXPECT_NEAR(lane.cars[0].speed_mps, 12.0, 0.01);
    EXPECT_NEAR(lane.cars[0].acceleration_mps2, 0.5, 0.005);
    EXPECT_EQ(lane.cars[0].age, 0);
    EXPECT_EQ(lane.cars[1].id, TemporaryId{4});
    EXPECT_EQ(lane.aspect, Aspect::kGreen);
    ASSERT_GE(lane.changes.size(), 5U);
    EXPECT_EQ(lane.changes[0], (SignalChange{Aspect::kRed, 450}));
    EXPECT_EQ(lane.changes[1], (SignalChange{Aspect::kGreen, 900}));
    EXPECT_EQ(heard.lanes[3].aspect, Aspect::kRed);
  });
  const SignalBatch signal = signals(0);
  AirBatch air;
  add_car(air, 4, 200.0, 12.0);
  add_car(air, 5, 100.0, 12.0);
  RoadsideBatch out;
  node.step(0, &signal, air, out);
  EXPECT_EQ(calls, 1);
  EXPECT_EQ(out.frames_heard, 2U);
  EXPECT_EQ(out.frames_malformed, 0U);
}

/// Asks twice in step 1.
void ask_twice(const RsuView& heard, RsuAnswer& answer) {
  if (heard.step != 1) return;
  answer.request_green({static_cast<Lane>(3)}, 20);
  answer.request_green({static_cast<Lane>(0), static_cast<Lane>(2)}, 50);
}

TEST(RsuNode, HandsOnTheLastRequestOfAStep) {
  RsuConfig actuated = config();
  actuated.actuation = Actuation{};
  RsuNode node(actuated, std::make_unique<Scripted>(ask_twice));
  const SignalBatch signal = signals(0);
  RoadsideBatch out;
  for (Step k = 0; k < 3; ++k) {
    node.step(k, k == 0 ? &signal : nullptr, {.step = k, .frames = {}}, out);
    EXPECT_EQ(node.request().step, k);
    EXPECT_EQ(node.request().lanes, k == 1 ? std::vector<std::uint16_t>{0b101} : std::vector<std::uint16_t>{});
    EXPECT_EQ(node.request().lifetime, k == 1 ? std::vector<Step>{50} : std::vector<Step>{});
    EXPECT_EQ(out.requests_refused, 0U);
  }
}

TEST(RsuNode, CountsARequestThatAFixedPlanCannotHear) {
  RsuNode node = node_with(ask_twice);
  const SignalBatch signal = signals(0);
  RoadsideBatch out;
  for (Step k = 0; k < 3; ++k) {
    node.step(k, k == 0 ? &signal : nullptr, {.step = k, .frames = {}}, out);
    EXPECT_TRUE(node.request().lanes.empty());
    EXPECT_EQ(out.requests_refused, k == 1 ? 1U : 0U);
  }
}

TEST(RsuNode, HoldsARequestBackForTheStepsThatItComputes) {
  // 250 ms: the answer of step 1 is said after step 3 has begun, and its 50 steps of life have become 48.
  RsuConfig slow = config();
  slow.actuation = Actuation{};
  slow.computing.declared_ms = 250;
  RsuNode node(slow, std::make_unique<Scripted>([](const RsuView& heard, RsuAnswer& answer) {
                 EXPECT_EQ(heard.request_acts, heard.step + 2 + 1 + 10);
                 if (heard.step == 1) answer.request_green({static_cast<Lane>(0)}, 50);
                 if (heard.step == 2) answer.request_green({static_cast<Lane>(1)}, 2);
               }));
  const SignalBatch signal = signals(0);
  RoadsideBatch out;
  for (Step k = 0; k < 6; ++k) {
    node.step(k, k == 0 ? &signal : nullptr, {.step = k, .frames = {}}, out);
    EXPECT_EQ(node.request().lanes, k == 3 ? std::vector<std::uint16_t>{1} : std::vector<std::uint16_t>{}) << k;
    EXPECT_EQ(node.request().lifetime, k == 3 ? std::vector<Step>{48} : std::vector<Step>{}) << k;
  }
}

TEST(RsuNode, TellsItsAlgorithmHowFarTheHeadsArePromised) {
  RsuConfig with_actuation = config();
  with_actuation.actuation = Actuation{.min_green = 60};
  RsuNode node(with_actuation, std::make_unique<Scripted>([](const RsuView& heard, RsuAnswer&) {
                 EXPECT_EQ(heard.promised_to, kPromised - 1);
                 ASSERT_TRUE(heard.actuation);
                 EXPECT_EQ(heard.actuation->min_green, 60);
                 LaneSet west_east;
                 for (const Lane lane : kAllLanes) {
                   if (approach_of(lane) == Approach::kWest || approach_of(lane) == Approach::kEast) {
                     west_east.insert(lane);
                   }
                 }
                 EXPECT_EQ(promised_green(heard), west_east);
               }));
  const SignalBatch signal = signals(0);
  RoadsideBatch out;
  for (Step k = 0; k < 3; ++k) node.step(k, k == 0 ? &signal : nullptr, {.step = k, .frames = {}}, out);
}

TEST(RsuNode, SaysSpatInEachStepAndMapInEachSecond) {
  RsuNode node = idle_node();
  const SignalBatch signal = signals(0);
  RoadsideBatch out;
  std::uint32_t sequence = 0;
  for (Step k = 0; k < kPromised; ++k) {
    node.step(k, k == 0 ? &signal : nullptr, {.step = k, .frames = {}}, out);
    EXPECT_EQ(out.step, k);
    EXPECT_EQ(frames_of(out, FrameKind::kSpat).size(), 1U);
    EXPECT_EQ(frames_of(out, FrameKind::kMap).size(), k % 10 == 0 ? 1U : 0U);
    EXPECT_TRUE(frames_of(out, FrameKind::kRsc).empty());
    for (std::size_t i = 0; i < out.frames.size(); ++i) {
      EXPECT_EQ(out.frames.sender[i], 900U);
      EXPECT_EQ(out.frames.sequence[i], sequence++);
    }
  }
}

TEST(RsuNode, SaysInItsSpatWhenTheHeadsWillChange) {
  RsuNode node = idle_node();
  const SignalBatch signal = signals(440);
  RoadsideBatch out;
  node.step(445, &signal, {.step = 445, .frames = {}}, out);
  const auto spat = decode_spat(out.frames.payload_of(frames_of(out, FrameKind::kSpat).at(0)));
  ASSERT_TRUE(spat) << spat.error().text();
  EXPECT_EQ(spat.value().second_mark_ms, 44'500);
  const auto& states = spat.value().lanes[0];
  ASSERT_EQ(states.size(), 3U);
  EXPECT_EQ(states[0].aspect, Aspect::kGreen);
  EXPECT_EQ(states[0].ends_in, 5);
  EXPECT_EQ(states[1].aspect, Aspect::kRed);
  EXPECT_EQ(states[1].starts_in, 5);
  EXPECT_EQ(states[1].ends_in, 455);
  EXPECT_EQ(states[2].ends_in, 905);
}

TEST(RsuNode, TellsInItsMapWhereEachLaneRuns) {
  RsuNode node = idle_node();
  const SignalBatch signal = signals(0);
  RoadsideBatch out;
  node.step(0, &signal, {}, out);
  const auto map = decode_map(out.frames.payload_of(frames_of(out, FrameKind::kMap).at(0)));
  ASSERT_TRUE(map) << map.error().text();
  // NR: cars come from the north on the west side of their road, 8.75 m from the axis.
  EXPECT_NEAR(map.value().lanes[11].entrance.y_m, 515.5, 0.0056);
  EXPECT_NEAR(map.value().lanes[11].stop_line.y_m, 15.5, 0.0056);
  EXPECT_NEAR(map.value().lanes[11].stop_line.x_m, -8.75, 0.0056);
}

TEST(RsuNode, SendsAtMostSixteenAdvicesAFrame) {
  RsuNode node = node_with([](const RsuView&, RsuAnswer& answer) {
    for (std::uint64_t id = 0; id < 35; ++id) {
      answer.advise(static_cast<TemporaryId>(id), {.acceleration_mps2 = -1.0, .lifetime = 5});
    }
    answer.release(TemporaryId{99});
  });
  const SignalBatch signal = signals(0);
  RoadsideBatch out;
  node.step(0, &signal, {}, out);
  const auto frames = frames_of(out, FrameKind::kRsc);
  ASSERT_EQ(frames.size(), 3U);
  std::uint64_t next = 0;
  for (const std::size_t frame : frames) {
    const auto message = decode_rsc(out.frames.payload_of(frame));
    ASSERT_TRUE(message);
    EXPECT_EQ(message.value().rsu, 900U);
    for (const VehicleCoordination& car : message.value().vehicles) {
      if (next == 35) {
        EXPECT_EQ(car.vehicle, 99U);
        EXPECT_FALSE(car.path);
        continue;
      }
      EXPECT_EQ(car.vehicle, next++);
      ASSERT_TRUE(car.path);
      EXPECT_EQ(car.path->acceleration_mps2, -1.0);
      EXPECT_EQ(car.path->lifetime_ms, 500U);
      EXPECT_EQ(car.binding, Binding::kGuard);
    }
  }
  EXPECT_EQ(next, 35U);
}

TEST(RsuNode, RefusesAdviceThatNoMessageCanCarry) {
  RsuNode node = node_with([](const RsuView&, RsuAnswer& answer) {
    const TemporaryId car{1};
    answer.advise(car, {.acceleration_mps2 = std::numeric_limits<double>::quiet_NaN(), .lifetime = 5});
    answer.advise(car, {.acceleration_mps2 = -std::numeric_limits<double>::infinity(), .lifetime = 5});
    answer.advise(car, {.acceleration_mps2 = 20.02, .lifetime = 5});
    answer.advise(car, {.acceleration_mps2 = 1.0, .lifetime = 0});
    answer.advise(car, {.acceleration_mps2 = 1.0, .lifetime = 6554});
    answer.advise(car, {.acceleration_mps2 = 1.0, .lifetime = 6553});
  });
  const SignalBatch signal = signals(0);
  RoadsideBatch out;
  node.step(0, &signal, {}, out);
  EXPECT_EQ(out.answers_malformed, 5U);
  const auto frames = frames_of(out, FrameKind::kRsc);
  ASSERT_EQ(frames.size(), 1U);
  EXPECT_EQ(decode_rsc(out.frames.payload_of(frames[0])).value().vehicles.size(), 1U);
}

TEST(RsuNode, SaysSpeedsForLanesAfterItsCarsAtMostEightAFrame) {
  RsuNode node = node_with([](const RsuView&, RsuAnswer& answer) {
    for (std::uint8_t lane = 0; lane < kLanes; ++lane) answer.lane_speed(static_cast<Lane>(lane), 10.0, 5);
    answer.lane_speed(Lane{3}, std::numeric_limits<double>::quiet_NaN(), 5);
    answer.advise_profile(TemporaryId{1}, {.segments = {{5, 1.0}, {5, -1.0}}});
    answer.advise_speed(TemporaryId{2}, {.speed_mps = 9.0, .lifetime = 5});
    answer.advise_profile(TemporaryId{3}, {.segments = std::vector<AccelerationSegment>(40, {1, 0.0})});
  });
  const SignalBatch signal = signals(0);
  RoadsideBatch out;
  node.step(0, &signal, {}, out);
  EXPECT_EQ(out.answers_malformed, 2U);
  const auto frames = frames_of(out, FrameKind::kRsc);
  ASSERT_EQ(frames.size(), 3U);
  const auto said = [&](std::size_t i) { return decode_rsc(out.frames.payload_of(frames[i])).value(); };
  ASSERT_EQ(said(0).vehicles.size(), 2U);
  EXPECT_EQ(said(0).vehicles[0].path->later.size(), 1U);
  EXPECT_EQ(said(0).vehicles[1].path->speed_mps, 9.0);
  EXPECT_EQ(said(1).lanes.size(), 8U);
  ASSERT_EQ(said(2).lanes.size(), 4U);
  EXPECT_EQ(said(2).lanes[3].lane, Lane{11});
  EXPECT_EQ(said(2).node, 1);
}

TEST(RsuNode, DropsAndCountsWhatItCannotDecode) {
  std::size_t cars = 0;
  RsuNode node = node_with([&](const RsuView& heard, RsuAnswer&) { cars = heard.lanes[1].cars.size(); });
  const SignalBatch signal = signals(0);
  AirBatch air;
  add_car(air, 4, 200.0, 12.0);
  add_car(air, 5, 100.0, 12.0);
  air.frames.payload[0] = 0xff;  // the first frame's first byte
  RoadsideBatch out;
  node.step(0, &signal, air, out);
  EXPECT_EQ(out.frames_heard, 2U);
  EXPECT_EQ(out.frames_malformed, 1U);
  EXPECT_EQ(cars, 1U);
}

std::uint32_t computing_ms(const ComputingTime& computing, double takes_s) {
  RsuConfig of = config();
  of.computing = computing;
  double now_s = 5.0;
  RsuNode node(of, std::make_unique<Scripted>([&](const RsuView&, RsuAnswer&) { now_s += takes_s; }));
  node.measure_with([&] { return now_s; });
  const SignalBatch signal = signals(0);
  RoadsideBatch out;
  node.step(0, &signal, {}, out);
  return out.computing_ms;
}

TEST(RsuNode, SaysHowLongItComputedInWholeMilliseconds) {
  EXPECT_EQ(computing_ms({.measured = true}, 0.1234), 123U);
  EXPECT_EQ(computing_ms({.measured = true}, 0.1236), 124U);
  EXPECT_EQ(computing_ms({.measured = true}, 0.0004), 0U);
  EXPECT_EQ(computing_ms({.measured = true}, 1000.0), 50'000U) << "cut where the radio cuts";
}

TEST(RsuNode, SaysTheDeclaredTimeWhateverItTook) {
  EXPECT_EQ(computing_ms({.declared_ms = 20}, 0.3), 20U);
  EXPECT_EQ(computing_ms({}, 0.3), 0U);
}

TEST(RsuNodeDeathTest, EndsTheProgramWithoutAPromiseForItsStep) {
  RsuNode node = idle_node();
  RoadsideBatch out;
  EXPECT_DEATH(node.step(0, nullptr, {}, out), "covers");
}

TEST(RsuNode, AnswersTheSameInputsWithTheSameBytes) {
  const auto run = [] {
    auto algorithm = make_algorithm("arrive_on_green", {});
    RsuNode node(config(), std::move(algorithm.value()));
    std::vector<std::uint8_t> bytes;
    RoadsideBatch out;
    for (Step k = 455; k < 500; ++k) {  // red for W and E until step 900
      const SignalBatch signal = signals(k == 455 ? k : k + kPromised - 1);
      AirBatch air;
      air.step = k;
      add_car(air, 4, 400.0 - 1.5 * static_cast<double>(k - 455), 15.0);
      add_car(air, 9, 430.0 - 1.5 * static_cast<double>(k - 455), 15.0);
      node.step(k, &signal, air, out);
      EXPECT_EQ(frames_of(out, FrameKind::kRsc).size(), 1U);
      bytes.insert(bytes.end(), out.frames.payload.begin(), out.frames.payload.end());
    }
    return bytes;
  };
  EXPECT_EQ(run(), run());
}

}  // namespace
}  // namespace lukou
