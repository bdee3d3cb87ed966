#include "common/measures/uplink_watch.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace lukou {
namespace {

constexpr std::uint8_t kLostBurst = 1 + static_cast<std::uint8_t>(LossCause::kBurst);

/// The newest step of a run with one RSU and the cars 0 (a unit) and 1 (none).
TrafficBatch batch_of(Step step, std::uint32_t heard_epoch = 1) {
  TrafficBatch batch;
  batch.step = step;
  batch.vehicle = {0, 1};
  batch.equipped = {1, 0};
  batch.heard_epoch = {heard_epoch};
  return batch;
}

/// The same under a modelled radio: an RSU tells what became of car 0's message of the step before.
TrafficBatch told(Step step, std::uint8_t fate, Step due, std::uint32_t rsu = 0) {
  TrafficBatch batch = batch_of(step);
  batch.reception.add(Direction::kUplink, FrameKind::kBsm, {});
  batch.uplink_vehicle = {0};
  batch.uplink_rsu = {rsu};
  batch.uplink.fate = {fate};
  batch.uplink.due = {due};
  batch.uplink.latency_ms = {std::numeric_limits<double>::quiet_NaN()};
  return batch;
}

TEST(UplinkWatch, UnderAnIdealRadioHearsEveryUnitAtOnce) {
  UplinkWatch watch;
  watch.add(batch_of(5));
  const CarUplink equipped = watch.now(batch_of(5), 0);
  EXPECT_EQ(equipped.newest, kFrameHeard);
  EXPECT_EQ(equipped.heard_step, 4) << "what was sent at t4 is known with step 5";
  EXPECT_EQ(watch.now(batch_of(5), 1).newest, 255) << "without a unit";
}

TEST(UplinkWatch, ASilentRsuHearsNobody) {
  UplinkWatch watch;
  watch.add(batch_of(5));
  watch.add(batch_of(6, 0));
  EXPECT_EQ(watch.now(batch_of(6, 0), 0).heard_step, 4);
}

TEST(UplinkWatch, ACarThatHasJustEnteredHasSentNothing) {
  UplinkWatch watch;
  TrafficBatch batch = batch_of(5);
  batch.entered_vehicle = {0};
  watch.add(batch);
  EXPECT_EQ(watch.now(batch, 0).newest, 255);
  EXPECT_EQ(watch.now(batch, 0).heard_step, -1);
}

TEST(UplinkWatch, HearsAMessageWhenItArrives) {
  UplinkWatch watch;
  watch.add(told(5, kFrameHeard, 6));  // sent at t4, heard at t6
  EXPECT_EQ(watch.now(told(5, kFrameHeard, 6), 0).heard_step, -1);
  watch.add(told(6, kLostBurst, -1));
  watch.add(told(7, kLostBurst, -1));
  const CarUplink car = watch.now(told(7, kLostBurst, -1), 0);
  EXPECT_EQ(car.heard_step, 4) << "the engine tells of t6 in step 7";
  EXPECT_EQ(car.newest, kLostBurst);
}

TEST(UplinkWatch, OneRsuThatHearsIsEnough) {
  UplinkWatch watch;
  TrafficBatch batch = told(5, kLostBurst, -1);
  const TrafficBatch second = told(5, kFrameHeard, 4, 1);
  batch.uplink_vehicle.push_back(0);
  batch.uplink_rsu.push_back(1);
  batch.uplink.add(second.uplink);
  watch.add(batch);
  EXPECT_EQ(watch.now(batch, 0).newest, kFrameHeard);
  EXPECT_EQ(watch.now(batch, 0).heard_step, 4);
}

TEST(UplinkWatch, ForgetsACarThatHasLeft) {
  UplinkWatch watch;
  watch.add(told(5, kFrameHeard, 9));
  TrafficBatch left = told(6, kFrameHeard, 5);
  left.left_vehicle = {0};
  watch.add(left);
  TrafficBatch later = batch_of(10);
  later.reception.add(Direction::kUplink, FrameKind::kBsm, {});
  watch.add(later);
  EXPECT_EQ(watch.now(later, 0).newest, 255);
}

}  // namespace
}  // namespace lukou
