#include "services/lukou/report/car_story.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "common/run_log/run_log_writer.hpp"
#include "common/scenario/scenario.hpp"
#include "tests/unit/common/results/test_folder.hpp"

namespace lukou::report {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// Writes a log in which car 8 drives on WC, 10 m/s, from step 10 on; the test adds what else happens.
class CarStory : public results::InTestFolder {
 protected:
  TrafficBatch& at(Step step) { return steps_[static_cast<std::size_t>(step)]; }

  void SetUp() override {
    for (Step step = 0; step <= 100; ++step) {
      TrafficBatch& batch = steps_.emplace_back();
      batch.step = step;
      batch.arrived = batch.waiting = batch.arrived_equipped = batch.waiting_equipped = {0, 0, 0, 0};
      batch.heard_epoch = {1};
      if (step < 10) continue;
      batch.vehicle = {8}, batch.lane = {1}, batch.state = {0}, batch.equipped = {1};
      batch.position_m = {static_cast<double>(step - 10)}, batch.speed_mps = {10.0};
      batch.acceleration_mps2 = {0.0}, batch.commanded_mps2 = {kNone}, batch.noise_mps2 = {0.0};
      batch.guidance = {1}, batch.bound_by = {0}, batch.missed = {kNothingMissed};
    }
    TrafficBatch& entry = at(10);
    entry.entered_vehicle = {8}, entry.entered_lane = {1}, entry.entered_equipped = {1};
    entry.entered_speed_mps = {10.0}, entry.entered_desired_speed_mps = {15.0};
  }
  void told(Step step, AdviceFate fate, double value, bool again = false) {
    TrafficBatch& batch = at(step);
    batch.fate_vehicle.push_back(8), batch.fate_rsu.push_back(0), batch.fate_sequence.push_back(1);
    batch.fate.push_back(static_cast<std::uint8_t>(fate)), batch.fate_again.push_back(again ? 1 : 0);
    batch.fate_issued.push_back(step - 1), batch.fate_commanded_mps2.push_back(value);
    batch.fate_kind.push_back(0), batch.fate_speed_mps.push_back(kNone);
  }
  void heard(Step sent, std::uint8_t fate, double latency_ms) {
    TrafficBatch& batch = at(sent + 1);
    batch.reception.add(Direction::kUplink, FrameKind::kBsm, {});
    batch.uplink_vehicle = {8}, batch.uplink_rsu = {0};
    batch.uplink.fate = {fate}, batch.uplink.due = {fate == 0 ? sent : -1}, batch.uplink.latency_ms = {latency_ms};
  }
  /// "from-to kind: text" of each line.
  std::vector<std::string> story(std::uint32_t vehicle = 8) {
    const auto scenario = scenario::load("paper");
    auto log = run_log::RunLogWriter::create(
        folder(), {.level = run_log::Level::kFull, .scenario = scenario::text(scenario.value())});
    for (const TrafficBatch& batch : steps_) EXPECT_TRUE(log.value().add({}, nullptr, batch));
    EXPECT_TRUE(log.value().close());
    const auto lines = car_story(folder(), vehicle);
    if (!lines) return {lines.error().text()};
    std::vector<std::string> texts;
    for (const StoryLine& line : lines.value()) {
      texts.push_back(std::to_string(line.from) + "-" + std::to_string(line.to) + " " + line.kind + ": " + line.text);
    }
    return texts;
  }

 private:
  std::vector<TrafficBatch> steps_;
};

using Lines = std::vector<std::string>;

TEST_F(CarStory, TellsWhatDecidedItsMotionInStretches) {
  for (Step step = 40; step < 60; ++step) at(step).bound_by = {1};
  at(70).bound_by = {5};  // a moment is no stretch of its own
  EXPECT_EQ(story(), (Lines{"10-10 entered: enters WC at 36 km/h, would like 54 km/h, with an on-board unit",
                            "10-39 drives: drives as it likes: 36 km/h to 36 km/h, 500 m before the line to 471 m "
                            "before the line",
                            "40-59 drives: follows the car ahead: 36 km/h to 36 km/h, 470 m before the line to 451 m "
                            "before the line",
                            "60-100 drives: drives as it likes: 36 km/h to 36 km/h, 450 m before the line to 410 m "
                            "before the line"}));
}

TEST_F(CarStory, TellsWhichMessagesTheRoadsideHeard) {
  for (Step sent = 10; sent < 20; ++sent) heard(sent, 0, 30.0);
  for (Step sent = 20; sent < 24; ++sent) heard(sent, 2, kNone);
  heard(24, 0, 50.0);
  const Lines lines = story();
  ASSERT_EQ(lines.size(), 4U);
  EXPECT_EQ(lines[2], "10-24 sent: 15 messages to the roadside, rsu0 hears 11, after 31.82 ms on average");
  EXPECT_EQ(lines[3], "20-23 missed: rsu0 does not hear it: 4 messages in a row, burst");
}

TEST_F(CarStory, TellsWhatItWasToldAndWhatDidNotReachIt) {
  for (Step step = 30; step < 40; ++step) told(step, AdviceFate::kApplied, -0.5);
  told(33, AdviceFate::kChangedRed, -0.5, true);  // one of them, later
  told(40, AdviceFate::kLostRandom, -0.6);        // a single one lost
  told(41, AdviceFate::kApplied, -0.7);
  for (Step step = 42; step < 47; ++step) told(step, AdviceFate::kLostBurst, -0.8);
  told(47, AdviceFate::kApplied, 0.2);
  const Lines lines = story();
  ASSERT_EQ(lines.size(), 5U);
  EXPECT_EQ(lines[2],
            "30-41 told: by rsu0: -0.70 m/s2 ... -0.50 m/s2, 12 words: 10 applied, 1 changed_red, 1 lost_random");
  EXPECT_EQ(lines[3], "42-46 missed: does not hear rsu0: 5 words: 5 lost_burst");
  EXPECT_EQ(lines[4], "47-47 told: by rsu0: 0.20 m/s2, 1 word: 1 applied");
}

TEST_F(CarStory, TellsStopsWithTheirCauseAndTheCrossing) {
  write("stops.csv",
        "step,time_s,vehicle,lane,equipped,began_step,began_s,distance_m,stood_s,cause,guidance,missed\n"
        "60,6.0,8,WC,1,50,5.0,0.4,1.0,lost_burst,expired,lost_burst\n"
        "70,7.0,9,WC,1,60,6.0,5.9,1.0,queue_ahead,in_force,\n");
  at(80).crossed_vehicle = {8}, at(80).crossed_time_s = {7.96};
  at(80).crossed_aspect = {static_cast<std::uint8_t>(Aspect::kGreen)}, at(80).crossed_committed = {0};
  at(95).left_vehicle = {8}, at(95).left_time_s = {9.48};
  const Lines lines = story();
  ASSERT_EQ(lines.size(), 5U);
  EXPECT_EQ(lines[2],
            "50-60 stopped: stops 0 m before the line and stands 1.0 s: lost_burst (guidance: expired, missed: "
            "lost_burst)");
  EXPECT_EQ(lines[3], "80-80 crossed: crosses the stop line at 7.96 s on green");
  EXPECT_EQ(lines[4], "95-95 left: leaves the end of its exit at 9.48 s");
}

TEST_F(CarStory, SaysThatACarWasNotThere) {
  EXPECT_EQ(story(12), (Lines{"--vehicle 12: did not come onto the road in this run"}));
}

}  // namespace
}  // namespace lukou::report
