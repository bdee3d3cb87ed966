#include "common/measures/safety_measures.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace lukou {
namespace {

constexpr std::uint8_t kWestCenter = 1;
constexpr std::uint8_t kSouthCenter = 4;

/// Writes batches by hand. A road of 500 m, cars of 4.5 m.
class Script {
 public:
  void enter(std::uint32_t vehicle, bool equipped = false) {
    batch_.entered_vehicle.push_back(vehicle);
    batch_.entered_equipped.push_back(equipped ? 1 : 0);
    equipped_.resize(std::max<std::size_t>(equipped_.size(), vehicle + 1));
    equipped_[vehicle] = equipped;
  }
  struct At {
    double position_m = 0.0;
    double speed_mps = 0.0;
    double acceleration_mps2 = 0.0;
    bool guided = false;
    std::uint8_t lane = kWestCenter;
  };
  void drive(std::uint32_t vehicle, const At& at) {
    batch_.vehicle.push_back(vehicle);
    batch_.lane.push_back(at.lane);
    batch_.equipped.push_back(equipped_[vehicle] ? 1 : 0);
    batch_.position_m.push_back(at.position_m);
    batch_.speed_mps.push_back(at.speed_mps);
    batch_.acceleration_mps2.push_back(at.acceleration_mps2);
    batch_.guidance.push_back(
        static_cast<std::uint8_t>(at.guided ? GuidanceState::kInForce : GuidanceState::kNotEquipped));
  }
  void leave(std::uint32_t vehicle) { batch_.left_vehicle.push_back(vehicle); }
  void next() {
    batch_.step = step_++;
    measures_.add(batch_);
    take(measures_.finished());
    batch_.clear();
  }
  void close() { take(measures_.close()); }
  [[nodiscard]] const std::vector<Encounter>& rows() const { return rows_; }
  [[nodiscard]] std::vector<Encounter> rows(SafetyKind kind) const {
    std::vector<Encounter> found;
    for (const Encounter& row : rows_) {
      if (row.kind == kind) found.push_back(row);
    }
    return found;
  }
  [[nodiscard]] SafetyFigures figures() const { return measures_.figures(); }
  [[nodiscard]] Step step() const { return step_; }

 private:
  void take(std::span<const Encounter> rows) { rows_.insert(rows_.end(), rows.begin(), rows.end()); }

