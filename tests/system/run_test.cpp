#include <gtest/gtest.h>

#include <algorithm>

#include "tests/system/program.hpp"

namespace lukou::test {
namespace {

using ::testing::Test;

long rows(const std::filesystem::path& table) {
  const std::string text = content(table);
  return std::count(text.begin(), text.end(), '\n') - 1;
}

TEST(Run, GivesTheSameBytesAsProcessesAndInOneProcess) {
  const TemporaryFolder folder;
  ASSERT_EQ(lukou({"run", "paper", "--duration", "120", "--quiet", "--out", folder / "bus"}).code, 0);
  ASSERT_EQ(
      lukou({"run", "paper", "--duration", "120", "--quiet", "--mode", "in-process", "--out", folder / "alone"}).code,
      0);
  EXPECT_EQ(differing_files(folder / "bus", folder / "alone"), std::vector<std::string>{});
  EXPECT_EQ(rows(folder / "bus/stop.csv"), 1200);  // a row per step, ten steps a second
  EXPECT_EQ(rows(folder / "bus/road.csv"), 1200);
  EXPECT_EQ(rows(folder / "bus/stop_time.csv"), 1200);
  EXPECT_GT(rows(folder / "bus/car.csv"), 50);  // 4 x 1800 veh/h over the first seconds that allow to cross 600 m
}

TEST(Run, DependsOnTheSeed) {
  const TemporaryFolder folder;
  for (const std::string seed : {"1", "2"}) {
    ASSERT_EQ(lukou({"run", "paper", "--duration", "60", "--seed", seed, "--quiet", "--mode", "in-process", "--out",
                     folder / seed})
                  .code,
              0);
  }
  EXPECT_NE(content(folder / "1/road.csv"), content(folder / "2/road.csv"));
}

TEST(Run, TakesAPlanWrittenOutByTheUserAndSeveralRsus) {
  const TemporaryFolder folder;
  const std::vector<std::string> arguments = {
      "run",
      "paper",
      "--duration",
      "60",
      "--quiet",
      "--set",
      "rsus[0].algorithm=none",
      "--set",
      "signals.plan={cycle_s: 60 lane_plans {lanes: [\"WL\",\"WC\",\"WR\",\"EL\",\"EC\",\"ER\"] aspects {aspect: GREEN "
      "duration_s: 25} aspects {aspect: YELLOW duration_s: 3} aspects {aspect: RED duration_s: 32}} lane_plans {lanes: "
      "[\"SL\",\"SC\",\"SR\",\"NL\",\"NC\",\"NR\"] aspects {aspect: RED duration_s: 30} aspects {aspect: GREEN "
      "duration_s: 25} "
      "aspects {aspect: YELLOW duration_s: 3} aspects {aspect: RED duration_s: 2}}}"};
  auto bus = arguments;
  bus.insert(bus.end(), {"--out", folder / "bus"});
  auto alone = arguments;
  alone.insert(alone.end(), {"--mode", "in-process", "--out", folder / "alone"});
  const Finished run = lukou(bus);
  ASSERT_EQ(run.code, 0) << run.err;
  ASSERT_EQ(lukou(alone).code, 0);
  EXPECT_EQ(differing_files(folder / "bus", folder / "alone"), std::vector<std::string>{});
}

TEST(Run, EndsAtAnOverflowWithCodeFourAndKeepsTheTables) {
  const TemporaryFolder folder;
  const std::vector<std::string> saturated = {"run",
                                              "paper",
                                              "--duration",
                                              "1200",
                                              "--quiet",
                                              "--set",
                                              "traffic.west.flow_veh_per_h=3600",
                                              "--set",
                                              "traffic.approach_length_m=200",
                                              "--set",
                                              "rsus[0].algorithm=none"};
  auto stop = saturated;
  stop.insert(stop.end(), {"--out", folder / "stop"});
  EXPECT_EQ(lukou(stop).code, 4);
  const Finished inspection = lukou({"inspect", folder / "stop"});
  EXPECT_EQ(inspection.code, 0) << inspection.out;
  EXPECT_NE(inspection.out.find("ended by anomaly:overflow"), std::string::npos) << inspection.out;
  EXPECT_GT(rows(folder / "stop/road.csv"), 600);  // no car can have waited for 60 s before step 600

  // The same step in one process.
  auto alone = saturated;
  alone.insert(alone.end(), {"--mode", "in-process", "--out", folder / "alone"});
  EXPECT_EQ(lukou(alone).code, 4);
  EXPECT_EQ(differing_files(folder / "stop", folder / "alone"), std::vector<std::string>{});

  auto on = saturated;
  on.insert(on.end(), {"--set", "run.on_overflow=CONTINUE", "--mode", "in-process", "--out", folder / "on"});
  EXPECT_EQ(lukou(on).code, 0);
  EXPECT_EQ(rows(folder / "on/road.csv"), 12000);
}

TEST(Run, KeepsThePaceThatIsAsked) {
  const TemporaryFolder folder;
  const Finished run =
      lukou({"run", "paper", "--duration", "30", "--pace", "10", "--quiet", "--json", "--out", folder / "r"});
  ASSERT_EQ(run.code, 0);
  const auto at = run.out.find("\"real_time_factor\":");
  ASSERT_NE(at, std::string::npos);
  // 30 s at 10x take 3 s; a busy machine may be slower, never faster (half a step of 0.02 s ticks allowed).
  EXPECT_LE(std::atof(run.out.c_str() + at + 19), 10.3);
}

}  // namespace
}  // namespace lukou::test
