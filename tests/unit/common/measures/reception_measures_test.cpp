#include "common/measures/reception_measures.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace lukou {
namespace {

ReceptionReport report(Direction direction, FrameKind kind, std::uint32_t sent, std::vector<double> latency_ms) {
  ReceptionTally tally;
  tally.sent = sent;
  tally.heard = static_cast<std::uint32_t>(latency_ms.size());
  tally.lost_burst = 1;
  tally.latency_ms = std::move(latency_ms);
  ReceptionReport report;
  report.add(direction, kind, tally);
  return report;
}

TEST(ReceptionMeasures, HaveNothingToSayOfTheIdealRadio) {
  ReceptionMeasures measures;
  measures.add({});
  EXPECT_FALSE(measures.any());
  EXPECT_TRUE(measures.take().empty());
}

TEST(ReceptionMeasures, AddUpWhatSeveralReportsSay) {
  ReceptionMeasures measures;
  ReceptionReport both = report(Direction::kDownlink, FrameKind::kRsc, 4, {10.0, 20.0});
  both.add(report(Direction::kUplink, FrameKind::kBsm, 2, {5.0}));
  measures.add(both);
  measures.add(report(Direction::kDownlink, FrameKind::kRsc, 3, {60.0}));
  const auto figures = measures.take();
  ASSERT_EQ(figures.size(), 2U);
  EXPECT_EQ(figures[0].direction, Direction::kUplink);
  EXPECT_EQ(figures[0].kind, FrameKind::kBsm);
  EXPECT_EQ(figures[0].latency_mean_ms, 5.0);
  EXPECT_EQ(figures[1].direction, Direction::kDownlink);
  EXPECT_EQ(figures[1].sent, 7U);
  EXPECT_EQ(figures[1].heard, 3U);
  EXPECT_EQ(figures[1].lost_burst, 2U);
  EXPECT_EQ(figures[1].latency_mean_ms, 30.0);  // (10 + 20 + 60) / 3
}

TEST(ReceptionMeasures, StartAgainWhenTheyAreTakenAndKeepTheirRows) {
  ReceptionMeasures measures;
  measures.add(report(Direction::kUplink, FrameKind::kBsm, 2, {5.0}));
  measures.take();
  const auto figures = measures.take();
  ASSERT_EQ(figures.size(), 1U);
  EXPECT_EQ(figures[0].kind, FrameKind::kBsm);
  EXPECT_EQ(figures[0].sent, 0U);
  EXPECT_FALSE(figures[0].latency_mean_ms.has_value());
  EXPECT_FALSE(figures[0].latency_p95_ms.has_value());
}

TEST(ReceptionMeasures, AverageTheBusyRatioOverTheReportsThatKnowIt) {
  ReceptionMeasures measures;
  for (const double ratio : {0.2, std::numeric_limits<double>::quiet_NaN(), 0.4}) {
    ReceptionReport said = report(Direction::kUplink, FrameKind::kBsm, 2, {5.0});
    said.busy_ratio[0] = ratio;
    said.lost_collision[0] = 3;
    measures.add(said);
  }
  const auto figures = measures.take();
  EXPECT_NEAR(figures.at(0).busy_ratio.value(), 0.3, 1e-12);
  EXPECT_EQ(figures.at(0).lost_collision, 9U);
  measures.add(report(Direction::kUplink, FrameKind::kBsm, 2, {5.0}));
  EXPECT_FALSE(measures.take().at(0).busy_ratio.has_value());
}

TEST(ReceptionMeasures, TakeThePercentilesByRank) {
  // Of 1 ... 40: rank ceil(0.95 * 40) = 38 and ceil(0.99 * 40) = 40.
  std::vector<double> latency_ms;
  for (int i = 40; i > 0; --i) latency_ms.push_back(i);
  ReceptionMeasures measures;
  measures.add(report(Direction::kUplink, FrameKind::kBsm, 40, latency_ms));
  const auto figures = measures.take();
  EXPECT_EQ(figures[0].latency_p95_ms, 38.0);
  EXPECT_EQ(figures[0].latency_p99_ms, 40.0);
}

}  // namespace
}  // namespace lukou
