#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "services/rsu/rsu_node.hpp"
#include "tests/unit/services/rsu/rsu_rig.hpp"

namespace lukou {
namespace {

RsuConfig with_uplink(const LinkModel& uplink) {
  RsuConfig changed = config();
  changed.radio = {.seed = 1, .modelled = true, .uplink = uplink, .downlink = {}};
  return changed;
}

LinkModel late_by(double latency_ms) {
  return {.latency = {.law = LatencyModel::Law::kConstant, .min_ms = latency_ms}};
}

/// An RSU that hears one car, which sends in the steps 0, 1, ... and stands 100 m before the line.
class Listening {
 public:
  explicit Listening(const LinkModel& uplink)
      : node_(with_uplink(uplink), std::make_unique<Scripted>([this](const RsuView& heard, RsuAnswer&) {
                ages_.clear();
                for (const HeardCar& car : heard.lanes[1].cars) ages_.push_back(car.age);
              })) {}

  void step(bool car_speaks = true) {
    AirBatch air;
    air.step = next_;
    if (car_speaks) {
      add_car(air, 5, 100.0, 0.0);
      air.frames.sequence[0] = static_cast<std::uint32_t>(next_);
    }
    const SignalBatch signal = signals(next_);
    node_.step(next_++, &signal, air, out_);
  }
  [[nodiscard]] const std::vector<Step>& ages() const { return ages_; }
  [[nodiscard]] const RoadsideBatch& out() const { return out_; }
  [[nodiscard]] RsuNode& node() { return node_; }

 private:
  std::vector<Step> ages_;
  RsuNode node_;
  RoadsideBatch out_;
  Step next_ = 0;
};

TEST(RsuNodeRadio, HearsAtOnceWhatHasNoLatency) {
  Listening rsu(LinkModel{});
  rsu.step();
  EXPECT_EQ(rsu.ages(), (std::vector<Step>{0}));
  ASSERT_EQ(rsu.out().reception.size(), 1U);
  EXPECT_EQ(rsu.out().reception.direction[0], static_cast<std::uint8_t>(Direction::kUplink));
  EXPECT_EQ(rsu.out().reception.sent[0], 1U);
  EXPECT_EQ(rsu.out().reception.heard[0], 1U);
}

TEST(RsuNodeRadio, ReportsNothingUnderTheIdealRadio) {
  RsuNode node = idle_node();
  const SignalBatch signal = signals(0);
  AirBatch air;
  add_car(air, 5, 100.0, 0.0);
  RoadsideBatch out;
  node.step(0, &signal, air, out);
  EXPECT_EQ(out.reception.size(), 0U);
  EXPECT_EQ(out.frames_heard, 1U);
}

TEST(RsuNodeRadio, SeesCarsAsOldAsTheLatencyMakesThem) {
  // 300 ms after a generation inside (t_(k-1), t_k]: heard at t_(k+3), or earlier by nothing.
  Listening rsu(late_by(300.0));
  for (int k = 0; k < 3; ++k) {
    rsu.step();
    EXPECT_TRUE(rsu.ages().empty());
    EXPECT_EQ(rsu.out().frames_heard, 0U);
  }
  for (int k = 3; k < 10; ++k) {
    rsu.step();
    EXPECT_EQ(rsu.ages(), (std::vector<Step>{3}));
    EXPECT_EQ(rsu.out().reception.latency_ms, (std::vector<double>{300.0}));
  }
}

TEST(RsuNodeRadio, CountsWhatIsLostAndWhy) {
  LinkModel model;
  model.loss_rate = 1.0;
  Listening rsu(model);
  rsu.step();
  EXPECT_TRUE(rsu.ages().empty());
  EXPECT_EQ(rsu.out().reception.lost_random[0], 1U);
  // The car is 115.5 m from the centre of the junction, and 5.25 m beside the axis.
  model = {};
  model.range_m = 100.0;
  rsu.node().change(with_uplink(model));
  rsu.step();
  EXPECT_EQ(rsu.out().reception.lost_range[0], 1U);
  model.path_loss = {.law = PathLossModel::Law::kTr37885, .sensitivity_dbm = -20.0};
  model.range_m = 130.0;
  rsu.node().change(with_uplink(model));
  rsu.step();
  EXPECT_EQ(rsu.out().reception.lost_path_loss[0], 1U);
  EXPECT_TRUE(std::isnan(rsu.out().reception.busy_ratio[0]));
  model.path_loss = {};
  rsu.node().change(with_uplink(model));
  rsu.step();
  EXPECT_EQ(rsu.ages(), (std::vector<Step>{0}));
}

TEST(RsuNodeRadio, TellsOfEachFrameWhetherItIsHeardAndWhen) {
  Listening late(late_by(300.0));
  late.step();
  EXPECT_EQ(late.out().uplink.fate, std::vector<std::uint8_t>{kFrameHeard});
  EXPECT_EQ(late.out().uplink.due, std::vector<Step>{3}) << "generated inside (t-1, t0]";
  EXPECT_EQ(late.out().uplink.latency_ms, std::vector<double>{300.0});
  LinkModel near;
  near.range_m = 50.0;
  Listening far(near);
  far.step();
  EXPECT_EQ(far.out().uplink.fate, std::vector<std::uint8_t>{1 + static_cast<std::uint8_t>(LossCause::kRange)});
  far.step(false);
  EXPECT_EQ(far.out().uplink.size(), 0U) << "nobody spoke";
}

TEST(RsuNodeRadio, DropsDuplicates) {
  LinkModel twice;
  twice.duplicate_rate = 1.0;
  Listening rsu(twice);
  rsu.step();
  EXPECT_EQ(rsu.out().frames_heard, 1U);
  EXPECT_EQ(rsu.out().reception.heard[0], 1U);
  EXPECT_EQ(rsu.out().reception.duplicates[0], 1U);
}

TEST(RsuNodeRadio, KeepsTheNewerReportWhenAnOlderOneComesLater) {
  // With latencies of up to half a second frames overtake each other. What the RSU knows of the car must then get
  // older by a step in each step, or newer, but never older by more.
  Listening rsu({.latency = {.law = LatencyModel::Law::kUniform, .min_ms = 0.0, .max_ms = 500.0}});
  Step last_age = 0;
  bool known = false;
  for (int k = 0; k < 300; ++k) {
    rsu.step();
    if (known) {
      ASSERT_EQ(rsu.ages().size(), 1U) << k;
      EXPECT_LE(rsu.ages()[0], last_age + 1) << k;
    }
    known = known || !rsu.ages().empty();
    if (known) last_age = rsu.ages()[0];
  }
  EXPECT_TRUE(known);
}

}  // namespace
}  // namespace lukou
