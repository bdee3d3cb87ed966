#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "common/run_log/run_log_reader.hpp"
#include "common/run_log/run_log_writer.hpp"
#include "tests/unit/common/bus/members.hpp"
#include "tests/unit/common/results/test_folder.hpp"

namespace lukou::run_log {
namespace {

/// Gives the columns of a group one length, and every entry a value of its own.
class Columns {
 public:
  template <class... Column>
  void fill(std::size_t length, Column&... columns) {
    (one(length, columns), ...);
  }

 private:
  template <class T>
  void one(std::size_t length, std::vector<T>& column) {
    column.resize(length);
    for (T& value : column) value = static_cast<T>(++next_ % 250);
  }
  int next_ = 0;
};

void fill_frames(Columns& columns, Frames& frames) {
  columns.fill(2, frames.sender, frames.sequence, frames.kind, frames.wire_bytes, frames.antenna_x_m,
               frames.antenna_y_m);
  frames.payload_end = {1, 3};
  columns.fill(3, frames.payload);
}

/// A step in which everything happens.
TrafficBatch busy(Step step) {
  Columns columns;
  TrafficBatch b;
  b.step = step;
  columns.fill(3, b.vehicle, b.lane, b.state, b.equipped, b.position_m, b.speed_mps, b.acceleration_mps2,
               b.commanded_mps2, b.noise_mps2, b.guidance, b.bound_by, b.missed);
  columns.fill(4, b.arrived, b.waiting, b.arrived_equipped, b.waiting_equipped);
  columns.fill(1, b.entered_vehicle, b.entered_lane, b.entered_equipped, b.entered_speed_mps,
               b.entered_desired_speed_mps);
  columns.fill(2, b.crossed_vehicle, b.crossed_time_s, b.crossed_aspect, b.crossed_committed);
  columns.fill(3, b.left_vehicle, b.left_time_s);
  columns.fill(2, b.fate_vehicle, b.fate_rsu, b.fate_sequence, b.fate, b.fate_again, b.fate_issued,
               b.fate_commanded_mps2, b.fate_kind, b.fate_speed_mps);
  columns.fill(2, b.heard_epoch, b.computing_ms);
  b.answers_malformed = 3, b.requests_refused = 4, b.guard_interventions = 5, b.overflow = 1;
  ReceptionReport& r = b.reception;
  columns.fill(2, r.direction, r.kind, r.sent, r.lost_random, r.lost_burst, r.lost_range, r.duplicates,
               r.lost_path_loss, r.lost_collision, r.lost_half_duplex, r.lost_outage, r.busy_ratio);
  r.heard = {2, 1};
  columns.fill(3, r.latency_ms);
  columns.fill(2, b.uplink_vehicle, b.uplink_rsu, b.uplink.due, b.uplink.latency_ms);
  b.uplink.fate = {0, 7};
  fill_frames(columns, b.air);
  SensedColumns& s = b.sensed;
  columns.fill(2, s.rsu, s.sensor, s.track, s.x_m, s.y_m, s.speed_mps, s.heading_rad, s.length_class, s.measured);
  fill_frames(columns, b.said);
  columns.fill(2, b.said_rsu);
  columns.fill(1, b.asked_rsu, b.asked_lanes, b.asked_lifetime);
  return b;
}

SignalBatch batch_of_heads(Step step) {
  Columns columns;
  SignalBatch b;
  b.step = step;
  b.first = step + 6;
  columns.fill(24, b.heads);
  columns.fill(3, b.change_lane, b.change_aspect, b.change_step);
  columns.fill(2, b.request_step, b.request_asked, b.request_rsu, b.request_lanes, b.request_outcome);
  return b;
}

class RunLog : public results::InTestFolder {
 protected:
  /// Steps 0 ... `last`, a batch of heads each fifth, a change of the operator's in step 7.
  void write_log(Level level, Step last = 99, bool with_end = true) {
    std::filesystem::remove(folder() / kRunLog);
    auto created = RunLogWriter::create(
        folder(),
        {.level = level, .lukou_version = "9.9", .scenario = "run {}", .scenario_hash = "abc", .steps_planned = 100});
    ASSERT_TRUE(created) << created.error().text();
    RunLogWriter& log = created.value();
    for (Step step = 0; step <= last; ++step) {
      std::vector<Directive> changes;
      if (step == 7) changes = {{7, "vehicles.equipped_ratio=0.5"}};
      const SignalBatch heads = batch_of_heads(step);
      ASSERT_TRUE(log.add(changes, step % 5 == 0 ? &heads : nullptr, busy(step)));
    }
    if (with_end) {
      ASSERT_TRUE(log.close());
    }
  }
  RunLogReader open() {
    auto log = RunLogReader::open(folder());
    EXPECT_TRUE(log) << log.error().text();
    return std::move(log).value();
  }
};

TEST_F(RunLog, AtFullGivesBackEveryStepWhole) {
  write_log(Level::kFull);
  RunLogReader log = open();
  EXPECT_EQ(log.facts().level, Level::kFull);
  EXPECT_EQ(log.facts().scenario, "run {}");
  EXPECT_EQ(log.facts().lukou_version, "9.9");
  EXPECT_EQ(log.facts().steps_planned, 100);
  EXPECT_EQ(log.last_step(), 99);
  for (Step step = 0; step < 100; ++step) {
    const auto next = log.next();
    ASSERT_TRUE(next) << next.error().text();
    ASSERT_NE(next.value(), nullptr);
    LoggedStep found = *next.value();
    TrafficBatch expected = busy(step);
    EXPECT_EQ(members(found.traffic), members(expected)) << step;
    ASSERT_EQ(found.signal.has_value(), step % 5 == 0) << step;
    SignalBatch heads = batch_of_heads(step);
    if (found.signal) {
      EXPECT_EQ(members(*found.signal), members(heads));
    }
    EXPECT_EQ(found.directives.size(), step == 7 ? 1U : 0U);
  }
  EXPECT_EQ(log.next().value(), nullptr);
}

TEST_F(RunLog, HoldsLessAtLowerLevels) {
  write_log(Level::kSecond);
  RunLogReader seconds = open();
  for (Step step = 0; step < 100; ++step) {
    LoggedStep* found = seconds.next().value();
    EXPECT_EQ(found->cars, step % 10 == 0) << step;
    EXPECT_EQ(found->traffic.crossed_vehicle, busy(step).crossed_vehicle);
    EXPECT_EQ(found->traffic.air.size(), 0U);
  }
  write_log(Level::kEvents);
  RunLogReader events = open();
  for (Step step = 0; step < 100; ++step) EXPECT_FALSE(events.next().value()->cars);
}

TEST_F(RunLog, BeginsAtAnyStep) {
  write_log(Level::kFull);
  RunLogReader log = open();
  for (const Step step : {0, 1, 19, 20, 57, 99, 3}) {
    log.seek(step);
    EXPECT_EQ(log.next().value()->step, step);
    LoggedStep* after = log.next().value();
    EXPECT_EQ(after == nullptr ? 100 : after->step, step + 1);
  }
  log.seek(100);
  EXPECT_EQ(log.next().value(), nullptr);
}

TEST_F(RunLog, GoesOnWhereItWasWhenItIsMoved) {
  write_log(Level::kFull);
  RunLogReader log = open();
  log.seek(33);
  EXPECT_EQ(log.next().value()->step, 33);
  RunLogReader moved(std::move(log));
  EXPECT_EQ(moved.next().value()->step, 34);
  moved = open();
  EXPECT_EQ(moved.next().value()->step, 0);
}

TEST_F(RunLog, OfARecorderThatWasKilledGoesToItsLastWholeChunk) {
  write_log(Level::kFull, 57, false);
  RunLogReader log = open();
  EXPECT_FALSE(log.file().finished());
  EXPECT_EQ(log.last_step(), 39) << "chunks of 20 steps";
  log.seek(39);
  EXPECT_EQ(log.next().value()->step, 39);
  EXPECT_EQ(log.next().value(), nullptr);
}

TEST_F(RunLog, CutAtFiftyPlacesGivesEveryWholeChunk) {
  write_log(Level::kFull);
  const std::string whole = content(kRunLog);
  const McapIndex index = open().file().index();
  std::filesystem::create_directory(folder() / "cut");
  for (std::size_t i = 0; i < 50; ++i) {
    // Spread over the file by the golden ratio, so that no rhythm of the records is hit alone.
    const auto size = index.chunks.front().offset + (i * 618'033U) % (whole.size() - index.chunks.front().offset);
    write("cut/run.mcap", whole.substr(0, size));
    auto log = RunLogReader::open(folder() / "cut");
    ASSERT_TRUE(log) << log.error().text();
    Step expected = 0;
    for (const ChunkIndex& chunk : index.chunks) {
      if (chunk.offset + chunk.length <= size) expected = static_cast<Step>(chunk.last_ns / kStep_ns) + 1;
    }
    Step steps = 0;
    while (true) {
      const auto next = log.value().next();
      ASSERT_TRUE(next) << next.error().text();
      if (next.value() == nullptr) break;
      EXPECT_EQ(next.value()->step, steps++);
    }
    EXPECT_EQ(steps, expected) << size;
  }
}

TEST_F(RunLog, SaysThatThereIsNone) {
  const auto log = RunLogReader::open(folder());
  ASSERT_FALSE(log);
  EXPECT_EQ(log.error().text(), (folder() / kRunLog).string() + ": cannot be read: No such file or directory");
}

TEST_F(RunLog, RefusesTheLogOfSomebodyElse) {
  auto file = McapWriter::create(folder() / kRunLog, "another");
  file.value().add_channel("/tf", "a.Type", "");
  ASSERT_TRUE(file.value().close());
  EXPECT_EQ(RunLogReader::open(folder()).error().what, "is no run log of Lukou: it has no metadata `lukou`");
}

}  // namespace
}  // namespace lukou::run_log
