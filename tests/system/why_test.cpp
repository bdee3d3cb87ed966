#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <sstream>

#include "tests/system/program.hpp"

// Every stop has a cause, every advice a fate, and the program tells them.

namespace lukou::test {
namespace {

void run(const std::filesystem::path& out, const std::vector<std::string>& more) {
  std::vector<std::string> arguments = {"run", "paper", "--duration", "400", "--mode", "in-process", "--quiet"};
  arguments.insert(arguments.end(), {"--set", "run.warmup_s=0", "--out", out});
  arguments.insert(arguments.end(), more.begin(), more.end());
  const Finished finished = lukou(arguments);
  ASSERT_EQ(finished.code, 0) << finished.err;
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

std::string cell(const std::string& line, int column) {
  std::istringstream stream(line);
  std::string cell;
  for (int i = 0; i <= column; ++i) std::getline(stream, cell, ',');
  return cell;
}

/// The whole number after `"key":` in a JSON text.
long number(const std::string& json, const std::string& key) {
  const auto at = json.find("\"" + key + "\":");
  return at == std::string::npos ? -1 : std::atol(json.c_str() + at + key.size() + 3);
}

const std::vector<std::string> kBursts = {"--set", "radio.downlink.latency.gamma.min_ms=50",
                                          "--set", "radio.downlink.latency.gamma.mean_ms=150",
                                          "--set", "radio.downlink.loss.burst.rate=0.6",
                                          "--set", "radio.downlink.loss.burst.mean_length=200",
                                          "--set", "record.guidance=true"};

TEST(Why, NamesACauseOfEveryStopAndTheSumsAgree) {
  const TemporaryFolder folder;
  run(folder / "r", kBursts);
  const auto rows = lines_of(content(folder / "r/stops.csv"));
  const std::string summary = content(folder / "r/summary.json");
  const auto steps = lines_of(content(folder / "r/stop.csv"));
  ASSERT_GT(rows.size(), 50U);
  const auto stops = static_cast<long>(rows.size()) - 1;
  EXPECT_EQ(stops, number(summary, "stops_total"));
  EXPECT_EQ(stops, std::atol(cell(steps.back(), 14).c_str()));
  EXPECT_EQ(summary.find("unknown\""), std::string::npos);
  // Each cause in the summary is the number of its rows, and the seconds stood are those of stop_time.csv.
  long tenths = 0;
  for (std::size_t i = 1; i < rows.size(); ++i) tenths += std::lround(std::atof(cell(rows[i], 8).c_str()) * 10.0);
  const auto stood = lines_of(content(folder / "r/stop_time.csv"));
  EXPECT_EQ(tenths, std::lround(std::atof(cell(stood.back(), 14).c_str()) * 10.0));
  const std::string causes = summary.substr(summary.find("stops_by_cause"));  // "unequipped" is a group of cars before
  for (const char* cause : {"unequipped", "queue_ahead", "lost_burst", "overridden_red", "red_without_advice"}) {
    const auto count = std::ranges::count_if(rows, [&](const std::string& row) { return cell(row, 9) == cause; });
    EXPECT_EQ(count, number(causes, cause)) << cause;
  }
  EXPECT_GT(number(causes, "lost_burst"), 0);
}

TEST(Why, GivesEveryAdviceOneRow) {
  const TemporaryFolder folder;
  run(folder / "r", kBursts);
  const auto rows = lines_of(content(folder / "r/guidance.csv"));
  EXPECT_EQ(static_cast<long>(rows.size()) - 1, number(content(folder / "r/summary.json"), "advice_sent"));
  const Finished why = lukou({"why", folder / "r", "--guidance"});
  EXPECT_EQ(why.code, 0) << why.err;
  EXPECT_NE(why.out.find("lost_burst"), std::string::npos) << why.out;
}

TEST(Why, CallsAdviceLateThatIsSlowerThanItsLife) {
  const TemporaryFolder folder;
  run(folder / "late", {"--set", "radio.downlink.latency.constant_ms=800"});
  run(folder / "none", {"--rsu-algorithm", "none"});
  EXPECT_EQ(content(folder / "late/stop.csv"), content(folder / "none/stop.csv"));
  const std::string late = content(folder / "late/summary.json");
  const std::string none = content(folder / "none/summary.json");
  EXPECT_GT(number(late, "red_without_advice") + number(none, "red_without_advice"), 0);
  EXPECT_EQ(number(late.substr(late.find("stops_by_cause")), "late"), number(none, "red_without_advice"));
}

TEST(Why, TellsDriversWhoDoNotFollow) {
  const TemporaryFolder folder;
  run(folder / "r", {"--set", "vehicles.compliance.ignoring_share=0.5"});
  const Finished why = lukou({"why", folder / "r"});
  EXPECT_NE(why.out.find("not_complied"), std::string::npos) << why.out;
  const Finished listed = lukou({"why", folder / "r", "--stops", "--cause", "not_complied"});
  EXPECT_EQ(listed.code, 0);
  const auto lines = lines_of(listed.out);
  ASSERT_GT(lines.size(), 3U);
  EXPECT_EQ(cell(lines[1], 9), "not_complied");
}

TEST(Why, PrintsOneJsonObject) {
  const TemporaryFolder folder;
  run(folder / "r", {});
  const Finished why = lukou({"why", folder / "r", "--stops", "--json"});
  EXPECT_EQ(why.code, 0);
  EXPECT_EQ(why.out.front(), '{');
  EXPECT_EQ(lines_of(why.out).size(), 1U);
  EXPECT_EQ(number(why.out, "rows"), static_cast<long>(lines_of(content(folder / "r/stops.csv")).size()) - 1);
  EXPECT_EQ(number(why.out, "complete_to_step"), 4000);
}

TEST(Why, SaysInOneLineWhatIsMissing) {
  const TemporaryFolder folder;
  run(folder / "r", {"--set", "record.stops=false"});
  EXPECT_FALSE(std::filesystem::exists(folder / "r/stops.csv"));
  for (const std::vector<std::string>& arguments : {std::vector<std::string>{"why", folder / "r"},
                                                    {"why", folder / "r", "--guidance"},
                                                    {"why", folder / "nothing"}}) {
    const Finished why = lukou(arguments);
    EXPECT_EQ(why.code, 2);
    EXPECT_EQ(lines_of(why.err).size(), 1U) << why.err;
    EXPECT_EQ(why.out, "");
  }
  EXPECT_NE(lukou({"why", folder / "r", "--guidance"}).err.find("record.guidance=true"), std::string::npos);
  EXPECT_GT(number(content(folder / "r/summary.json"), "stops_total"), 0);  // the totals are there all the same
}

TEST(Why, RefusesACauseThatThereIsNot) {
  const TemporaryFolder folder;
  run(folder / "r", {});
  const Finished why = lukou({"why", folder / "r", "--cause", "weather"});
  EXPECT_EQ(why.code, 2);
  EXPECT_NE(why.err.find("queue_ahead"), std::string::npos) << why.err;
}

TEST(Why, OfDriversWhoDoNotFollowReplaysByteForByte) {
  const TemporaryFolder folder;
  const std::string id = fresh_run_id();
  Program launcher({"run", "paper", "--duration", "150", "--pace", "50", "--quiet", "--run-id", id, "--set",
                    "record.guidance=true", "--out", folder / "r"});
  ASSERT_TRUE(wait_for_step(id, 150));
  EXPECT_EQ(lukou({"ctl", id, "set", "vehicles.compliance.human_share=0.5"}).code, 0);
  EXPECT_EQ(lukou({"ctl", id, "set", "vehicles.compliance.ignoring_share=0.6"}).code, 2);
  EXPECT_EQ(lukou({"ctl", id, "set", "vehicles.compliance.ignoring_share=0.3"}).code, 0);
  EXPECT_EQ(lukou({"ctl", id, "set", "vehicles.on_board_unit.fallback_s=3"}).code, 0);
  EXPECT_EQ(lukou({"ctl", id, "pace", "max"}).code, 0);
  EXPECT_EQ(launcher.wait(), 0) << launcher.err();
  const Finished replay = lukou({"run", folder / "r/scenario.textproto", "--mode", "in-process", "--quiet",
                                 "--replay-directives", folder / "r/directives.textproto", "--out", folder / "again"});
  ASSERT_EQ(replay.code, 0) << replay.err;
  EXPECT_EQ(differing_files(folder / "r", folder / "again"), std::vector<std::string>{});
  const std::string summary = content(folder / "r/summary.json");
  EXPECT_GT(number(summary.substr(summary.find("advice_refused")), "not_complied"), 0);
  EXPECT_GT(number(summary, "driver"), 0);
}

TEST(Why, KeepsTheStopsOfARunWhoseRecorderWasKilled) {
  const TemporaryFolder folder;
  const std::string id = fresh_run_id();
  Program launcher(
      {"run", "paper", "--duration", "3000", "--pace", "200", "--quiet", "--run-id", id, "--out", folder / "r"});
  ASSERT_TRUE(wait_for_step(id, 1500));
  kill(processes_of(id).at("lukou-recorder"), SIGKILL);
  EXPECT_EQ(launcher.wait(20.0), 3);
  const Finished inspection = lukou({"inspect", folder / "r"});
  EXPECT_EQ(inspection.code, 0) << inspection.out;
  const Finished why = lukou({"why", folder / "r"});
  EXPECT_EQ(why.code, 0) << why.err;
  EXPECT_GT(lines_of(content(folder / "r/stops.csv")).size(), 1U);
}

}  // namespace
}  // namespace lukou::test
