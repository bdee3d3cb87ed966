#include <gtest/gtest.h>

#include <csignal>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "common/run_log/run_log_reader.hpp"
#include "tests/system/program.hpp"

namespace lukou::test {
namespace {

using Json = nlohmann::json;

const std::string kShippedRsu = std::filesystem::path(LUKOU_PROGRAM).parent_path() / "lukou-rsu";

/// A recorded run of two minutes in `folder`/`name`.
std::string recorded_run(const TemporaryFolder& folder, const std::vector<std::string>& more = {},
                         const std::string& name = "r") {
  std::vector<std::string> arguments = {"run", "paper", "--mode",      "in-process", "--quiet",        "--duration",
                                        "120", "--out", folder / name, "--set",      "record.log=FULL"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  EXPECT_EQ(lukou(arguments).code, 0);
  return folder / name;
}

TEST(RunLogOfARun, OfAKilledRecorderIsWholeUpToTheLastSecondsOfTheTables) {
  const TemporaryFolder folder;
  const std::string run = fresh_run_id();
  Program launcher({"run", "paper", "--duration", "7200", "--pace", "50", "--quiet", "--run-id", run, "--out",
                    folder / "r", "--set", "record.log=FULL"});
  ASSERT_TRUE(wait_for_step(run, 400));
  kill(processes_of(run).at("lukou-recorder"), SIGKILL);
  EXPECT_EQ(launcher.wait(20.0), 3);
  const Finished inspection = lukou({"inspect", folder / "r"});
  EXPECT_EQ(inspection.code, 0) << inspection.out;
  const Step tables = std::atoll(inspection.out.c_str() + std::string("complete to step ").size());
  auto log = run_log::RunLogReader::open(folder / "r");
  ASSERT_TRUE(log) << log.error().text();
  EXPECT_TRUE(log.value().file().finished());
  EXPECT_LE(log.value().last_step(), tables);
  EXPECT_GE(log.value().last_step(), tables - run_log::kChunkSteps);
}

TEST(Redrive, OfTheSameBuildFindsNoDifference) {
  const TemporaryFolder folder;
  const std::string result = recorded_run(folder, {"--set", "radio.preset=PC5_MODE4"});
  const Finished inside = lukou({"redrive", result, "--quiet", "--json"});
  EXPECT_EQ(inside.code, 0) << inside.err;
  EXPECT_EQ(Json::parse(inside.out)["steps"], 1200) << "the answers of the last step are heard by nobody";
  const Finished process = lukou({"redrive", result, "--quiet", "--json", "--rsu", kShippedRsu});
  EXPECT_EQ(process.code, 0) << process.err;
  EXPECT_EQ(process.out, inside.out);
}

TEST(Redrive, OfAnRsuThatCommandsTheLightsComparesItsRequestsToo) {
  const TemporaryFolder folder;
  EXPECT_EQ(lukou({"run", "actuated", "--mode", "in-process", "--quiet", "--duration", "120", "--out", folder / "r",
                   "--set", "record.log=FULL"})
                .code,
            0);
  EXPECT_EQ(lukou({"redrive", folder / "r", "--quiet", "--rsu", kShippedRsu}).code, 0);
  const Finished other =
      lukou({"redrive", folder / "r", "--quiet", "--json", "--set", "rsus[0].max_pressure.hysteresis_veh=9"});
  EXPECT_EQ(other.code, 1) << other.err;
  EXPECT_EQ(Json::parse(other.out)["first"]["kind"], "request");
}

TEST(Redrive, OfABuildWithAnotherParameterNamesTheFirstStepAndCar) {
  const TemporaryFolder folder;
  const std::string result = recorded_run(folder);
  const std::string set = "rsus[0].arrive_on_green.tail_s=1";
  const Finished finished =
      lukou({"redrive", result, "--quiet", "--json", "--set", set, "--table", folder / "differences.csv"});
  EXPECT_EQ(finished.code, 1) << finished.err;
  const Json first = Json::parse(finished.out)["first"];
  EXPECT_EQ(first["kind"], "advice");
  ASSERT_TRUE(first["vehicle"].is_number());
  // The table's first row is the same difference.
  const std::string table = content(folder / "differences.csv");
  const std::string row = "\n" + std::to_string(first["step"].get<int>()) + ",";
  EXPECT_EQ(table.find(row), table.find('\n'));
  EXPECT_NE(table.find(",advice," + std::to_string(first["vehicle"].get<int>()) + ","), std::string::npos);
}

TEST(Redrive, SaysThatAProgramEndedOrIsNotThere) {
  const TemporaryFolder folder;
  const std::string result = recorded_run(folder);
  const Finished gone = lukou({"redrive", result, "--quiet", "--rsu", "/bin/false"});
  EXPECT_EQ(gone.code, 3);
  EXPECT_NE(gone.err.find("rsu0: exited with code 1"), std::string::npos) << gone.err;
}

TEST(Redrive, RefusesChangesOfWhatTheRoadsideGot) {
  const TemporaryFolder folder;
  const Finished refused = lukou({"redrive", recorded_run(folder), "--set", "traffic.west.flow_veh_per_h=100"});
  EXPECT_EQ(refused.code, 2);
  EXPECT_NE(refused.err.find("the roadside's input is the recorded one"), std::string::npos) << refused.err;
}

TEST(Why, TellsTheLifeOfACarInTheOrderOfTime) {
  const TemporaryFolder folder;
  const std::string result = recorded_run(folder, {"--set", "radio.preset=HARSH"});
  const Finished finished = lukou({"why", result, "--vehicle", "4", "--json"});
  ASSERT_EQ(finished.code, 0) << finished.err;
  const Json story = Json::parse(finished.out)["story"];
  ASSERT_GT(story.size(), 4U);
  EXPECT_EQ(story[0]["kind"], "entered");
  EXPECT_EQ(story.back()["kind"], "left");
  for (std::size_t i = 1; i < story.size(); ++i) EXPECT_LE(story[i - 1]["from_s"], story[i]["from_s"]);
}

TEST(Replay, NeedsAWholeLogAndOffersToComputeTheRunAgain) {
  const TemporaryFolder folder;
  EXPECT_EQ(lukou({"run", "paper", "--mode", "in-process", "--quiet", "--duration", "20", "--out", folder / "r"}).code,
            0);
  const Finished refused = lukou({"replay", folder / "r"});
  EXPECT_EQ(refused.code, 2);
  EXPECT_NE(refused.err.find("run.mcap: cannot be read"), std::string::npos) << refused.err;
  EXPECT_NE(refused.err.find("--recompute"), std::string::npos) << refused.err;
}

TEST(Replay, SpeaksOnTheBusAsTheRunDid) {
  const TemporaryFolder folder;
  const std::string name = fresh_run_id();
  const std::string result = recorded_run(folder, {}, name);
  // Computed again: the same run, whatever it recorded.
  Program replay({"replay", result, "--recompute"});
  const std::string run = "replay-" + name;
  ASSERT_TRUE(wait_for_step(run, 10));
  EXPECT_NE(lukou({"ctl", run, "seek", "100"}).out.find("at step 1000 (100.0 s)"), std::string::npos);
  ASSERT_TRUE(wait_for_step(run, 1000));
  EXPECT_NE(lukou({"ctl", run, "set", "vehicles.equipped_ratio=1"}).err.find("nothing can be changed"),
            std::string::npos);
  replay.signal(SIGINT);
  EXPECT_EQ(replay.wait(20.0), 0);
}

}  // namespace
}  // namespace lukou::test
