#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <fstream>
#include <nlohmann/json.hpp>
#include <thread>

#include "tests/system/program.hpp"

namespace lukou::test {
namespace {

using nlohmann::json;

/// A Python RSU that advises every car in every step, and sleeps for 0.13 s in every 50th.
std::string sleeper(const TemporaryFolder& folder) {
  std::ofstream(folder / "sleeper.py") << "import sys, time\nimport lukou\n\n"
                                          "class Sleeper(lukou.RsuAlgorithm):\n"
                                          "    def __init__(self, setup):\n        super().__init__()\n"
                                          "    def on_step(self, heard, answer):\n"
                                          "        if heard.step % 50 == 10:\n            time.sleep(0.13)\n"
                                          "        for car in heard.cars.id:\n"
                                          "            answer.advise(int(car), -0.1 * (heard.step % 7), 0.5, "
                                          "lukou.Binding.FOLLOWING)\n\n"
                                          "sys.exit(lukou.run_rsu(Sleeper))\n";
  return "/usr/bin/python3 " + (folder / "sleeper.py").string();
}

/// With the Python module of this build, wherever it lies.
Finished with_python(const std::vector<std::string>& arguments) {
  Program program(arguments, {"PYTHONPATH=" LUKOU_BUILD "/python"});
  const int code = program.wait();
  return {code, program.out(), program.err()};
}

TEST(ComputingTime, ThatIsMeasuredIsRecordedAndReplaysByteForByte) {
  const TemporaryFolder folder;
  const std::vector<std::string> common = {
      "run",   "paper",         "--quiet",    "--duration", "60",   "--set", "record.guidance=true",
      "--rsu", sleeper(folder), "--rsu-time", "real",       "--out"};
  auto first = common;
  first.emplace_back(folder / "first");
  const Finished run = with_python(first);
  ASSERT_EQ(run.code, 0) << run.err;
  // Of the steps 0 ... 599, whose answers are heard, twelve sleep; a busy computer may add to them.
  EXPECT_GE(json::parse(content(folder / "first" / "summary.json")).at("rsu_deadline_misses").get<int>(), 12);
  const std::string guidance = content(folder / "first" / "guidance.csv");
  EXPECT_NE(guidance.find("\n11,1.1,10,1.0,0,,,,,deadline_missed,0.1"), std::string::npos);
  EXPECT_NE(run.err.find("steps took an RSU longer than 0.1 s"), std::string::npos) << run.err;
  EXPECT_NE(content(folder / "first" / "directives.textproto").find("computed {"), std::string::npos);

  auto again = common;
  again.insert(again.end(), {(folder / "again").string(), "--replay-directives",
                             (folder / "first" / "directives.textproto").string()});
  const Finished replay = with_python(again);
  ASSERT_EQ(replay.code, 0) << replay.err;
  EXPECT_EQ(differing_files(folder / "first", folder / "again"), std::vector<std::string>{});
}

TEST(ComputingTime, ThatIsDeclaredGivesTheSameBytesInEveryModeAndDelaysTheGuidance) {
  const TemporaryFolder folder;
  const auto run = [&](const std::string& out, const std::string& time, const std::string& mode) {
    return lukou(
        {"run", "paper", "--quiet", "--duration", "120", "--rsu-time", time, "--mode", mode, "--out", folder / out});
  };
  ASSERT_EQ(run("one", "declared:300ms", "in-process").code, 0);
  ASSERT_EQ(run("two", "declared:300ms", "processes").code, 0);
  ASSERT_EQ(run("free", "free", "in-process").code, 0);
  EXPECT_EQ(differing_files(folder / "one", folder / "two"), std::vector<std::string>{});
  EXPECT_NE(content(folder / "one" / "car.csv"), content(folder / "free" / "car.csv"));
  EXPECT_EQ(content(folder / "one" / "directives.textproto"), "");
}

TEST(ComputingTime, WithoutEndEndsWithTheRun) {
  const TemporaryFolder folder;
  std::ofstream(folder / "endless.py") << "import sys\nimport lukou\n\n"
                                          "class Endless(lukou.RsuAlgorithm):\n"
                                          "    def __init__(self, setup):\n        super().__init__()\n"
                                          "    def on_step(self, heard, answer):\n"
                                          "        while heard.step >= 20:\n            pass\n\n"
                                          "sys.exit(lukou.run_rsu(Endless))\n";
  const std::string rsu = "/usr/bin/python3 " + (folder / "endless.py").string();
  const auto start = [&](const std::string& run, const std::string& out) {
    return std::make_unique<Program>(
        std::vector<std::string>{"run", "paper", "--quiet", "--duration", "60", "--rsu", rsu, "--run-id", run,
                                 "--stall-limit", "3", "--out", folder / out},
        std::vector<std::string>{"PYTHONPATH=" LUKOU_BUILD "/python"});
  };
  const std::string stalled = fresh_run_id();
  const std::string orphaned = fresh_run_id();
  const auto watched = start(stalled, "stalled");
  const auto killed = start(orphaned, "orphaned");
  for (int i = 0; i < 200 && content(folder / "orphaned" / "road.csv").find("\n19,") == std::string::npos; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  killed->signal(SIGKILL);
  EXPECT_EQ(watched->wait(30.0), 3);
  EXPECT_NE(watched->err().find("aborted: rsu0 has not finished step 20"), std::string::npos) << watched->err();
  EXPECT_EQ(processes_of(stalled).size(), 0U);

  // Nobody was left to kill the other one.
  EXPECT_LT(seconds_until_gone(orphaned, 20.0), 13.0);
}

TEST(ComputingTime, ThatIsMeasuredCannotBeVerifiedOrReplayedWithoutIt) {
  const Finished verified = lukou({"verify", "paper", "--duration", "10", "--rsu-time", "real"});
  EXPECT_EQ(verified.code, 2);
  EXPECT_NE(verified.err.find("rsus[].computing.mode: is REAL"), std::string::npos) << verified.err;
  const TemporaryFolder folder;
  std::ofstream(folder / "log.textproto") << "computed { rsu: 0 step: 5 delay_ms: 3 }\n";
  const Finished free = lukou({"run", "paper", "--duration", "10", "--quiet", "--replay-directives",
                               (folder / "log.textproto").string(), "--out", folder / "out"});
  EXPECT_EQ(free.code, 2);
  EXPECT_NE(free.err.find("holds measured computing times of RSU 0"), std::string::npos) << free.err;
}

}  // namespace
}  // namespace lukou::test
