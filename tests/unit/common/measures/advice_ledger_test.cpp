#include "common/measures/advice_ledger.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace lukou {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// One car, vehicle 4 on WC, that is on the road from step 0 on.
class Log {
 public:
  Log() {
    batch_.entered_vehicle = {4};
    batch_.entered_lane = {1};
    next(kNone);
  }
  void fate(AdviceFate fate, std::uint32_t sequence, Step issued, bool again = false, std::uint32_t vehicle = 4,
            AdviceKind kind = AdviceKind::kAcceleration) {
    batch_.fate_vehicle.push_back(vehicle);
    batch_.fate_rsu.push_back(0);
    batch_.fate_sequence.push_back(sequence);
    batch_.fate.push_back(static_cast<std::uint8_t>(fate));
    batch_.fate_again.push_back(again ? 1 : 0);
    batch_.fate_issued.push_back(issued);
    batch_.fate_commanded_mps2.push_back(-0.5);
    batch_.fate_kind.push_back(static_cast<std::uint8_t>(kind));
    batch_.fate_speed_mps.push_back(kind == AdviceKind::kLaneSpeed ? 12.5 : kNone);
  }
  void next(double commanded_mps2, GuidanceState state = GuidanceState::kInForce) {
    batch_.step = step_++;
    batch_.vehicle = {4};
    batch_.commanded_mps2 = {commanded_mps2};
    batch_.guidance = {static_cast<std::uint8_t>(state)};
    ledger_.add(batch_);
    for (const SettledAdvice& advice : ledger_.settled()) rows.push_back(advice);
    batch_.clear();
  }
  [[nodiscard]] const AdviceLedger& ledger() const { return ledger_; }
  std::vector<SettledAdvice> rows;

 private:
  AdviceLedger ledger_;
  TrafficBatch batch_;
  Step step_ = 0;
};

TEST(AdviceLedger, SettlesAtOnceWhatWasNeverUsed) {
  Log log;
  log.fate(AdviceFate::kLostBurst, 7, 0);
  log.fate(AdviceFate::kUnknownVehicle, 8, 0, false, 4294967295U);
  log.fate(AdviceFate::kMalformed, 9, -1, false, 4294967295U);
  log.next(kNone, GuidanceState::kNeverAdvised);
  ASSERT_EQ(log.rows.size(), 3U);
  EXPECT_EQ(log.rows[0].fate, "lost_burst");
  EXPECT_EQ(log.rows[0].issued, 0);
  EXPECT_EQ(log.rows[0].vehicle, 4U);
  EXPECT_EQ(log.rows[0].lane, static_cast<Lane>(1));
  EXPECT_FALSE(log.rows[0].first_used);
  EXPECT_EQ(log.rows[1].fate, "unknown_vehicle");
  EXPECT_FALSE(log.rows[1].vehicle);
  EXPECT_FALSE(log.rows[1].lane);
  EXPECT_FALSE(log.rows[2].issued);
}

TEST(AdviceLedger, SettlesUsedAdviceWhenANewerOneTakesItsPlace) {
  Log log;
  log.fate(AdviceFate::kApplied, 1, 0);
  log.next(-0.5);
  log.next(-0.5);
  EXPECT_TRUE(log.rows.empty());
  log.fate(AdviceFate::kChangedFollowing, 2, 2);
  log.next(-0.5);
  ASSERT_EQ(log.rows.size(), 1U);
  EXPECT_EQ(log.rows[0].sequence, 1U);
  EXPECT_EQ(log.rows[0].first_used, 1);
  EXPECT_EQ(log.rows[0].last_used, 2);
  EXPECT_EQ(log.rows[0].settled, 3);
}

TEST(AdviceLedger, SettlesUsedAdviceWhenItsCarDrivesWithoutIt) {
  Log log;
  log.fate(AdviceFate::kApplied, 1, 0);
  log.next(-0.5);
  log.next(kNone, GuidanceState::kExpired);
  ASSERT_EQ(log.rows.size(), 1U);
  EXPECT_EQ(log.rows[0].last_used, 1);
  // Used in the very step in which the car crosses the line.
  log.fate(AdviceFate::kApplied, 2, 2);
  log.next(-0.5, GuidanceState::kPastStopLine);
  ASSERT_EQ(log.rows.size(), 2U);
  EXPECT_EQ(log.rows[1].last_used, 3);
  EXPECT_EQ(log.rows[1].settled, 3);
}

TEST(AdviceLedger, KeepsTheLastFateOfAnAdviceAndNoDuplicates) {
  Log log;
  log.fate(AdviceFate::kApplied, 1, 0);
  log.fate(AdviceFate::kDuplicate, 1, 0);
  log.next(-0.5);
  log.fate(AdviceFate::kChangedGuard, 1, 0, true);
  log.next(-0.5);
  EXPECT_TRUE(log.rows.empty());
  const auto rest = log.ledger().close();
  ASSERT_EQ(rest.size(), 1U);
  EXPECT_EQ(rest[0].fate, "changed_guard");
  EXPECT_EQ(rest[0].settled, 2);
  EXPECT_EQ(rest[0].first_used, 1);
}

TEST(AdviceLedger, SettlesASpeedForTheLaneAtItsFirstUseBesideTheAdviceInForce) {
  Log log;
  log.fate(AdviceFate::kApplied, 7, 0);
  log.next(-0.5);
  log.fate(AdviceFate::kApplied, 8, 1, false, 4, AdviceKind::kLaneSpeed);
  log.next(-0.5);
  ASSERT_EQ(log.rows.size(), 1U);
  EXPECT_EQ(log.rows[0].kind, "lane_speed");
  EXPECT_EQ(log.rows[0].speed_mps, 12.5);
  EXPECT_EQ(log.rows[0].first_used, 2);
  EXPECT_FALSE(log.rows[0].last_used);
  const auto rest = log.ledger().close();
  ASSERT_EQ(rest.size(), 1U);
  EXPECT_EQ(rest[0].sequence, 7U);
  EXPECT_EQ(rest[0].kind, "acceleration");
}

}  // namespace
}  // namespace lukou
