// Studies with real processes: what a sweep makes, and what it makes of runs that die, hang, or end in an anomaly.

#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/system/program.hpp"
#include "tests/system/study_files.hpp"

namespace lukou::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

void write(const fs::path& file, const std::string& text) { std::ofstream(file) << text; }

/// Direct children of a process.
std::vector<pid_t> children_of(pid_t parent) {
  std::vector<pid_t> children;
  std::error_code code;
  for (const auto& entry : fs::directory_iterator("/proc", code)) {
    const std::string name = entry.path().filename();
    if (name.find_first_not_of("0123456789") != std::string::npos) continue;
    const std::string stat = content(entry.path() / "stat");
    const std::size_t behind_name = stat.rfind(')');
    if (behind_name == std::string::npos) continue;
    std::istringstream rest(stat.substr(behind_name + 2));
    char state = 0;
    pid_t of = 0;
    rest >> state >> of;
    if (of == parent && state != 'Z') children.push_back(static_cast<pid_t>(std::stol(name)));
  }
  return children;
}

json marker(const fs::path& study, const std::string& run, const std::string& name = "done.json") {
  return json::parse(content(study / "runs" / run / name), nullptr, false);
}

class Sweep : public testing::Test {
 protected:
  std::vector<std::string> arguments(const fs::path& out, std::vector<std::string> more = {}) const {
    std::vector<std::string> all = {"sweep", file_.string(), "--out", out.string(), "--quiet"};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }
  /// The content of an undisturbed sweep.
  std::string undisturbed() {
    const fs::path out = folder_ / "undisturbed";
    const Finished ended = lukou(arguments(out));
    EXPECT_EQ(ended.code, 0) << ended.err;
    return dump(out / "study.sqlite");
  }

  TemporaryFolder folder_;
  fs::path file_ = folder_ / "small.textproto";
};

TEST_F(Sweep, RunsAreThoseOfLukouRunByteForByte) {
  write(file_, small_study(120.0, "keep: \"*\"\n"));
  const fs::path out = folder_ / "study";
  ASSERT_EQ(lukou(arguments(out)).code, 0);
  EXPECT_EQ(markers_in(out), 9U);
  for (const auto& run : fs::directory_iterator(out / "runs")) {
    const fs::path single = folder_ / run.path().filename().string();
    ASSERT_EQ(lukou({"run", (run.path() / "result/scenario.textproto").string(), "--mode", "in-process", "--quiet",
                     "--out", single.string()})
                  .code,
              0);
    EXPECT_EQ(content(single / "manifest.json"), content(run.path() / "result/manifest.json")) << run.path();
    EXPECT_TRUE(differing_files(single, run.path() / "result").empty()) << run.path();
  }
  // The list of hashes says the same, and the files are there to be checked by it.
  const int checked = std::system(("cd '" + out.string() + "' && sha256sum --quiet -c sha256.txt").c_str());
  EXPECT_EQ(checked, 0);
}

TEST_F(Sweep, RunsAsProcessesOverDdsGiveTheSameBytes) {
  write(file_,
        "scenario: \"paper\"\nset: \"run.duration_s=60\"\nset: \"run.warmup_s=10\"\nseeds { count: 2 }\nmode: "
        "PROCESSES\n");
  const fs::path processes = folder_ / "processes";
  const Finished ended = lukou(arguments(processes));
  ASSERT_EQ(ended.code, 0) << ended.err << content(processes / "runs/p000-s1/log.txt");
  write(file_, "scenario: \"paper\"\nset: \"run.duration_s=60\"\nset: \"run.warmup_s=10\"\nseeds { count: 2 }\n");
  const fs::path one = folder_ / "one";
  ASSERT_EQ(lukou(arguments(one)).code, 0);
  EXPECT_EQ(content(processes / "sha256.txt"), content(one / "sha256.txt"));
  EXPECT_FALSE(content(one / "sha256.txt").empty());
}

TEST_F(Sweep, KeepsOfEachRunWhatTheStudyAsksFor) {
  write(file_, small_study(60.0, "keep: \"car.csv\"\n"));
  const fs::path out = folder_ / "study";
  ASSERT_EQ(lukou(arguments(out)).code, 0);
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(out / "runs/p000-s1/result"))
    names.push_back(entry.path().filename());
  std::ranges::sort(names);
  EXPECT_EQ(names, (std::vector<std::string>{"car.csv", "manifest.json", "scenario.textproto", "summary.json"}));
}

TEST_F(Sweep, KilledInTheMiddleAndResumedEndsInTheSameContent) {
  write(file_, small_study(400.0));
  const std::string expected = undisturbed();
  const fs::path out = folder_ / "killed";
  {
    Program program(arguments(out));
    ASSERT_TRUE(wait_until([&] { return markers_in(out) >= 3; }));
    program.signal(SIGKILL);
    program.wait();
  }
  const std::size_t done = markers_in(out);
  ASSERT_LT(done, 9U) << "it was over before it was killed";
  EXPECT_FALSE(fs::exists(out / "study.sqlite"));
  // Its runs end with it.
  const Finished refused = lukou(arguments(out));
  EXPECT_EQ(refused.code, 2);
  EXPECT_NE(refused.err.find("--resume"), std::string::npos) << refused.err;
  const Finished resumed = lukou(arguments(out, {"--resume"}));
  ASSERT_EQ(resumed.code, 0) << resumed.err;
  EXPECT_EQ(dump(out / "study.sqlite"), expected);
}

