#include "services/recorder/view_columns.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace lukou {
namespace {

constexpr auto kRed = static_cast<std::uint8_t>(Aspect::kRed);
constexpr auto kYellow = static_cast<std::uint8_t>(Aspect::kYellow);
constexpr auto kGreen = static_cast<std::uint8_t>(Aspect::kGreen);

/// A promise of `steps` steps from 0 on in which lane 0 is green and all others red.
SignalPromise promised(Step steps) {
  std::vector<std::uint8_t> heads;
  for (Step step = 0; step < steps; ++step) {
    for (int lane = 0; lane < kLanes; ++lane) heads.push_back(lane == 0 ? kGreen : kRed);
  }
  SignalPromise promise;
  EXPECT_TRUE(promise.extend(0, heads));
  return promise;
}

TEST(HeadForecast, TakesWhatIsPromisedBeforeWhatIsForecast) {
  SignalPromise promise = promised(10);
  std::vector<std::uint8_t> next(kLanes, kRed);
  next[0] = kYellow;
  ASSERT_TRUE(promise.extend(10, next));
  HeadForecast forecast;
  SignalBatch batch;
  batch.change_lane = {0, 0, 1};
  batch.change_aspect = {kYellow, kRed, kGreen};
  batch.change_step = {10, 40, 43};
  forecast.take(batch);
  View view;
  view.step = 4;
  forecast.fill(view, promise);
  ASSERT_EQ(view.heads.size(), 12U);
  EXPECT_EQ(view.heads[0], kGreen);
  EXPECT_EQ(view.change_step[0], 10);
  EXPECT_EQ(view.next_aspect[0], kYellow);
  EXPECT_EQ(view.change_step[1], 43) << "beyond the promise";
  EXPECT_EQ(view.next_aspect[1], kGreen);
  EXPECT_EQ(view.change_step[2], -1) << "nobody knows";
  EXPECT_EQ(view.next_aspect[2], 0);
}

TEST(HeadForecast, OfAStepThatIsNotPromisedShowsNothing) {
  View view;
  view.step = 20;
  view.heads = {kRed};
  HeadForecast().fill(view, promised(10));
  EXPECT_TRUE(view.heads.empty());
  EXPECT_TRUE(view.change_step.empty());
}

TEST(ViewColumns, CarryTheCarsAndWhatIsMeasuredOfThem) {
  RunMeasures measures{MeasureParameters{}};
  TrafficBatch batch;
  batch.arrived = {1, 0, 0, 0};
  batch.waiting = batch.arrived_equipped = batch.waiting_equipped = {0, 0, 0, 0};
  batch.entered_vehicle = {0};
  batch.entered_lane = {1};
  batch.entered_equipped = {0};
  batch.entered_speed_mps = {15.0};
  batch.entered_desired_speed_mps = {15.0};
  batch.vehicle = {0};
  batch.lane = {1};
  batch.state = {0};
  batch.equipped = {0};
  batch.position_m = {3.0};
  batch.speed_mps = {0.5};
  batch.acceleration_mps2 = {-1.0};
  batch.commanded_mps2 = {std::nan("")};
  batch.guidance = {0};
  batch.bound_by = {2};
  batch.missed = {kNothingMissed};
  batch.fate_vehicle = {0}, batch.fate_rsu = {0}, batch.fate_sequence = {1}, batch.fate = {2}, batch.fate_again = {0};
  batch.fate_issued = {0}, batch.fate_commanded_mps2 = {1.0}, batch.fate_kind = {0}, batch.fate_speed_mps = {0.0};
  measures.add(batch);
  View view;
  UplinkWatch uplink;
  uplink.add(batch);
  fill_cars(view, batch, measures, uplink);
  fill_figures(view, measures);
  fill_radio(view, {});
  EXPECT_TRUE(view.well_formed());
  EXPECT_EQ(view.standing_steps, std::vector<std::uint32_t>{1});
  EXPECT_EQ(view.advice_step, std::vector<Step>{0});
  EXPECT_EQ(view.uplink, std::vector<std::uint8_t>{255}) << "no unit";
  EXPECT_EQ(view.heard_step, std::vector<Step>{-1});
  EXPECT_EQ(view.advice[2], 1U) << "changed by the guard";
  EXPECT_EQ(view.queue[1], 1U);
  EXPECT_EQ(view.figures.in_system, (std::vector<std::uint32_t>{1, 0, 1})) << "all, equipped, others";
  EXPECT_TRUE(std::isnan(view.figures.mean_stop_time_s[1])) << "of no car";
  fill_figures(view, measures);
  EXPECT_TRUE(view.well_formed()) << "filled again, not twice as long";
}

TEST(ViewColumns, CarryTheRadioOfTheLastSecondByCause) {
  ReceptionFigures row{.direction = Direction::kDownlink, .kind = FrameKind::kRsc, .sent = 10, .heard = 4};
  row.lost_random = 1;
  row.lost_burst = 2;
  row.lost_outage = 3;
  View view;
  fill_radio(view, std::vector<ReceptionFigures>{row});
  EXPECT_EQ(view.radio_direction, std::vector<std::uint8_t>{1});
  EXPECT_EQ(view.radio_lost, (std::vector<std::uint32_t>{1, 2, 0, 0, 0, 0, 3}));
  EXPECT_TRUE(std::isnan(view.radio_latency_ms[0]));
}

}  // namespace
}  // namespace lukou
