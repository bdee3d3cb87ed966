#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "common/scenario/scenario.hpp"
#include "scenario.pb.h"

namespace lukou::scenario {
namespace {

/// A folder of its own, removed at the end.
class Arrivals : public testing::Test {
 protected:
  Arrivals() : folder_(std::filesystem::temp_directory_path() / ("lukou_arrivals_" + std::to_string(::getpid()))) {
    std::filesystem::create_directories(folder_);
  }
  ~Arrivals() override { std::filesystem::remove_all(folder_); }

  void write_trace(const std::string& content) const { std::ofstream(folder_ / "trace.csv") << content; }
  [[nodiscard]] Expected<Resolved> loaded() const {
    return load_text("traffic { west { arrivals_csv: \"trace.csv\" } }", "my.textproto", folder_);
  }
  [[nodiscard]] std::string trace() const { return (folder_ / "trace.csv").string(); }

 private:
  std::filesystem::path folder_;
};

TEST_F(Arrivals, OfAnApproachAreItsOwnRows) {
  write_trace("time_s,approach\n0,west\n1.5,south\n1.5,west\r\n20,west");
  const auto scenario = loaded();
  ASSERT_TRUE(scenario.ok()) << scenario.error().text();
  EXPECT_EQ(scenario.value().message().traffic().west().arrivals_csv(), trace()) << "absolute in the resolved form";
  EXPECT_EQ(arrivals(scenario.value(), Approach::kWest).value(), (std::vector<double>{0.0, 1.5, 20.0}));
  EXPECT_TRUE(arrivals(scenario.value(), Approach::kSouth).value().empty()) << "south does not name the trace";
}

TEST_F(Arrivals, MayBeNone) {
  write_trace("time_s,approach\n");
  const auto scenario = loaded();
  ASSERT_TRUE(scenario.ok()) << scenario.error().text();
  EXPECT_TRUE(arrivals(scenario.value(), Approach::kWest).value().empty());
}

TEST_F(Arrivals, ThatAreWrongAreExplainedByLineAndColumn) {
  struct {
    const char* content;
    const char* error;  // after the name of the trace
  } const bad[] = {
      {"", ":1:1: the first line must be time_s,approach"},
      {"time,approach\n", ":1:1: the first line must be time_s,approach"},
      {"time_s,approach\n1,west\nx,west\n", ":3:1: time_s is `x`, must be a number of seconds"},
      {"time_s,approach\n1s,west\n", ":2:1: time_s is `1s`, must be a number of seconds"},
      {"time_s,approach\nnan,west\n", ":2:1: time_s is `nan`, must be a number of seconds"},
      {"time_s,approach\n-1,west\n", ":2:1: time_s is -1 s, must be at least 0 s"},
      {"time_s,approach\n2,west\n1,south\n", ":3:1: time_s is 1 s, must not be before the row above, 2 s"},
      {"time_s,approach\n2.25,vest\n", ":2:6: approach is `vest`, must be west, south, east or north"},
      {"time_s,approach\n2,west,WL\n", ":2:1: a row has two columns, time_s,approach"},
      {"time_s,approach\n2\n", ":2:1: a row has two columns, time_s,approach"},
      {"time_s,approach\n\n2,west\n", ":2:1: a row has two columns, time_s,approach"},
  };
  for (const auto& [content, error] : bad) {
    write_trace(content);
    const auto result = loaded();
    ASSERT_FALSE(result.ok()) << content;
    EXPECT_EQ(result.error().text(), trace() + error);
  }
}

}  // namespace
}  // namespace lukou::scenario
