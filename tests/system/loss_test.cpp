#include <gtest/gtest.h>

#include <csignal>

#include "tests/system/program.hpp"

namespace lukou::test {
namespace {

/// A run that would take minutes, at 20 times real time so that steps go on while a test acts.
Program long_run(const std::string& run, const std::string& out, std::vector<std::string> more = {}) {
  std::vector<std::string> arguments = {"run",     "paper",    "--duration", "7200",  "--pace", "20",
                                        "--quiet", "--run-id", run,          "--out", out};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return Program(arguments);
}

struct Victim {
  const char* program;
  const char* role;
};

class LossOf : public testing::TestWithParam<Victim> {};

TEST_P(LossOf, AProcessEndsTheRunWithinSixSecondsAndNamesIt) {
  const TemporaryFolder folder;
  const std::string run = fresh_run_id();
  Program launcher = long_run(run, folder / "r");
  ASSERT_TRUE(wait_for_step(run, 100));
  const auto processes = processes_of(run);
  ASSERT_TRUE(processes.contains(GetParam().program));
  kill(processes.at(GetParam().program), SIGKILL);
  EXPECT_LT(seconds_until_gone(run, 10.0), 6.0);
  EXPECT_EQ(launcher.wait(10.0), 3);
  EXPECT_NE(launcher.err().find(std::string("aborted: ") + GetParam().role), std::string::npos) << launcher.err();

  const Finished inspection = lukou({"inspect", folder / "r"});
  EXPECT_EQ(inspection.code, 0) << inspection.out;
  EXPECT_NE(inspection.out.find(std::string("ended by lost:") + GetParam().role), std::string::npos) << inspection.out;
  const auto at = inspection.out.find("complete to step ");
  ASSERT_NE(at, std::string::npos);
  EXPECT_GE(std::atoll(inspection.out.c_str() + at + 17),
            80);  // 100 were recorded; a second may be lost with the recorder
}

INSTANTIATE_TEST_SUITE_P(EveryRole, LossOf,
                         testing::Values(Victim{"lukou-clock", "clock"},
                                         Victim{"lukou-traffic-engine", "traffic-engine"},
                                         Victim{"lukou-signal-controller", "signal-controller"},
                                         Victim{"lukou-rsu", "rsu0"}, Victim{"lukou-recorder", "recorder"}),
                         [](const auto& victim) {
                           std::string name = victim.param.role;
                           std::erase(name, '-');
                           return name;
                         });

TEST(Loss, OfTheLauncherLeavesNoOrphanAndASoundFolder) {
  const TemporaryFolder folder;
  const std::string run = fresh_run_id();
  Program launcher = long_run(run, folder / "r");
  ASSERT_TRUE(wait_for_step(run, 100));
  launcher.signal(SIGKILL);
  EXPECT_LT(seconds_until_gone(run, 10.0), 6.0);
  const Finished inspection = lukou({"inspect", folder / "r"});
  EXPECT_EQ(inspection.code, 0) << inspection.out;
  EXPECT_NE(inspection.out.find("ended by lost:lukou"), std::string::npos) << inspection.out;
}

TEST(Loss, OfAStoppedProcessIsNoticedToo) {
  const TemporaryFolder folder;
  const std::string run = fresh_run_id();
  Program launcher = long_run(run, folder / "r");
  ASSERT_TRUE(wait_for_step(run, 50));
  kill(processes_of(run).at("lukou-rsu"), SIGSTOP);
  EXPECT_EQ(launcher.wait(12.0), 3);
  EXPECT_NE(launcher.err().find("aborted: rsu0"), std::string::npos) << launcher.err();
  EXPECT_LT(seconds_until_gone(run, 5.0), 5.0);
}

TEST(Loss, OfAnRsuIsSurvivedWhereTheScenarioSaysSoAndTheRecordReplaysIt) {
  const TemporaryFolder folder;
  const std::string run = fresh_run_id();
  Program launcher =
      long_run(run, folder / "r", {"--set", "run.on_rsu_loss=CONTINUE", "--set", "radio.preset=PC5_MODE4"});
  ASSERT_TRUE(wait_for_step(run, 400));
  const auto processes = processes_of(run);
  const pid_t first = processes.at("lukou-rsu");
  const std::string program = std::filesystem::path(LUKOU_PROGRAM).parent_path() / "lukou-rsu";
  const Finished listed = lukou({"ctl", "list"});
  const auto at = listed.out.find(run + " domain ");
  ASSERT_NE(at, std::string::npos);
  const std::string domain = std::to_string(std::atoi(listed.out.c_str() + at + run.size() + 8));
  kill(first, SIGKILL);
  ASSERT_TRUE(wait_for_step(run, 700));
  Program second({}, {"LUKOU_RUN=" + run, "LUKOU_DOMAIN=" + domain}, program);
  ASSERT_TRUE(wait_for_step(run, 1200));
  ASSERT_EQ(lukou({"ctl", run, "stop"}).code, 0);
  EXPECT_EQ(launcher.wait(20.0), 0) << launcher.err();
  EXPECT_EQ(second.wait(5.0), 0) << second.err();

  const std::string directives = content(folder / "r/directives.textproto");
  EXPECT_NE(directives.find("epoch: 0"), std::string::npos) << directives;
  EXPECT_NE(directives.find("epoch: 2"), std::string::npos) << directives;
  const Finished replay = lukou({"run", folder / "r/scenario.textproto", "--mode", "in-process", "--quiet",
                                 "--replay-directives", folder / "r/directives.textproto", "--out", folder / "again"});
  ASSERT_EQ(replay.code, 0) << replay.err;
  EXPECT_EQ(differing_files(folder / "r", folder / "again"), std::vector<std::string>{});
  // Only one process can take back a loss; several say so instead of giving other bytes.
  EXPECT_EQ(lukou({"run", folder / "r/scenario.textproto", "--quiet", "--replay-directives",
                   folder / "r/directives.textproto", "--out", folder / "refused"})
                .code,
            2);
}

}  // namespace
}  // namespace lukou::test