TEST_F(Sweep, InterruptedLeavesAFolderThatCanBeResumed) {
  write(file_, small_study(400.0));
  const std::string expected = undisturbed();
  const fs::path out = folder_ / "interrupted";
  {
    Program program(arguments(out));
    ASSERT_TRUE(wait_until([&] { return markers_in(out) >= 2; }));
    program.signal(SIGINT);
    EXPECT_EQ(program.wait(), 130);
    EXPECT_NE(program.err().find("--resume"), std::string::npos);
  }
  ASSERT_LT(markers_in(out), 9U);
  EXPECT_TRUE(fs::exists(out / "report.html")) << "what there is has been reported";
  // The folder itself names the study, too.
  const Finished resumed = lukou({"sweep", out.string(), "--resume", "--quiet"});
  ASSERT_EQ(resumed.code, 0) << resumed.err;
  EXPECT_EQ(dump(out / "study.sqlite"), expected);
}

TEST_F(Sweep, TriesARunThatCrashedOnceMoreAndLosesNothing) {
  write(file_, small_study(400.0));
  const std::string expected = undisturbed();
  const fs::path out = folder_ / "crashed";
  Program program(arguments(out, {"--jobs", "1"}));
  std::vector<pid_t> first;
  ASSERT_TRUE(wait_until([&] { return !(first = children_of(program.pid())).empty(); }));
  kill(first.front(), SIGKILL);
  ASSERT_EQ(program.wait(), 0) << program.err();
  EXPECT_EQ(marker(out, "p000-s1")["attempts"], 2);
  EXPECT_TRUE(fs::exists(out / "runs/p000-s1/log-of-first-attempt.txt"));
  EXPECT_EQ(marker(out, "p001-s1")["attempts"], 1);
  EXPECT_EQ(dump(out / "study.sqlite"), expected);
}

TEST_F(Sweep, ReportsARunThatCrashedTwiceAndGoesOnWithTheOthers) {
  write(file_, small_study(400.0));
  const std::string expected = undisturbed();
  const fs::path out = folder_ / "crashed";
  {
    Program program(arguments(out, {"--jobs", "1"}));
    pid_t last = 0;
    for (int crash = 0; crash < 2; ++crash) {
      std::vector<pid_t> now;
      ASSERT_TRUE(wait_until([&] {
        now = children_of(program.pid());
        return !now.empty() && now.front() != last;
      }));
      last = now.front();
      kill(last, SIGKILL);
    }
    EXPECT_EQ(program.wait(), 6) << program.err();
  }
  EXPECT_EQ(markers_in(out, "failed.json"), 1U);
  EXPECT_EQ(markers_in(out), 8U);
  const json failed = marker(out, "p000-s1", "failed.json");
  EXPECT_EQ(failed["exit_code"], 128 + SIGKILL);
  EXPECT_NE(failed["what"].get<std::string>().find("killed by signal 9"), std::string::npos);
  EXPECT_NE(content(out / "report.html").find("1 run failed"), std::string::npos);
  EXPECT_EQ(lukou(arguments(out, {"--resume"})).code, 0);
  EXPECT_EQ(dump(out / "study.sqlite"), expected);
}

TEST_F(Sweep, TriesARunThatHangsOnceMore) {
  write(file_, small_study(400.0, "stall_limit_s: 5\n"));
  const fs::path out = folder_ / "hung";
  Program program(arguments(out, {"--jobs", "1"}));
  std::vector<pid_t> first;
  ASSERT_TRUE(wait_until([&] { return !(first = children_of(program.pid())).empty(); }));
  kill(first.front(), SIGSTOP);
  ASSERT_EQ(program.wait(), 0) << program.err();
  EXPECT_EQ(marker(out, "p000-s1")["attempts"], 2);
  EXPECT_EQ(markers_in(out), 9U);
}

TEST_F(Sweep, TakesAnAnomalyForAResult) {
  // 3600 veh/h overflow the entrances of the paper's plan within minutes.
  write(file_, R"(
scenario: "paper"
set: "run.duration_s=3000"
set: "run.warmup_s=60"
set: "vehicles.equipped_ratio=0"
grids { factors { name: "flow" values: [300, 3600] paths: "traffic.west.flow_veh_per_h"
                  paths: "traffic.east.flow_veh_per_h" paths: "traffic.south.flow_veh_per_h"
                  paths: "traffic.north.flow_veh_per_h" } }
seeds { count: 2 }
)");
  const fs::path out = folder_ / "overflow";
  const Finished ended = lukou(arguments(out, {"--json"}));
  ASSERT_EQ(ended.code, 0) << ended.err;
  const json said = json::parse(ended.out);
  EXPECT_EQ(said["runs_done"], 2);
  EXPECT_EQ(said["runs_anomaly"], 2);
  EXPECT_EQ(marker(out, "p001-s1")["exit_code"], 4);
  EXPECT_EQ(marker(out, "p001-s1")["attempts"], 1) << "it is not tried again";
  EXPECT_NE(said["warnings"].dump().find("ended early by an anomaly"), std::string::npos) << said["warnings"];
  EXPECT_NE(dump(out / "study.sqlite").find("anomaly:overflow"), std::string::npos);
}

