// A study on a Slurm cluster of two virtual nodes on this host. Needs root, slurm-wlm and munge; says so if they are
// missing.

#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <thread>

#include "tests/system/program.hpp"
#include "tests/system/study_files.hpp"

namespace lukou::test {
namespace {

namespace fs = std::filesystem;

const std::string kCluster = std::string(LUKOU_SOURCES) + "/launch_scripts/slurm/two_nodes.sh";

bool is_there(const std::string& program) {
  return std::system(("command -v " + program + " >/dev/null 2>&1").c_str()) == 0;
}

/// Runs a command in the shell and returns what it prints.
std::string said(const std::string& command) {
  const TemporaryFolder folder;
  const std::string file = (folder / "said").string();
  static_cast<void>(std::system((command + " >" + file + " 2>&1").c_str()));
  return content(file);
}

class Slurm : public testing::Test {
 protected:
  void SetUp() override {
    std::string missing;
    if (geteuid() != 0) missing += " root;";
    for (const char* program : {"munged", "slurmctld", "slurmd", "sbatch"})
      if (!is_there(program)) missing += std::string(" ") + program + " (packages slurm-wlm, munge);";
    if (!missing.empty()) GTEST_SKIP() << "the Slurm test cannot run, it lacks:" << missing;
    ASSERT_EQ(std::system((kCluster + " start " + cluster_.string()).c_str()), 0);
    started_ = true;
    setenv("SLURM_CONF", (cluster_ / "slurm.conf").c_str(), 1);
  }
  void TearDown() override {
    if (!started_) return;
    EXPECT_EQ(std::system((kCluster + " stop " + cluster_.string()).c_str()), 0);
  }

  TemporaryFolder folder_;
  fs::path cluster_ = folder_ / "cluster";
  fs::path file_ = folder_ / "small.textproto";
  bool started_ = false;
};

/// The id behind "Slurm job array " in what a sweep says.
std::string array_of(const Program& program) {
  const std::string text = program.err();
  const std::string head = "Slurm job array ";
  const std::size_t at = text.find(head);
  if (at == std::string::npos) return "";
  return text.substr(at + head.size(), text.find(',', at) - at - head.size());
}

TEST_F(Slurm, RunsAStudyOnTwoNodesAndResumesAfterATaskHasFailed) {
  std::ofstream(file_) << small_study(600.0);
  const fs::path local = folder_ / "local";
  ASSERT_EQ(lukou({"sweep", file_.string(), "--out", local.string(), "--quiet"}).code, 0);

  const fs::path out = folder_ / "cluster-study";
  std::string array;
  {
    Program program({"sweep", file_.string(), "--out", out.string(), "--slurm", "--array-size", "3"});
    ASSERT_TRUE(wait_until([&] { return !(array = array_of(program)).empty(); })) << program.err();
    ASSERT_TRUE(wait_until([&] { return said("squeue -h -j " + array + "_0 -o %T").find("RUNNING") == 0; }));
    ASSERT_EQ(std::system(("scancel " + array + "_0").c_str()), 0);
    EXPECT_EQ(program.wait(), 6) << program.err();
    EXPECT_NE(program.err().find("runs are missing"), std::string::npos) << program.err();
  }
  const std::size_t made = markers_in(out);
  EXPECT_LT(made, 9U);
  EXPECT_GE(made, 6U) << "the other tasks are not hurt";
  const std::string tasks = said("scontrol show job " + array);
  EXPECT_NE(tasks.find("NodeList=n1"), std::string::npos) << tasks;
  EXPECT_NE(tasks.find("NodeList=n2"), std::string::npos) << tasks;
  EXPECT_NE(tasks.find("JobState=CANCELLED"), std::string::npos) << tasks;

  const Finished resumed = lukou({"sweep", file_.string(), "--out", out.string(), "--slurm", "--resume"});
  ASSERT_EQ(resumed.code, 0) << resumed.err;
  EXPECT_EQ(markers_in(out), 9U);
  EXPECT_EQ(dump(out / "study.sqlite"), dump(local / "study.sqlite"));
}

TEST_F(Slurm, DetachedASweepGathersByItself) {
  std::ofstream(file_) << small_study(120.0);
  const fs::path out = folder_ / "detached";
  const Finished left =
      lukou({"sweep", file_.string(), "--out", out.string(), "--slurm", "--array-size", "2", "--detach"});
  ASSERT_EQ(left.code, 0) << left.err;
  ASSERT_TRUE(wait_until([&] { return fs::exists(out / "slurm/1/gathered"); })) << said("squeue");
  EXPECT_EQ(markers_in(out), 9U);
  EXPECT_TRUE(fs::exists(out / "study.sqlite"));
  EXPECT_TRUE(fs::exists(out / "report.html"));
}

}  // namespace
}  // namespace lukou::test
