#include <gtest/gtest.h>

#include <filesystem>
#include <sstream>

#include "tests/system/program.hpp"

namespace lukou::test {
namespace {

std::string shipped_rsu() { return (std::filesystem::path(LUKOU_PROGRAM).parent_path() / "lukou-rsu").string(); }

Finished run(std::vector<std::string> more) {
  std::vector<std::string> arguments = {"run", "paper", "--quiet", "--duration", "150"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return lukou(arguments);
}

/// Rows of guidance.csv with this RSU and fate: its columns 5 and 10.
int rows(const std::filesystem::path& table, const std::string& rsu, const std::string& fate) {
  std::istringstream lines(content(table));
  int found = 0;
  for (std::string line; std::getline(lines, line);) {
    std::vector<std::string> cells;
    std::istringstream row(line);
    for (std::string cell; std::getline(row, cell, ',');) cells.push_back(cell);
    if (cells.size() >= 10 && cells[4] == rsu && cells[9] == fate) ++found;
  }
  return found;
}

TEST(TwoRsus, GiveTheSameBytesInOneProcessAndAsProgramsOfTheirOwn) {
  const TemporaryFolder folder;
  // Both advise the same cars: one to come at green, the other to keep to the speed of the queue ahead.
  const std::vector<std::string> both = {"--rsu-algorithm", "arrive_on_green", "--rsu-algorithm",
                                         "1=glosa",         "--set",           "record.guidance=true"};
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.end(), both.begin(), both.end());
    return run(more);
  };
  const Finished alone = with({"--mode", "in-process", "--out", folder / "one"});
  ASSERT_EQ(alone.code, 0) << alone.err;
  const Finished apart = with({"--rsu", "0=" + shipped_rsu(), "--rsu", "1=" + shipped_rsu(), "--out", folder / "two"});
  ASSERT_EQ(apart.code, 0) << apart.err;
  EXPECT_EQ(differing_files(folder / "one", folder / "two"), std::vector<std::string>{});
  // Issued together, the words of RSU 1 count: those of RSU 0 for the same car are superseded.
  EXPECT_GT(rows(folder / "one" / "guidance.csv", "0", "superseded"), 1000);
  EXPECT_EQ(rows(folder / "one" / "guidance.csv", "1", "superseded"), 0);
  const Finished one_less = run({"--mode", "in-process", "--out", folder / "less"});
  ASSERT_EQ(one_less.code, 0) << one_less.err;
  EXPECT_NE(content(folder / "less" / "car.csv"), content(folder / "one" / "car.csv")) << "RSU 1 changes nothing";
}

TEST(TwoRsus, ASecondOneIsAddedForAProgramOfItsOwn) {
  const TemporaryFolder folder;
  const Finished added = run({"--rsu", "1=" + shipped_rsu(), "--out", folder / "added"});
  ASSERT_EQ(added.code, 0) << added.err;
  const std::string scenario = content(folder / "added" / "scenario.textproto");
  EXPECT_NE(scenario.find("algorithm: \"none\""), std::string::npos) << scenario;
}

TEST(TwoRsus, AreNotMoreThanTheNextOneAndHaveOneProgramEach) {
  const Finished gap = run({"--rsu", "2=" + shipped_rsu()});
  EXPECT_EQ(gap.code, 2);
  EXPECT_NE(gap.err.find("the scenario has 1 RSU; the next one is 1"), std::string::npos) << gap.err;
  const Finished twice = run({"--rsu", "0=a", "--rsu", "0=b"});
  EXPECT_EQ(twice.code, 2);
  EXPECT_NE(twice.err.find("is the second for RSU 0"), std::string::npos) << twice.err;
  const Finished unknown = run({"--rsu-algorithm", "1=nothing"});
  EXPECT_EQ(unknown.code, 2);
  EXPECT_NE(unknown.err.find("rsus[1].algorithm"), std::string::npos) << unknown.err;
}

}  // namespace
}  // namespace lukou::test
