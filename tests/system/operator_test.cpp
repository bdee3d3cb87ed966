#include <gtest/gtest.h>

#include <csignal>

#include "tests/system/program.hpp"

namespace lukou::test {
namespace {

std::string status(const std::string& run) { return lukou({"ctl", run, "status"}).out; }

TEST(Operator, SessionOfChangesReplaysByteForByte) {
  const TemporaryFolder folder;
  const std::string run = fresh_run_id();
  Program launcher(
      {"run", "paper", "--duration", "300", "--pace", "50", "--quiet", "--run-id", run, "--out", folder / "r"});
  ASSERT_TRUE(wait_for_step(run, 200));
  EXPECT_EQ(lukou({"ctl", run, "set", "traffic.west.flow_veh_per_h=600"}).code, 0);
  EXPECT_EQ(lukou({"ctl", run, "pause"}).code, 0);
  EXPECT_NE(status(run).find(": paused,"), std::string::npos) << status(run);
  EXPECT_EQ(lukou({"ctl", run, "set", "vehicles.equipped_ratio=0.2"}).code, 0);
  EXPECT_EQ(lukou({"ctl", run, "step", "7"}).code, 0);
  EXPECT_EQ(lukou({"ctl", run, "set", "signals.preset=PAPER_YELLOW"}).code, 0);
  EXPECT_EQ(lukou({"ctl", run, "pace", "max"}).code, 0);
  EXPECT_EQ(lukou({"ctl", run, "resume"}).code, 0);
  EXPECT_EQ(launcher.wait(), 0) << launcher.err();
  const std::string directives = content(folder / "r/directives.textproto");
  EXPECT_NE(directives.find("traffic.west.flow_veh_per_h=600"), std::string::npos) << directives;
  EXPECT_NE(directives.find("signals.preset=PAPER_YELLOW"), std::string::npos) << directives;
  for (const std::string mode : {"in-process", "processes"}) {
    const Finished replay = lukou({"run", folder / "r/scenario.textproto", "--mode", mode, "--quiet",
                                   "--replay-directives", folder / "r/directives.textproto", "--out", folder / mode});
    ASSERT_EQ(replay.code, 0) << replay.err;
    EXPECT_EQ(differing_files(folder / "r", folder / mode), std::vector<std::string>{}) << mode;
  }
  // And the session did change something.
  ASSERT_EQ(
      lukou({"run", folder / "r/scenario.textproto", "--mode", "in-process", "--quiet", "--out", folder / "plain"})
          .code,
      0);
  EXPECT_NE(content(folder / "r/road.csv"), content(folder / "plain/road.csv"));
}

TEST(Operator, IsToldWhyARequestIsRefused) {
  const TemporaryFolder folder;
  const std::string run = fresh_run_id();
  Program launcher({"run", "paper", "--duration", "7200", "--wait", "--quiet", "--run-id", run, "--out", folder / "r"});
  Finished answer;
  for (int i = 0; i < 100 && answer.err.find("these can") == std::string::npos; ++i) {
    answer = lukou({"ctl", run, "set", "vehicles.length_m=3"});
  }
  EXPECT_EQ(answer.code, 2);
  EXPECT_NE(answer.err.find("traffic.west.flow_veh_per_h"), std::string::npos) << answer.err;
  const Finished typo = lukou({"ctl", run, "set", "traffic.west.flow_vph=3"});
  EXPECT_EQ(typo.code, 2);
  EXPECT_NE(typo.err.find("did you mean `flow_veh_per_h`"), std::string::npos) << typo.err;
  EXPECT_EQ(lukou({"ctl", run, "dance"}).code, 2);
  EXPECT_EQ(lukou({"ctl", "no-such-run", "pause"}).code, 2);
  EXPECT_EQ(lukou({"ctl", run, "stop"}).code, 0);
  EXPECT_EQ(launcher.wait(20.0), 0) << launcher.err();
}

TEST(Operator, InterruptsWithControlCAndTheResultsAreKeptAndMarked) {
  const TemporaryFolder folder;
  const std::string run = fresh_run_id();
  Program launcher(
      {"run", "paper", "--duration", "7200", "--pace", "20", "--quiet", "--run-id", run, "--out", folder / "r"});
  ASSERT_TRUE(wait_for_step(run, 100));
  launcher.signal(SIGINT);
  EXPECT_EQ(launcher.wait(8.0), 130) << launcher.err();
  EXPECT_LT(seconds_until_gone(run, 5.0), 1.0);
  const Finished inspection = lukou({"inspect", folder / "r"});
  EXPECT_EQ(inspection.code, 0) << inspection.out;
  EXPECT_NE(inspection.out.find("ended by interrupted"), std::string::npos) << inspection.out;
}

TEST(Operator, SeesThePictureWhileTheRunIsPaused) {
  const TemporaryFolder folder;
  const std::string run = fresh_run_id();
  Program launcher(
      {"run", "paper", "--duration", "7200", "--pace", "50", "--quiet", "--run-id", run, "--out", folder / "r"});
  ASSERT_TRUE(wait_for_step(run, 500));
  ASSERT_EQ(lukou({"ctl", run, "pause"}).code, 0);
  std::string seen;
  for (int i = 0; i < 10 && seen.find("cars on the road") == std::string::npos; ++i) seen = status(run);
  EXPECT_NE(seen.find(": paused, "), std::string::npos) << seen;
  EXPECT_NE(seen.find("cars on the road"), std::string::npos) << seen;
  EXPECT_EQ(lukou({"ctl", run, "stop"}).code, 0);
  EXPECT_EQ(launcher.wait(20.0), 0) << launcher.err();

  // A stopped session replays as one, in both modes.
  for (const std::string mode : {"in-process", "processes"}) {
    const Finished replay = lukou({"run", folder / "r/scenario.textproto", "--mode", mode, "--quiet",
                                   "--replay-directives", folder / "r/directives.textproto", "--out", folder / mode});
    ASSERT_EQ(replay.code, 0) << replay.err;
    EXPECT_EQ(differing_files(folder / "r", folder / mode), std::vector<std::string>{}) << mode;
  }
}

TEST(Operator, StopsAtAnAnnouncedTime) {
  const TemporaryFolder folder;
  const std::string run = fresh_run_id();
  Program launcher({"run", "paper", "--duration", "7200", "--wait", "--quiet", "--run-id", run, "--out", folder / "r"});
  for (int i = 0; i < 100 && status(run).find(": paused") == std::string::npos; ++i) continue;
  EXPECT_EQ(lukou({"ctl", run, "stop", "at", "60"}).code, 0);
  EXPECT_EQ(launcher.wait(30.0), 0) << launcher.err();
  const std::string inspection = lukou({"inspect", folder / "r"}).out;
  EXPECT_NE(inspection.find("complete to step 600 (60.0 s) of 72000, ended by stopped"), std::string::npos)
      << inspection;
}

}  // namespace
}  // namespace lukou::test
