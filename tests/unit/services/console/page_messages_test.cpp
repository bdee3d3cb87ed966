#include "services/console/page_messages.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "console.pb.h"

namespace lukou::console {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

View two_cars() {
  View view;
  view.step = 100;
  FigureColumns& f = view.figures;
  f.arrived = {10, 7, 3}, f.waiting = {1, 1, 0}, f.in_system = {4, 3, 1}, f.left = {5, 3, 2};
  f.standing = {1, 0, 1}, f.stops = {2, 0, 2};
  f.throughput_veh_per_h = {600, 360, 240}, f.stops_per_vehicle = {0.2, 0.0, kNone}, f.stop_time_s = {3, 0, 3};
  f.mean_stop_time_s = {0.3, 0.0, kNone}, f.mean_delay_s = {kNone, kNone, kNone};
  view.queue.assign(12, 0);
  view.arrived = {4, 3, 2, 1}, view.waiting = {1, 0, 0, 0};
  view.vehicle = {8, 4}, view.lane = {1, 1}, view.state = {0, 2}, view.equipped = {1, 0};
  view.position_m = {400.5, 380.25}, view.speed_mps = {0.0, 1.5}, view.acceleration_mps2 = {-1.0, 0.5};
  view.commanded_mps2 = {0.25, kNone}, view.guidance = {2, 0}, view.bound_by = {3, 1}, view.missed = {255, 11};
  view.standing_steps = {15, 0}, view.advice_step = {97, -1};
  view.uplink = {0, 255}, view.heard_step = {98, -1};
  view.advice = {50, 1, 2, 3, 4};
  view.advice.resize(23);
  view.advice[21] = 5;
  view.heads.assign(12, 3), view.change_step.assign(12, 250), view.next_aspect.assign(12, 1);
  view.change_step[5] = -1;
  return view;
}

TEST(PageMessages, ShowEachCarAndHead) {
  const Picture picture = picture_of(two_cars());
  EXPECT_EQ(picture.step(), 100);
  ASSERT_EQ(picture.vehicle_size(), 2);
  EXPECT_EQ(picture.vehicle(1), 4U);
  EXPECT_EQ(picture.equipped(), std::string("\1\0", 2));
  EXPECT_EQ(picture.position_m(1), 380.25F);
  EXPECT_TRUE(std::isnan(picture.commanded_mps2(1)));
  EXPECT_EQ(picture.missed(), "\xff\x0b");
  EXPECT_EQ(picture.stood_s(0), 1.5F);
  EXPECT_EQ(picture.advice_age(0), 3);
  EXPECT_EQ(picture.advice_age(1), -1) << "never one";
  EXPECT_EQ(picture.uplink(), std::string("\0\xff", 2));
  EXPECT_EQ(picture.heard_age(0), 2);
  EXPECT_EQ(picture.heard_age(1), -1) << "never";
  EXPECT_EQ(picture.change_in(0), 150);
  EXPECT_EQ(picture.change_in(5), -1) << "not known";
}

TEST(PageMessages, LeaveOutMeansOfNoCar) {
  const Statistics statistics = statistics_of(two_cars());
  EXPECT_EQ(statistics.all().arrived(), 10U);
  EXPECT_EQ(statistics.all().stops_per_vehicle(), 0.2);
  EXPECT_TRUE(statistics.equipped().has_mean_stop_time_s());
  EXPECT_FALSE(statistics.unequipped().has_mean_stop_time_s());
  EXPECT_FALSE(statistics.all().has_mean_delay_s());
  EXPECT_EQ(statistics.equipped_share(), 0.75) << "3 of 4 on the road";
}

TEST(PageMessages, CountTheCommandsThatEachRuleHasChanged) {
  const Statistics statistics = statistics_of(two_cars());
  EXPECT_EQ((std::vector<std::uint32_t>{statistics.overridden().begin(), statistics.overridden().end()}),
            (std::vector<std::uint32_t>{1, 2, 3, 4, 5}));
}

TEST(PageMessages, WithAnIdealRadioEverythingArrivesAtOnce) {
  const Statistics statistics = statistics_of(two_cars());
  EXPECT_EQ(statistics.delivery_ratio_up(), 1.0);
  EXPECT_EQ(statistics.latency_down_ms(), 0.0);
  EXPECT_EQ(statistics.losses_size(), 0);
}

TEST(PageMessages, AddTheKindsOfFramesOfADirection) {
  View view = two_cars();
  view.radio_direction = {0, 1, 1};
  view.radio_kind = {1, 3, 5};
  view.radio_sent = {100, 30, 10};
  view.radio_heard = {90, 20, 10};
  view.radio_lost = {10, 0, 0, 0, 0, 0, 0, /**/ 0, 4, 6, 0, 0, 0, 0, /**/ 0, 0, 0, 0, 0, 0, 0};
  view.radio_latency_ms = {5.0, 30.0, 60.0};
  const Statistics statistics = statistics_of(view);
  EXPECT_DOUBLE_EQ(statistics.delivery_ratio_up(), 0.9);
  EXPECT_DOUBLE_EQ(statistics.delivery_ratio_down(), 0.75) << "10 of 40 lost";
  EXPECT_DOUBLE_EQ(statistics.latency_up_ms(), 5.0);
  EXPECT_DOUBLE_EQ(statistics.latency_down_ms(), 40.0) << "(20 * 30 + 10 * 60) / 30";
  ASSERT_EQ(statistics.losses_size(), 3);
  EXPECT_EQ(statistics.losses(0).direction(), "uplink");
  EXPECT_EQ(statistics.losses(0).cause(), "random");
  EXPECT_EQ(statistics.losses(2).cause(), "range");
  EXPECT_EQ(statistics.losses(2).frames(), 6U);
}

TEST(PaceMeter, MeasuresTheLastSecond) {
  PaceMeter meter;
  EXPECT_EQ(meter.pace(), 0.0);
  // 100 steps a second for 10 s, then 20 a second for 2 s.
  Step step = 0;
  double now_s = 50.0;
  for (int i = 0; i < 200; ++i) meter.note(now_s += 0.05, step += 5);
  EXPECT_NEAR(meter.pace(), 10.0, 0.01);
  for (int i = 0; i < 40; ++i) meter.note(now_s += 0.05, step += 1);
  EXPECT_NEAR(meter.pace(), 2.0, 0.01);
}

TEST(PaceMeter, LooksFurtherBackAtSlowPaces) {
  PaceMeter meter;
  double now_s = 0.0;
  for (Step step = 0; step < 20; ++step) meter.note(now_s += 1.0, step);  // a step a second
  EXPECT_NEAR(meter.pace(), 0.1, 0.001);
}

TEST(PaceMeter, BeginsAnewWithAnotherRun) {
  PaceMeter meter;
  meter.note(0.0, 1000);
  meter.note(1.0, 2000);
  meter.note(2.0, 0);
  EXPECT_EQ(meter.pace(), 0.0);
}

bool alive(const RunStatus& status, const std::string& role) {
  for (const Member& member : status.members()) {
    if (member.role() == role) return member.alive();
  }
  ADD_FAILURE() << "no " << role;
  return false;
}

TEST(RunStatus, SaysWhoIsMissingWhileTheRunForms) {
  const RunStatus status = status_of({.phase = RunPhase::kForming, .text = "recorder rsu1"}, 2, {}, 0.0);
  EXPECT_EQ(status.phase(), "forming");
  EXPECT_EQ(status.members_size(), 6);
  EXPECT_TRUE(alive(status, "clock"));
  EXPECT_TRUE(alive(status, "rsu0"));
  EXPECT_FALSE(alive(status, "rsu1"));
  EXPECT_FALSE(alive(status, "recorder"));
}

TEST(RunStatus, SaysWhichRsuIsSilentAndWhoseLossEndedTheRun) {
  EXPECT_FALSE(alive(status_of({.phase = RunPhase::kRunning, .recorded = 50}, 2, {1, 0}, 0.0), "rsu1"));
  EXPECT_TRUE(alive(status_of({.phase = RunPhase::kRunning, .recorded = 50}, 2, {1, 2}, 0.0), "rsu1"));
  EXPECT_FALSE(
      alive(status_of({.phase = RunPhase::kAborted, .culprit = "traffic-engine"}, 1, {}, 60.0), "traffic-engine"));
}

TEST(RunStatus, SaysThatTheClockIsSilentUnlessTheRunIsOver) {
  const RunStatus silent = status_of({.phase = RunPhase::kRunning}, 1, {}, 4.0);
  EXPECT_FALSE(alive(silent, "clock"));
  EXPECT_EQ(silent.culprit(), "clock");
  EXPECT_TRUE(alive(status_of({.phase = RunPhase::kRunning}, 1, {}, 1.0), "clock"));
  EXPECT_TRUE(alive(status_of({.phase = RunPhase::kEnded}, 1, {}, 100.0), "clock"));
}

}  // namespace
}  // namespace lukou::console
