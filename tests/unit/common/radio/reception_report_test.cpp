#include "common/radio/reception_report.hpp"

#include <gtest/gtest.h>

namespace lukou {
namespace {

TEST(ReceptionReport, HoldsWhatTheTalliesCounted) {
  ReceptionTally tally;
  for (const auto cause : {LossCause::kRandom, LossCause::kBurst, LossCause::kBurst, LossCause::kRange,
                           LossCause::kPathLoss, LossCause::kCollision, LossCause::kCollision, LossCause::kHalfDuplex,
                           LossCause::kHalfDuplex, LossCause::kHalfDuplex, LossCause::kOutage}) {
    tally.count_sent({.lost = cause, .first = {}, .second = {}});
  }
  tally.count_sent({});
  tally.count_delivered(12.5, false);
  tally.count_delivered(30.0, true);
  tally.busy_ratio = 0.25;
  ReceptionReport report;
  report.add(Direction::kDownlink, FrameKind::kRsc, tally);
  EXPECT_EQ(report.size(), 1U);
  EXPECT_EQ(report.sent[0], 12U);
  EXPECT_EQ(report.heard[0], 1U);
  EXPECT_EQ(report.lost_random[0], 1U);
  EXPECT_EQ(report.lost_burst[0], 2U);
  EXPECT_EQ(report.lost_range[0], 1U);
  EXPECT_EQ(report.lost_path_loss[0], 1U);
  EXPECT_EQ(report.lost_collision[0], 2U);
  EXPECT_EQ(report.lost_half_duplex[0], 3U);
  EXPECT_EQ(report.lost_outage[0], 1U);
  EXPECT_EQ(report.busy_ratio[0], 0.25);
  EXPECT_EQ(report.duplicates[0], 1U);
  EXPECT_EQ(report.latency_ms, (std::vector<double>{12.5}));

  ReceptionReport both = report;
  both.add(report);
  EXPECT_EQ(both.size(), 2U);
  EXPECT_TRUE(both.well_formed());
  both.latency_ms.pop_back();
  EXPECT_FALSE(both.well_formed());
  both = report;
  both.kind.clear();
  EXPECT_FALSE(both.well_formed());
  report.clear();
  EXPECT_EQ(report.size(), 0U);
  EXPECT_TRUE(report.well_formed());
}

}  // namespace
}  // namespace lukou