TEST_F(Sweep, AddsSeedsUntilTheMeanIsPreciseEnough) {
  const std::string base =
      "scenario: \"paper\"\nset: \"run.duration_s=200\"\nset: \"run.warmup_s=60\"\n"
      "set: \"vehicles.equipped_ratio=0\"\nmeasures: \"mean_delay_s\"\n";
  write(file_, base + "seeds { count: 3 }\nprecision { measure: \"mean_delay_s\" half_width: 0.04 at_most: 40 }\n");
  const fs::path out = folder_ / "precise";
  ASSERT_EQ(lukou(arguments(out)).code, 0);
  const std::size_t runs = markers_in(out);
  EXPECT_GT(runs, 3U);
  EXPECT_LT(runs, 40U);
  // What it asks for follows from the results alone: there is nothing left to make.
  const std::string before = dump(out / "study.sqlite");
  ASSERT_EQ(lukou(arguments(out, {"--resume"})).code, 0);
  EXPECT_EQ(markers_in(out), runs);
  EXPECT_EQ(dump(out / "study.sqlite"), before);
}

TEST_F(Sweep, GrowsByMoreSeedsWithoutMakingTheOldOnesAgain) {
  write(file_, small_study(60.0));
  const fs::path out = folder_ / "study";
  ASSERT_EQ(lukou(arguments(out, {"--seeds", "1"})).code, 0);
  const auto made = fs::last_write_time(out / "runs/p000-s1/done.json");
  ASSERT_EQ(lukou(arguments(out, {"--seeds", "2", "--resume"})).code, 0);
  EXPECT_EQ(markers_in(out), 6U);
  EXPECT_EQ(fs::last_write_time(out / "runs/p000-s1/done.json"), made);
}

TEST_F(Sweep, RefusesTheFolderOfAnotherStudyAndOfASweepAtWork) {
  write(file_, small_study(400.0));
  const fs::path out = folder_ / "study";
  Program program(arguments(out));
  ASSERT_TRUE(wait_until([&] { return markers_in(out) >= 1; }));
  const Finished second = lukou(arguments(out, {"--resume"}));
  EXPECT_EQ(second.code, 2);
  EXPECT_NE(second.err.find("another sweep is at work"), std::string::npos) << second.err;
  program.signal(SIGTERM);
  EXPECT_EQ(program.wait(), 143);
  const Finished other = lukou(arguments(out, {"--resume", "--set", "run.duration_s=10"}));
  EXPECT_EQ(other.code, 2);
  EXPECT_NE(other.err.find("was made by another study"), std::string::npos) << other.err;
}

TEST_F(Sweep, DoesNotBeginWhatTheDiskCannotHold) {
  write(file_,
        "scenario: \"paper\"\nset: \"run.duration_s=1000000\"\nset: \"record.guidance=true\"\nkeep: \"*\"\n"
        "seeds { count: 10000 }\n");
  const Finished ended = lukou(arguments(folder_ / "study"));
  EXPECT_EQ(ended.code, 5);
  EXPECT_NE(ended.err.find("needs about"), std::string::npos) << ended.err;
  EXPECT_EQ(markers_in(folder_ / "study"), 0U);
}

TEST_F(Sweep, ReportIsTheSameHoweverOftenItIsMade) {
  write(file_, small_study(60.0));
  const fs::path out = folder_ / "study";
  ASSERT_EQ(lukou(arguments(out)).code, 0);
  const std::string database = dump(out / "study.sqlite");
  const std::string page = content(out / "report.html");
  const std::string runs = content(out / "runs.csv");
  ASSERT_EQ(lukou({"report", out.string()}).code, 0);
  EXPECT_EQ(dump(out / "study.sqlite"), database);
  EXPECT_EQ(content(out / "report.html"), page);
  EXPECT_EQ(content(out / "runs.csv"), runs);
  const Finished elsewhere = lukou({"report", out.string(), "--out", (folder_ / "page.html").string()});
  EXPECT_EQ(elsewhere.code, 2);
  EXPECT_NE(elsewhere.err.find("--out: is for the report of a run"), std::string::npos) << elsewhere.err;
  const Finished no_study = lukou({"report", (out / "runs").string()});
  EXPECT_EQ(no_study.code, 2);
  EXPECT_NE(no_study.err.find("is no result folder"), std::string::npos);
}

}  // namespace
}  // namespace lukou::test
