#include <gtest/gtest.h>

#include <unistd.h>

#include <fstream>

#include "tests/system/program.hpp"

namespace lukou::test {
namespace {

TEST(CommandLine, NamesLineAndColumnOfAMistakeAndWhatWouldBeRight) {
  const TemporaryFolder folder;
  const std::string file = folder / "my.textproto";
  std::ofstream(file) << "traffic {\n  west { flow_vph: 600 }\n}\n";
  const Finished unknown = lukou({"validate", file});
  EXPECT_EQ(unknown.code, 2);
  EXPECT_NE(unknown.err.find(file + ":2:10: "), std::string::npos) << unknown.err;
  EXPECT_NE(unknown.err.find("did you mean `flow_veh_per_h`?"), std::string::npos) << unknown.err;

  std::ofstream(file) << "vehicles {\n  equipped_ratio: 1.7\n}\n";
  const Finished range = lukou({"validate", file});
  EXPECT_EQ(range.code, 2);
  EXPECT_NE(range.err.find(file + ":2:"), std::string::npos) << range.err;
  EXPECT_NE(range.err.find("[0, 1]"), std::string::npos) << range.err;

  std::ofstream(file) << "rsus { algorithm: \"arive_on_green\" }\n";
  const Finished algorithm = lukou({"validate", file});
  EXPECT_EQ(algorithm.code, 2);
  EXPECT_NE(algorithm.err.find("arrive_on_green"), std::string::npos) << algorithm.err;
}

TEST(CommandLine, ListsEachAlgorithmWithItsSourceAndParameters) {
  const Finished run = lukou({"algorithms"});
  EXPECT_EQ(run.code, 0);
  for (const char* name : {"actuated", "arrive_on_green", "cv_phase", "eco", "glosa", "glosa_queue", "max_pressure",
                           "none", "platoon", "speed_harmonisation"}) {
    EXPECT_NE(("\n" + run.out).find("\n" + std::string(name) + ": "), std::string::npos) << name;
  }
  EXPECT_NE(run.out.find("speed_min_kmh            default 18 km/h, [1, 60]; "), std::string::npos) << run.out;
  EXPECT_NE(run.out.find("stages                   default AXES, AXES | PROTECTED_LEFTS; "), std::string::npos)
      << run.out;

  const Finished bad = lukou({"validate", "paper", "--set", "rsus[0].glosa.speed_min_kmh=500"});
  EXPECT_EQ(bad.code, 2);
  EXPECT_NE(bad.err.find("must be within [1, 60] km/h"), std::string::npos) << bad.err;
}

TEST(CommandLine, RunsEachAlgorithmInOneProcess) {
  for (const char* name :
       {"actuated", "cv_phase", "eco", "glosa", "glosa_queue", "max_pressure", "platoon", "speed_harmonisation"}) {
    const TemporaryFolder folder;
    const Finished run = lukou({"run", "paper", "--mode", "in-process", "--duration", "120", "--quiet",
                                "--rsu-algorithm", name, "--out", folder / "r"});
    EXPECT_EQ(run.code, 0) << run.err;
    EXPECT_NE(content(folder / "r/scenario.textproto").find(std::string("\n  ") + name + " {"), std::string::npos)
        << "the parameters stand with the results";
  }
}

TEST(CommandLine, RefusesBadRequestsWithCodeTwo) {
  for (const std::vector<std::string>& arguments : {std::vector<std::string>{},
                                                    {"rum"},
                                                    {"run"},
                                                    {"run", "no-such-scenario"},
                                                    {"run", "paper", "--pace", "warp"},
                                                    {"run", "paper", "--set", "run.duration_s"},
                                                    {"run", "paper", "--mode", "both"},
                                                    {"inspect", "/no/such/folder"},
                                                    {"run", "paper", "--replay-directives", "/no/such/file"},
                                                    {"validate", "paper", "--set", "no.such.field=1"}}) {
    const Finished run = lukou(arguments);
    EXPECT_EQ(run.code, 2) << (arguments.empty() ? "(nothing)" : arguments.back()) << ": " << run.err;
    EXPECT_FALSE(run.err.empty());
  }
}

TEST(CommandLine, LeavesAFolderAloneThatHoldsSomething) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "r");
  std::ofstream(folder / "r/mine.txt") << "mine";
  const Finished run = lukou({"run", "paper", "--duration", "10", "--quiet", "--out", folder / "r"});
  EXPECT_EQ(run.code, 5) << run.err;
  EXPECT_EQ(content(folder / "r/mine.txt"), "mine");
  EXPECT_FALSE(std::filesystem::exists(folder / "r/car.csv"));
}

