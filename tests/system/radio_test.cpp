#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <sstream>

#include "tests/system/program.hpp"

namespace lukou::test {
namespace {

const std::vector<std::string> kTables = {"car.csv", "road.csv", "stop.csv", "stop_time.csv"};

/// A run of 200 s in one process.
void run(const std::filesystem::path& out, const std::vector<std::string>& more) {
  std::vector<std::string> arguments = {"run", "paper", "--duration", "200", "--mode", "in-process", "--quiet"};
  arguments.insert(arguments.end(), {"--out", out});
  arguments.insert(arguments.end(), more.begin(), more.end());
  const Finished finished = lukou(arguments);
  ASSERT_EQ(finished.code, 0) << finished.err;
}

/// Columns of radio.csv, counted from `sent`.
enum Column : std::size_t {
  kSent = 0,
  kHeard,
  kRandom,
  kBurst,
  kRange,
  kPathLoss,
  kCollision,
  kHalfDuplex,
  kOutage,
  kDuplicates,
  kColumns
};

/// Sums of the columns sent ... duplicates of radio.csv over the whole run, by direction.
std::map<std::string, std::vector<long>> totals(const std::filesystem::path& table) {
  std::map<std::string, std::vector<long>> sums;
  std::istringstream lines(content(table));
  std::string line;
  std::getline(lines, line);
  while (std::getline(lines, line)) {
    std::vector<std::string> cells;
    std::istringstream row(line);
    for (std::string cell; std::getline(row, cell, ',');) cells.push_back(cell);
    auto& sum = sums[cells.at(2)];
    sum.resize(kColumns);
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += std::stol(cells.at(4 + i));
  }
  return sums;
}

TEST(Radio, WithoutLatencyAndLossGivesTheTablesOfTheIdealOne) {
  const TemporaryFolder folder;
  run(folder / "ideal", {});
  run(folder / "zero", {"--set", "radio.uplink.loss.rate=0", "--set", "radio.downlink.latency.constant_ms=0"});
  for (const std::string& table : kTables) {
    EXPECT_EQ(content(folder / "ideal" / table), content(folder / "zero" / table)) << table;
  }
  EXPECT_FALSE(std::filesystem::exists(folder / "ideal/radio.csv"));
  const auto sums = totals(folder / "zero/radio.csv");
  EXPECT_EQ(sums.at("uplink")[kSent], sums.at("uplink")[kHeard]);
  EXPECT_EQ(sums.at("downlink")[kSent], sums.at("downlink")[kHeard]);
  EXPECT_GT(sums.at("downlink")[kSent], 10'000);
}

TEST(Radio, ThatLosesAllAdviceGivesTheTrafficWithoutAdvice) {
  const TemporaryFolder folder;
  run(folder / "none", {"--rsu-algorithm", "none"});
  run(folder / "deaf", {"--set", "radio.downlink.loss.rate=1"});
  for (const std::string& table : kTables) {
    EXPECT_EQ(content(folder / "none" / table), content(folder / "deaf" / table)) << table;
  }
  run(folder / "deaf4", {"--set", "radio.preset=PC5_MODE4", "--set", "radio.downlink.loss.rate=1"});
  for (const std::string& table : kTables) {
    EXPECT_EQ(content(folder / "none" / table), content(folder / "deaf4" / table)) << table;
  }
  const auto sums = totals(folder / "deaf/radio.csv");
  EXPECT_EQ(sums.at("downlink")[kHeard], 0);
  EXPECT_EQ(sums.at("downlink")[kSent], sums.at("downlink")[kRandom]);
  EXPECT_GT(sums.at("downlink")[kSent], 10'000);
}

TEST(Radio, ReportsTheRatesThatItWasGiven) {
  const TemporaryFolder folder;
  run(folder / "r", {"--set", "radio.preset=HARSH", "--set", "radio.downlink.loss.rate=0.3"});
  const auto sums = totals(folder / "r/radio.csv");
  // Bursts come first, with a rate of 0.2; of the rest 30 % are lost on the way down. Over some 100,000 frames of 60
  // cars at a time the share of correlated losses varies by less than 0.02.
  for (const auto& [direction, random] : {std::pair("uplink", 0.0), std::pair("downlink", 0.3)}) {
    const std::vector<long>& sum = sums.at(direction);
    const auto sent = static_cast<double>(sum[kSent]);
    EXPECT_GT(sent, 30'000.0) << direction;
    EXPECT_NEAR(static_cast<double>(sum[kBurst]) / sent, 0.2, 0.02) << direction;
    EXPECT_NEAR(static_cast<double>(sum[kRandom]) / sent, 0.8 * random, 0.02) << direction;
    EXPECT_EQ(sum[kRange], 0) << direction;
    EXPECT_NEAR(static_cast<double>(sum[kDuplicates]) / static_cast<double>(sum[kHeard]), 0.01, 0.003) << direction;
    // What was neither lost nor heard is still under way when the run ends: half a second of frames at most.
    const long under_way = sum[kSent] - sum[kHeard] - sum[kRandom] - sum[kBurst] - sum[kRange];
    EXPECT_GE(under_way, 0) << direction;
    EXPECT_LT(under_way, 600) << direction;
  }
}

TEST(Radio, GivesTheSameBytesAsProcessesAndInOneProcess) {
  const TemporaryFolder folder;
  for (const std::string preset : {"HARSH", "PC5_MODE4"}) {
    const std::vector<std::string> set = {"--set", "radio.preset=" + preset, "--set", "radio.vehicle_to_vehicle={}"};
    run(folder / (preset + "-alone"), set);
    std::vector<std::string> arguments = {
        "run", "paper", "--duration", "200", "--quiet", "--out", folder / (preset + "-bus")};
    arguments.insert(arguments.end(), set.begin(), set.end());
    ASSERT_EQ(lukou(arguments).code, 0);
    EXPECT_EQ(differing_files(folder / (preset + "-bus"), folder / (preset + "-alone")), std::vector<std::string>{});
    EXPECT_EQ(lukou({"inspect", folder / (preset + "-bus")}).code, 0);
  }
}

TEST(Radio, OfMode4LosesByItsMechanismsAndCountsTheLoad) {
  const TemporaryFolder folder;
  run(folder / "r", {"--set", "radio.preset=PC5_MODE4", "--set", "radio.outages[0]={from_s: 100 to_s: 110}"});
  const auto sums = totals(folder / "r/radio.csv");
  for (const char* direction : {"uplink", "downlink"}) {
    const std::vector<long>& sum = sums.at(direction);
    EXPECT_GT(sum[kSent], 30'000) << direction;
    EXPECT_GT(sum[kCollision], 0) << direction;
    EXPECT_GT(sum[kHalfDuplex], 0) << direction;
    EXPECT_EQ(sum[kRandom] + sum[kBurst] + sum[kRange] + sum[kPathLoss] + sum[kDuplicates], 0) << direction;
    long lost = 0;
    for (std::size_t column = kRandom; column <= kOutage; ++column) lost += sum[column];
    EXPECT_GE(sum[kSent] - sum[kHeard] - lost, 0) << direction;
    EXPECT_LT(sum[kSent] - sum[kHeard] - lost, 200) << direction;  // under way: 100 ms of frames at most
  }
  // All that cars sent in 10 of 200 s, while the roads were filling in the first 60: between 1 and 2 times 5 %. The RSU
  // hears nobody, so it soon advises nobody.
  EXPECT_GT(sums.at("uplink")[kOutage], sums.at("uplink")[kSent] / 20);
  EXPECT_LT(sums.at("uplink")[kOutage], sums.at("uplink")[kSent] / 10);
  EXPECT_GT(sums.at("downlink")[kOutage], 0);
  // One car's frame in each of the 100 subframes, and some four frames of the RSU in each step: 1 % and some 4 %.
  const auto share = [&](const char* direction, Column column) {
    return static_cast<double>(sums.at(direction)[column]) / static_cast<double>(sums.at(direction)[kSent]);
  };
  EXPECT_NEAR(share("downlink", kHalfDuplex), 0.01, 0.005);
  EXPECT_GT(share("uplink", kHalfDuplex), 0.015);
  EXPECT_LT(share("uplink", kHalfDuplex), 0.1);
  const std::string summary = content(folder / "r/summary.json");
  EXPECT_NE(summary.find("\"half_duplex\": "), std::string::npos);
  EXPECT_NE(summary.find("\"outage\": "), std::string::npos);
}

TEST(Radio, ThatChangesLiveReplaysByteForByte) {
  const TemporaryFolder folder;
  const std::string id = fresh_run_id();
  Program launcher(
      {"run", "paper", "--duration", "200", "--pace", "50", "--quiet", "--run-id", id, "--out", folder / "r"});
  ASSERT_TRUE(wait_for_step(id, 200));
  EXPECT_EQ(lukou({"ctl", id, "set", "radio.downlink.loss.rate=0.3"}).code, 0);
  EXPECT_EQ(lukou({"ctl", id, "pause"}).code, 0);
  EXPECT_EQ(lukou({"ctl", id, "step", "50"}).code, 0);
  EXPECT_EQ(lukou({"ctl", id, "set", "radio.uplink.latency={gamma {min_ms: 50 mean_ms: 150}}"}).code, 0);
  EXPECT_EQ(lukou({"ctl", id, "set", "radio.uplink.path_loss={law: WINNER_B1}"}).code, 0);
  EXPECT_EQ(lukou({"ctl", id, "set", "radio.load={sub_channels: 2}"}).code, 0);
  EXPECT_EQ(lukou({"ctl", id, "set", "radio.uplink.collisions=true"}).code, 0);
  EXPECT_EQ(lukou({"ctl", id, "set", "radio.downlink.collisions=true"}).code, 0);
  EXPECT_EQ(lukou({"ctl", id, "set", "radio.downlink.half_duplex=true"}).code, 0);
  EXPECT_EQ(lukou({"ctl", id, "set", "radio.reservation={keep_probability: 0.5}"}).code, 0);
  EXPECT_EQ(lukou({"ctl", id, "set", "radio.outages[0]={from_s: 100 to_s: 120 approach: WEST}"}).code, 0);
  EXPECT_EQ(lukou({"ctl", id, "set", "radio.uplink.loss.rate=7"}).code, 2);
  EXPECT_EQ(lukou({"ctl", id, "pace", "max"}).code, 0);
  EXPECT_EQ(lukou({"ctl", id, "resume"}).code, 0);
  EXPECT_EQ(launcher.wait(), 0) << launcher.err();
  for (const std::string mode : {"in-process", "processes"}) {
    const Finished replay = lukou({"run", folder / "r/scenario.textproto", "--mode", mode, "--quiet",
                                   "--replay-directives", folder / "r/directives.textproto", "--out", folder / mode});
    ASSERT_EQ(replay.code, 0) << replay.err;
    EXPECT_EQ(differing_files(folder / "r", folder / mode), std::vector<std::string>{}) << mode;
  }
  const auto sums = totals(folder / "r/radio.csv");
  EXPECT_GT(sums.at("downlink")[kRandom], 0);
  EXPECT_EQ(sums.at("uplink")[kRandom], 0);
  EXPECT_GT(sums.at("uplink")[kCollision], 0);
  EXPECT_GT(sums.at("downlink")[kCollision], 0);
  EXPECT_GT(sums.at("downlink")[kHalfDuplex], 0);
  EXPECT_GT(sums.at("uplink")[kOutage], 0);
}

TEST(Radio, OfBadValuesIsRefusedWithPlaceAndRange) {
  const TemporaryFolder folder;
  const Finished refused = lukou({"validate", "paper", "--set", "radio.downlink.loss.rate=1.5"});
  EXPECT_EQ(refused.code, 2);
  EXPECT_NE(refused.err.find("radio.downlink.loss.rate is 1.5, must be within [0, 1]"), std::string::npos)
      << refused.err;
}

}  // namespace
}  // namespace lukou::test