  SafetyMeasures measures_{RoadLengths{}, 4.5};
  TrafficBatch batch_;
  std::vector<bool> equipped_;
  std::vector<Encounter> rows_;
  Step step_ = 0;
};

TEST(SafetyMeasures, ReportAnApproachToAStandingCarOnceWithItsWorstMoment) {
  Script script;
  script.enter(0);
  script.enter(4, true);
  // The leader's rear is at 395.5 m. At 10 m/s TTC is below 3 s from a gap of less than 30 m on, DRAC = 50 / gap
  // reaches 3 m/s2 at 16.7 m. The follower comes to a gap of 20.5 m and then stands: TTC 2.05 s, DRAC 2.44, no
  // encounter of it.
  const double fronts_m[] = {345.0, 355.0, 365.0, 370.0, 375.0};  // gaps of 50.5, 40.5, 30.5, 25.5 and 20.5 m
  for (const double front_m : fronts_m) {
    script.drive(0, {.position_m = 400.0});
    script.drive(4, {.position_m = front_m, .speed_mps = 10.0, .guided = front_m > 372.0});
    script.next();
  }
  for (int i = 0; i < 12; ++i) {
    script.drive(0, {.position_m = 400.0});
    script.drive(4, {.position_m = 375.0});
    script.next();
  }
  const auto ttc = script.rows(SafetyKind::kTtc);
  ASSERT_EQ(ttc.size(), 1U);
  EXPECT_EQ(ttc[0].vehicle, 4U);
  EXPECT_EQ(ttc[0].other, 0U);
  EXPECT_EQ(ttc[0].began, 3);
  EXPECT_EQ(ttc[0].last, 4);
  EXPECT_EQ(ttc[0].worst, 4);
  EXPECT_EQ(ttc[0].ended, 14);  // a second after the last
  EXPECT_DOUBLE_EQ(ttc[0].value, 2.05);
  EXPECT_DOUBLE_EQ(ttc[0].distance_m, 125.0);
  EXPECT_DOUBLE_EQ(ttc[0].speed_mps, 10.0);
  EXPECT_TRUE(ttc[0].guided);
  EXPECT_EQ(ttc[0].equipped, true);
  EXPECT_EQ(ttc[0].other_equipped, false);
  EXPECT_TRUE(script.rows(SafetyKind::kDrac).empty());
  const SafetyFigures figures = script.figures();
  EXPECT_EQ(figures.all.count(SafetyKind::kTtc), 1U);
  EXPECT_EQ(figures.equipped.count(SafetyKind::kTtc), 1U);
  EXPECT_EQ(figures.unequipped.count(SafetyKind::kTtc), 0U);
  EXPECT_EQ(figures.guided.count(SafetyKind::kTtc), 1U);
  EXPECT_EQ(figures.all.ttc_critical, 0U);
  EXPECT_DOUBLE_EQ(*figures.all.ttc_min_s, 2.05);
  EXPECT_EQ(figures.all.driven_steps, 34U);  // two cars, 17 steps
  EXPECT_EQ(figures.guided.driven_steps, 1U);
}

TEST(SafetyMeasures, CountWhatIsCritical) {
  Script script;
  script.enter(0);
  script.enter(4);
  script.drive(0, {.position_m = 400.0});
  script.drive(4, {.position_m = 385.5, .speed_mps = 10.0});  // gap 10 m: TTC 1 s, DRAC 100 / 20 = 5 m/s2
  script.next();
  script.close();
  EXPECT_EQ(script.figures().all.ttc_critical, 1U);
  EXPECT_EQ(script.figures().all.drac_critical, 1U);
  ASSERT_EQ(script.rows(SafetyKind::kDrac).size(), 1U);
  EXPECT_DOUBLE_EQ(script.rows(SafetyKind::kDrac)[0].value, 5.0);
  EXPECT_EQ(script.rows(SafetyKind::kDrac)[0].ended, 0);
}

TEST(SafetyMeasures, SeeABrakingLeaderInTheModifiedTimeOnly) {
  Script script;
  script.enter(0);
  script.enter(4);
  // Equally fast, 8 m apart, the leader brakes with 2.5: 8 = 1.25 t^2, t = 2.53 s. TTC and DRAC do not see it.
  script.drive(0, {.position_m = 300.0, .speed_mps = 12.0, .acceleration_mps2 = -2.5});
  script.drive(4, {.position_m = 287.5, .speed_mps = 12.0});
  script.next();
  script.close();
  ASSERT_EQ(script.rows().size(), 1U);
  EXPECT_EQ(script.rows()[0].kind, SafetyKind::kMttc);
  EXPECT_NEAR(script.rows()[0].value, 2.5298, 1e-4);
}

TEST(SafetyMeasures, JoinWhatIsLessThanASecondApartAndSplitWhatIsMore) {
  Script script;
  script.enter(0);
  const auto brake = [&](double acceleration_mps2) {
    script.drive(0, {.position_m = 100.0, .speed_mps = 20.0, .acceleration_mps2 = acceleration_mps2});
    script.next();
  };
  brake(-3.5);  // step 0
  for (int i = 0; i < 8; ++i) brake(-2.9);
  brake(-4.0);  // step 9: 0.9 s later
  for (int i = 0; i < 10; ++i) brake(0.0);
  brake(-3.2);  // step 20
  script.close();
  const auto rows = script.rows(SafetyKind::kHardBraking);
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_EQ(rows[0].began, 0);
  EXPECT_EQ(rows[0].last, 9);
  EXPECT_DOUBLE_EQ(rows[0].value, -4.0);
  EXPECT_FALSE(rows[0].other);
  EXPECT_EQ(rows[1].began, 20);
  EXPECT_DOUBLE_EQ(rows[1].value, -3.2);
}

TEST(SafetyMeasures, TakeTheJerkFromSpeedsHalfASecondApart) {
  Script script;
  script.enter(0);
  // Constant 20 m/s to step 5, then -2 m/s2: at step 10 (19 - 2 * 20 + 20) / 0.25 = -4 m/s3, at step 15 18 - 2 * 19 +
  // 20 = 0.
  for (int k = 0; k <= 15; ++k) {
    script.drive(0, {.position_m = 100.0, .speed_mps = k <= 5 ? 20.0 : 20.0 - 0.2 * (k - 5)});
    script.next();
  }
  script.close();
  const auto rows = script.rows(SafetyKind::kJerk);
  ASSERT_EQ(rows.size(), 1U);
  EXPECT_NEAR(rows[0].value, -4.0, 1e-9);
  EXPECT_EQ(rows[0].worst, 10);
}

TEST(SafetyMeasures, BeginAnewBehindAnotherCar) {
  Script script;
  script.enter(0);
  script.enter(4);
  script.enter(8);
  script.drive(0, {.position_m = 595.0});
  script.drive(8, {.position_m = 570.5, .speed_mps = 10.0});  // 20 m behind car 0: 2 s
  script.next();
  script.leave(0);
  script.drive(4, {.position_m = 590.0});
  script.drive(8, {.position_m = 571.5, .speed_mps = 10.0});  // 14 m behind car 4: 1.4 s
  script.next();
  script.leave(4);
  script.leave(8);
  script.next();
  const auto rows = script.rows(SafetyKind::kTtc);
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_EQ(rows[0].other, 0U);
  EXPECT_DOUBLE_EQ(rows[0].value, 2.0);
  EXPECT_EQ(rows[1].other, 4U);
  EXPECT_DOUBLE_EQ(rows[1].value, 1.4);
  EXPECT_EQ(rows[1].ended, 2);  // when it left
}

TEST(SafetyMeasures, RememberForACrossingWhetherGuidanceWasInForceShortlyBefore) {
  Script script;
  script.enter(0);
  script.enter(1, true);
  // Both at 10 m/s. From the west the front is at its line at 0.1 s, from the south at 1.9 s: the car from the south
  // comes 1.8 s + (8.45 - 22.55 - 4.5) / 10 = -0.06 s after the other's rear, to 0.25 m of each border: so before it,
  // or hardly after it; in any case below 2 s.
  for (int k = 0; k <= 40; ++k) {
    script.drive(0, {.position_m = 499.0 + k, .speed_mps = 10.0});
    script.drive(1, {.position_m = 481.0 + k, .speed_mps = 10.0, .guided = 481 + k <= 501, .lane = kSouthCenter});
    script.next();
  }
  script.close();
  const auto rows = script.rows(SafetyKind::kPet);
  ASSERT_EQ(rows.size(), 1U);
  EXPECT_EQ(rows[0].vehicle, 1U);
  EXPECT_EQ(rows[0].other, 0U);
  EXPECT_TRUE(rows[0].guided);
  EXPECT_LT(rows[0].value, 0.1);
  EXPECT_NEAR(rows[0].distance_m, -8.45, 0.25);
  EXPECT_EQ(script.figures().equipped.count(SafetyKind::kPet), 1U);
}

TEST(SafetyMeasures, CountOpposedLeftsOutsideTheTotals) {
  Script script;
  script.enter(0);
  script.enter(2);
  constexpr std::uint8_t kWestLeft = 0;
  constexpr std::uint8_t kEastCenter = 7;
  for (int k = 0; k <= 60; ++k) {
    script.drive(0, {.position_m = 499.0 + k, .speed_mps = 10.0, .lane = kWestLeft});
    script.drive(2, {.position_m = 479.0 + k, .speed_mps = 10.0, .lane = kEastCenter});
    script.next();
  }
  EXPECT_EQ(script.figures().opposed_lefts, 1U);
  EXPECT_EQ(script.figures().all.count(SafetyKind::kPet), 0U);
  EXPECT_EQ(script.figures().all.count(SafetyKind::kPetOpposedLeft), 0U);
  EXPECT_EQ(script.rows(SafetyKind::kPetOpposedLeft).size(), 1U);
}

}  // namespace
}  // namespace lukou