TEST(CommandLine, RefusesASessionThatDoesNotFitTheScenario) {
  const TemporaryFolder folder;
  const std::string file = folder / "directives.textproto";
  std::ofstream(file) << "changes { step: 10 set: \"traffic.west.flow_veh_per_h=-5\" }\n";
  const Finished run =
      lukou({"run", "paper", "--duration", "10", "--quiet", "--replay-directives", file, "--out", folder / "r"});
  EXPECT_EQ(run.code, 2);
  EXPECT_NE(run.err.find("step 10"), std::string::npos) << run.err;
  EXPECT_FALSE(std::filesystem::exists(folder / "r"));
}

TEST(CommandLine, PrintsOneJsonObject) {
  const TemporaryFolder folder;
  const Finished run =
      lukou({"run", "paper", "--duration", "30", "--mode", "in-process", "--json", "--out", folder / "r"});
  EXPECT_EQ(run.code, 0);
  EXPECT_EQ(run.out.front(), '{');
  EXPECT_EQ(run.out.find('\n'), run.out.size() - 1);
  EXPECT_NE(run.out.find("\"vehicles_arrived\":"), std::string::npos);
}

TEST(CommandLine, ValidatesAndPrintsEveryField) {
  const Finished valid = lukou({"validate", "paper", "--print", "--set", "vehicles.equipped_ratio=0.25"});
  EXPECT_EQ(valid.code, 0) << valid.err;
  EXPECT_NE(valid.out.find("equipped_ratio: 0.25"), std::string::npos);
  EXPECT_NE(valid.out.find("safe_time_s: 1.98"), std::string::npos);
}

TEST(CommandLine, DoctorFindsThisMachineFit) {
  const Finished doctor = lukou({"doctor"});
  EXPECT_EQ(doctor.code, 0) << doctor.out;
  EXPECT_NE(doctor.out.find("DDS talks"), std::string::npos) << doctor.out;
}

TEST(CommandLine, WaitsForAnRsuThatIsStartedByHand) {
  const TemporaryFolder folder;
  const std::string run = fresh_run_id();
  Program launcher({"run", "paper", "--duration", "60", "--rsu", "wait", "--run-id", run, "--out", folder / "r"});
  std::string domain;
  for (int i = 0; i < 500 && domain.empty(); ++i) {
    const auto at = launcher.err().find("LUKOU_DOMAIN=");
    if (at != std::string::npos) domain = std::to_string(std::atoi(launcher.err().c_str() + at + 13));
    if (!launcher.running()) break;
    usleep(10000);
  }
  ASSERT_FALSE(domain.empty()) << launcher.err();
  Program rsu({}, {"LUKOU_RUN=" + run, "LUKOU_DOMAIN=" + domain},
              std::filesystem::path(LUKOU_PROGRAM).parent_path() / "lukou-rsu");
  EXPECT_EQ(launcher.wait(30.0), 0) << launcher.err();
  EXPECT_EQ(rsu.wait(5.0), 0) << rsu.err();
}

TEST(CommandLine, RefusesPrefixesThatNobodyUses) {
  const auto refused = [](std::vector<std::string> more) {
    more.insert(more.begin(), {"run", "paper"});
    const Finished end = lukou(more);
    EXPECT_EQ(end.code, 2) << end.err;
    return end.err;
  };
  EXPECT_NE(refused({"--prefix", "rsu0=nice", "--rsu", "wait"}).find("nobody starts this RSU"), std::string::npos);
  EXPECT_NE(refused({"--prefix", "rsu1=nice"}).find("--prefix rsu1=nice: must be ROLE=COMMAND"), std::string::npos);
  EXPECT_NE(refused({"--mode", "in-process", "--prefix", "rsu0=nice"}).find("--mode in-process"), std::string::npos);
}

}  // namespace
}  // namespace lukou::test
