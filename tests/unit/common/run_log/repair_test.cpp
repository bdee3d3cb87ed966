#include "common/run_log/repair.hpp"

#include <gtest/gtest.h>

#include "common/run_log/run_log_reader.hpp"
#include "common/run_log/run_log_writer.hpp"
#include "tests/unit/common/results/test_folder.hpp"

namespace lukou::run_log {
namespace {

class RunLogRepair : public results::InTestFolder {
 protected:
  void write_log(Step last, bool with_end) {
    auto log = RunLogWriter::create(folder(), {.level = Level::kEvents});
    ASSERT_TRUE(log);
    for (Step step = 0; step <= last; ++step) {
      TrafficBatch batch;
      batch.step = step;
      batch.arrived = batch.waiting = batch.arrived_equipped = batch.waiting_equipped = {1, 2, 3, 4};
      ASSERT_TRUE(log.value().add({}, nullptr, batch));
    }
    if (with_end) {
      ASSERT_TRUE(log.value().close());
    }
  }
  [[nodiscard]] std::filesystem::path file() const { return folder() / kRunLog; }
};

TEST_F(RunLogRepair, LeavesAWholeLogAlone) {
  write_log(50, true);
  const std::string before = content(kRunLog);
  ASSERT_TRUE(repair(file(), 50));
  EXPECT_EQ(content(kRunLog), before);
}

TEST_F(RunLogRepair, GivesALogThatWasCutOffAnEnd) {
  write_log(50, false);
  append(kRunLog, "torn");
  ASSERT_TRUE(repair(file(), 49));
  auto log = RunLogReader::open(folder());
  ASSERT_TRUE(log) << log.error().text();
  EXPECT_TRUE(log.value().file().finished());
  EXPECT_EQ(log.value().last_step(), 39);
  EXPECT_EQ(log.value().file().index().messages.at(3), 40U);
}

TEST_F(RunLogRepair, TakesBackChunksBeyondTheTables) {
  write_log(99, true);
  ASSERT_TRUE(repair(file(), 65));
  auto log = RunLogReader::open(folder());
  ASSERT_TRUE(log) << log.error().text();
  EXPECT_EQ(log.value().last_step(), 59);
  EXPECT_EQ(log.value().file().index().messages.at(3), 60U);
  log.value().seek(59);
  EXPECT_EQ(log.value().next().value()->step, 59);
}

TEST_F(RunLogRepair, OfARunWithoutAStepIsEmptyButWhole) {
  write_log(10, false);  // the first chunk is open still
  ASSERT_TRUE(repair(file(), 0));
  auto log = RunLogReader::open(folder());
  ASSERT_TRUE(log) << log.error().text();
  EXPECT_EQ(log.value().last_step(), -1);
  EXPECT_EQ(log.value().next().value(), nullptr);
}

TEST_F(RunLogRepair, TakesAwayALogWithoutAHead) {
  write(kRunLog, "\x89MC");
  ASSERT_TRUE(repair(file(), 5));
  EXPECT_FALSE(std::filesystem::exists(file()));
}

}  // namespace
}  // namespace lukou::run_log
