#include "services/lukou/compare/judgement.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "services/lukou/compare/comparison_text.hpp"

namespace lukou::compare {
namespace {

using studies::RunRecord;

const std::vector<std::string> kDelay = {"mean_delay_s"};

RunRecord run(std::uint64_t seed, double delay_s, double arrived = 100.0) {
  RunRecord record;
  record.key.seed = seed;
  record.state = RunRecord::State::kDone;
  record.arrived = record.left = arrived;
  record.values = {delay_s};
  return record;
}

Side side(const std::string& name, std::vector<RunRecord> runs, const std::string& label = "") {
  Group group{.label = label, .runs = std::move(runs), .folders = {}};
  group.folders.resize(group.runs.size());
  return {.name = name, .measures = kDelay, .groups = {group}};
}

TEST(Judgement, PairsRunsOfTheSameSeedWhateverTheirOrder) {
  const Side a = side("a", {run(1, 10.0), run(2, 12.0), run(3, 14.0)});
  const Side b = side("b", {run(3, 15.0), run(2, 13.5), run(1, 11.0)});
  const auto found = compare(a, b, kDelay, 0.95);
  ASSERT_TRUE(found);
  const Judgement& judgement = found.value().groups.front().measures.front();
  EXPECT_EQ(judgement.basis, Basis::kSeeds);
  // Differences -1, -1.5, -1: t = -7, with two degrees p = 1 - 7 / sqrt(51); t(0.95, 2) = 4.302653.
  EXPECT_NEAR(judgement.found.paired.difference.mean, -3.5 / 3.0, 1e-12);
  EXPECT_NEAR(*judgement.found.paired.difference.half_width, 4.302653 * 0.288675 / std::sqrt(3.0), 1e-5);
  EXPECT_NEAR(judgement.found.paired.p, 1.0 - 7.0 / std::sqrt(51.0), 1e-9);
  EXPECT_TRUE(found.value().differs());
  EXPECT_TRUE(found.value().warnings.empty()) << found.value().warnings.front();
  EXPECT_NE(text(found.value()).find("A lower by"), std::string::npos) << text(found.value());
}

TEST(Judgement, FindsNoDifferenceBetweenAResultAndItself) {
  const Side a = side("a", {run(1, 10.0), run(2, 12.0)});
  const auto found = compare(a, a, kDelay, 0.95);
  ASSERT_TRUE(found);
  EXPECT_FALSE(found.value().differs());
  EXPECT_NE(text(found.value()).find("equal"), std::string::npos);
}

TEST(Judgement, TestsRunsOfDifferentSeedsByWelchAndSaysSo) {
  // Means 11 and 21, both with variance 2 over 2 runs: t = -10 / sqrt(2), two degrees, p = 1 - t / sqrt(t^2 + 2).
  const Side a = side("a", {run(1, 10.0), run(2, 12.0)});
  const Side b = side("b", {run(3, 20.0), run(4, 22.0)});
  const auto found = compare(a, b, kDelay, 0.95);
  ASSERT_TRUE(found);
  const Judgement& judgement = found.value().groups.front().measures.front();
  EXPECT_EQ(judgement.basis, Basis::kApart);
  EXPECT_NEAR(judgement.found.paired.p, 1.0 - std::sqrt(50.0 / 52.0), 1e-9);
  ASSERT_EQ(found.value().warnings.size(), 1U);
  EXPECT_NE(found.value().warnings.front().find("no seed is in both"), std::string::npos);
}

TEST(Judgement, TellsThatArrivalsDifferAndThatRunsHaveNoPartner) {
  const Side a = side("a", {run(1, 10.0), run(2, 12.0), run(9, 12.0)});
  const Side b = side("b", {run(1, 11.0), run(2, 12.0, 120.0)});
  const auto found = compare(a, b, kDelay, 0.95);
  ASSERT_TRUE(found);
  ASSERT_EQ(found.value().warnings.size(), 2U);
  EXPECT_NE(found.value().warnings[0].find("in 1 of 2 pairs"), std::string::npos);
  EXPECT_NE(found.value().warnings[1].find("1 runs have no partner"), std::string::npos);
}

TEST(Judgement, DoesNotCompareRunsThatAnAnomalyEnded) {
  Side a = side("a", {run(1, 10.0), run(2, 10.1), run(3, 10.2)});
  a.groups.front().runs[1].state = RunRecord::State::kAnomaly;
  const Side b = side("b", {run(1, 20.0), run(2, 20.2), run(3, 20.3)});
  const auto found = compare(a, b, kDelay, 0.95);
  ASSERT_TRUE(found);
  EXPECT_FALSE(found.value().differs());
  EXPECT_NE(text(found.value()).find("not comparable"), std::string::npos);
}

TEST(Judgement, MatchesCellsByTheirLabelAndRefusesSidesWithoutACommonOne) {
  Side a = side("a", {run(1, 10.0), run(2, 12.0)}, "latency 0 ms");
  a.groups.push_back({.label = "latency 200 ms", .runs = {run(1, 20.0), run(2, 22.0)}, .folders = {"", ""}});
  Side b = side("b", {run(1, 21.0), run(2, 23.0)}, "latency 200 ms");
  b.groups.push_back({.label = "latency 400 ms", .runs = {run(1, 0.0)}, .folders = {""}});
  const auto found = compare(a, b, kDelay, 0.95);
  ASSERT_TRUE(found);
  ASSERT_EQ(found.value().groups.size(), 1U);
  EXPECT_EQ(found.value().groups.front().label, "latency 200 ms");
  EXPECT_DOUBLE_EQ(found.value().groups.front().measures.front().found.paired.difference.mean, -1.0);

  b.groups.erase(b.groups.begin());
  b.groups.push_back({.label = "latency 900 ms", .runs = {run(1, 0.0)}, .folders = {""}});
  const auto none = compare(a, b, kDelay, 0.95);
  ASSERT_FALSE(none);
  EXPECT_NE(none.error().what.find("no cell in common"), std::string::npos);
}

}  // namespace
}  // namespace lukou::compare
