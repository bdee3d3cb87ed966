#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>
#include <vector>

#include "common/messages/bsm.hpp"
#include "services/traffic_engine/engine_node.hpp"
#include "tests/unit/services/traffic_engine/drive.hpp"

namespace lukou {
namespace {

EngineConfig with_downlink(const LinkModel& downlink) {
  EngineConfig config = lone_car_from_the_west();
  config.radio = {.seed = 1, .modelled = true, .uplink = {}, .downlink = downlink};
  return config;
}

LinkModel late_by(double latency_ms) {
  return {.latency = {.law = LatencyModel::Law::kConstant, .min_ms = latency_ms}};
}

RoadsideBatch numbered(RoadsideBatch batch, std::uint32_t sequence) {
  batch.frames.sequence[0] = sequence;
  return batch;
}

std::vector<std::uint8_t> fates(std::initializer_list<AdviceFate> listed) {
  std::vector<std::uint8_t> values;
  for (const AdviceFate fate : listed) values.push_back(static_cast<std::uint8_t>(fate));
  return values;
}

TEST(EngineNodeRadio, WithoutLatencyAndLossActsAsTheIdealOne) {
  Drive ideal(lone_car_from_the_west());
  Drive modelled(with_downlink({}));
  for (Drive* drive : {&ideal, &modelled}) {
    drive->run_to(100);
    const RoadsideBatch batch = guidance(100, drive->air().frames.sender[0], -0.37);
    drive->step(&batch);
  }
  EXPECT_EQ(modelled.traffic().acceleration_mps2, ideal.traffic().acceleration_mps2);
  EXPECT_EQ(modelled.traffic().fate, ideal.traffic().fate);
  EXPECT_EQ(ideal.traffic().reception.size(), 0U);
  ASSERT_EQ(modelled.traffic().reception.size(), 1U);
  EXPECT_EQ(modelled.traffic().reception.sent[0], 1U);
  EXPECT_EQ(modelled.traffic().reception.heard[0], 1U);
}

TEST(EngineNodeRadio, LetsLateAdviceActWhenItArrivesAndEndWithItsLifetimeFromTheIssue) {
  // 200 ms after a generation inside (t_99, t_100]: heard at t_102 and used from step 103 on. Issued at t_100 for 500
  // ms it may act in the steps 101 ... 105.
  Drive drive(with_downlink(late_by(200.0)));
  drive.run_to(100);
  const RoadsideBatch batch = guidance(100, drive.air().frames.sender[0], -0.37, 500);
  drive.step(&batch);
  EXPECT_EQ(drive.traffic().reception.sent[0], 1U);
  EXPECT_EQ(drive.traffic().reception.heard[0], 0U);
  drive.run_to(102);
  EXPECT_TRUE(std::isnan(drive.traffic().commanded_mps2[0]));
  drive.step();
  EXPECT_EQ(drive.traffic().commanded_mps2[0], -0.37);
  EXPECT_EQ(drive.traffic().reception.latency_ms, (std::vector<double>{200.0}));
  drive.run_to(105);
  EXPECT_EQ(drive.traffic().commanded_mps2[0], -0.37);
  drive.step();
  EXPECT_TRUE(std::isnan(drive.traffic().commanded_mps2[0]));
}

TEST(EngineNodeRadio, RefusesAdviceThatArrivesAfterItsLifetime) {
  Drive drive(with_downlink(late_by(600.0)));
  drive.run_to(100);
  const RoadsideBatch batch = guidance(100, drive.air().frames.sender[0], -0.37, 500);
  drive.step(&batch);
  drive.run_to(107);  // heard at t_106
  EXPECT_EQ(drive.traffic().fate, fates({AdviceFate::kLate}));
}

TEST(EngineNodeRadio, SaysWhyAdviceIsLost) {
  LinkModel noisy;
  noisy.loss_rate = 1.0;
  LinkModel near;
  near.range_m = 50.0;  // the car is about 350 m away
  LinkModel weak;
  weak.path_loss = {.law = PathLossModel::Law::kTr37885, .sensitivity_dbm = -20.0};
  for (const auto& [model, fate] : {std::pair(noisy, AdviceFate::kLostRandom), std::pair(near, AdviceFate::kLostRange),
                                    std::pair(weak, AdviceFate::kLostPathLoss)}) {
    Drive drive(with_downlink(model));
    drive.run_to(100);
    const RoadsideBatch batch = guidance(100, drive.air().frames.sender[0], -0.37);
    drive.step(&batch);
    EXPECT_EQ(drive.traffic().fate, fates({fate}));
    EXPECT_EQ(drive.traffic().fate_vehicle[0], 0U);
    EXPECT_EQ(drive.traffic().fate_sequence[0], 41U);
    EXPECT_TRUE(std::isnan(drive.traffic().commanded_mps2[0]));
    const ReceptionReport& said = drive.traffic().reception;
    EXPECT_EQ(said.lost_random[0] + said.lost_range[0] + said.lost_path_loss[0], 1U);
  }
}

TEST(EngineNodeRadio, LosesAdviceInAPlannedOutageOfTheRsuThatSendsIt) {
  EngineConfig config = with_downlink({});
  config.radio.outages = {{.from = 100, .to = 101, .rsu = 2, .arm = Arm::kWest},
                          {.from = 101, .to = 102, .rsu = 0},
                          {.from = 101, .to = 102, .arm = Arm::kEast},
                          {.from = 101, .to = 102, .downlink = false}};
  Drive drive(config);
  drive.run_to(100);
  const RoadsideBatch lost = guidance(100, drive.air().frames.sender[0], -0.37);
  drive.step(&lost);
  EXPECT_EQ(drive.traffic().fate, fates({AdviceFate::kLostOutage}));
  EXPECT_EQ(drive.traffic().reception.lost_outage[0], 1U);
  const RoadsideBatch heard = numbered(guidance(101, drive.air().frames.sender[0], -0.37), 42);
  drive.step(&heard);
  EXPECT_EQ(drive.traffic().fate, fates({AdviceFate::kApplied}));
}

TEST(EngineNodeRadio, ReportsTheLoadAndWhatCarsHearOfEachOther) {
  EngineConfig config = with_downlink({});
  config.radio.load = {.counted = true, .path_loss = {.law = PathLossModel::Law::kTr37885}};
  config.radio.vehicle_to_vehicle = LinkModel{};
  Drive drive(config);
  drive.run_to(101);
  const ReceptionReport& said = drive.traffic().reception;
  ASSERT_EQ(said.size(), 2U);
  EXPECT_EQ(said.direction[1], static_cast<std::uint8_t>(Direction::kVehicleToVehicle));
  EXPECT_EQ(said.sent[1], 0U);  // one car has nobody to hear it
  // One car with one sub-channel: half of one, and half of a half that coincides: 0.5 + 0.5 - 0.5 * 1.5 / 799 of 400.
  EXPECT_NEAR(said.busy_ratio[0], 0.99906 / 400.0, 1e-7);
}

TEST(EngineNodeRadio, SaysThatAdviceWasLostInABurst) {
  LinkModel model;
  model.burst_rate = 0.9;
  model.burst_mean_length = 100.0;
  Drive drive(with_downlink(model));
  drive.run_to(100);
  const std::uint64_t car = drive.air().frames.sender[0];
  std::uint32_t lost = 0;
  for (std::uint32_t n = 0; n < 200; ++n) {
    const RoadsideBatch batch = numbered(guidance(drive.now(), car, -0.01), n);
    drive.step(&batch);
    for (const std::uint8_t fate : drive.traffic().fate) {
      lost += fate == static_cast<std::uint8_t>(AdviceFate::kLostBurst) ? 1U : 0U;
    }
  }
  EXPECT_GT(lost, 0U);
}

TEST(EngineNodeRadio, DropsADuplicateAndSaysSo) {
  LinkModel twice;
  twice.duplicate_rate = 1.0;
  Drive drive(with_downlink(twice));
  drive.run_to(100);
  const RoadsideBatch batch = guidance(100, drive.air().frames.sender[0], -0.37);
  drive.step(&batch);
  EXPECT_EQ(drive.traffic().fate, fates({AdviceFate::kApplied, AdviceFate::kDuplicate}));
  EXPECT_EQ(drive.traffic().reception.heard[0], 1U);
  EXPECT_EQ(drive.traffic().reception.duplicates[0], 1U);
}

TEST(EngineNodeRadio, DropsAdviceThatANewerOneHasOvertaken) {
  // Frames overtake each other where latencies differ by more than the time between them; look for the first that does.
  LinkModel jumpy = {.latency = {.law = LatencyModel::Law::kUniform, .min_ms = 0.0, .max_ms = 1000.0}};
  Drive drive(with_downlink(jumpy));
  drive.run_to(100);
  const std::uint64_t car = drive.air().frames.sender[0];
  std::uint32_t newest = 0;
  std::uint32_t stale = 0;
  for (std::uint32_t n = 1; n <= 100; ++n) {
    const RoadsideBatch batch = numbered(guidance(drive.now(), car, -0.01 * n, 5000), n);
    drive.step(&batch);
    const TrafficBatch& traffic = drive.traffic();
    const auto is_stale = [&](std::size_t i) {
      return traffic.fate[i] == static_cast<std::uint8_t>(AdviceFate::kStale);
    };
    for (std::size_t i = 0; i < traffic.fate.size(); ++i) {
      if (!is_stale(i)) newest = std::max(newest, traffic.fate_sequence[i]);
    }
    for (std::size_t i = 0; i < traffic.fate.size(); ++i) {
      if (!is_stale(i)) continue;
      ++stale;
      EXPECT_LT(traffic.fate_sequence[i], newest);
    }
    if (newest == 0) continue;
    EXPECT_NEAR(traffic.commanded_mps2[0], -0.01 * newest, 1e-9) << n;
  }
  EXPECT_GT(stale, 0U);
}

TEST(EngineNodeRadio, ChangesWhileTheRunGoesOn) {
  Drive drive(with_downlink({}));
  drive.run_to(100);
  const std::uint64_t car = drive.air().frames.sender[0];
  LinkModel deaf;
  deaf.loss_rate = 1.0;
  drive.node().change(with_downlink(deaf));
  const RoadsideBatch batch = guidance(100, car, -0.37);
  drive.step(&batch);
  EXPECT_EQ(drive.traffic().fate, fates({AdviceFate::kLostRandom}));
}

/// A batch of an RSU that says SPAT alone. The payload is of no interest: that it is heard is all.
RoadsideBatch spat(Step step) {
  RoadsideBatch batch = guidance(step, 1, std::nullopt);
  batch.frames.kind[0] = static_cast<std::uint8_t>(FrameKind::kSpat);
  return batch;
}

GuidanceState state_of(const Drive& drive) { return static_cast<GuidanceState>(drive.traffic().guidance.at(0)); }

/// Steps until an advice of 10 s comes to its end, while the RSU goes on speaking or not.
Step steps_until_given_up(const EngineConfig& config, bool speaks) {
  Drive drive(config);
  drive.run_to(100);
  const RoadsideBatch advice = guidance(100, drive.air().frames.sender[0], -0.05, 10'000);
  drive.step(&advice);
  while (state_of(drive) == GuidanceState::kInForce) {
    const RoadsideBatch batch = spat(drive.now());
    drive.step(speaks ? &batch : nullptr);
  }
  EXPECT_EQ(state_of(drive), speaks ? GuidanceState::kExpired : GuidanceState::kRsuUnheard);
  return drive.now() - 100;
}

TEST(EngineNodeRadio, EndsLongAdviceOfAnRsuThatFellSilent) {
  // Heard at t_100, silent from then on: 2 s have passed at t_120, so step 121 is the first without the advice. An RSU
  // that speaks is believed until the 10 s are over, in step 201. With and without a modelled radio.
  for (const EngineConfig& config : {lone_car_from_the_west(), with_downlink({})}) {
    EXPECT_EQ(steps_until_given_up(config, false), 21);
    EXPECT_EQ(steps_until_given_up(config, true), 101);
  }
}

TEST(EngineNodeRadio, DoesNotHearAnRsuThatIsOutOfRange) {
  LinkModel near;
  near.range_m = 50.0;  // the car is about 350 m away, and more than 200 m when the silence counts
  EngineConfig config = with_downlink({});
  Drive drive(config);
  drive.run_to(100);
  const RoadsideBatch advice = guidance(100, drive.air().frames.sender[0], -0.05, 10'000);
  drive.step(&advice);
  config.radio.downlink = near;
  drive.node().change(config);
  for (int i = 0; i < 20; ++i) {
    EXPECT_EQ(state_of(drive), GuidanceState::kInForce);
    const RoadsideBatch batch = spat(drive.now());
    drive.step(&batch);
  }
  EXPECT_EQ(state_of(drive), GuidanceState::kRsuUnheard);
}

TEST(EngineNodeRadio, KeepsTheNewestMissedWordForFiveSeconds) {
  LinkModel noisy;
  noisy.loss_rate = 1.0;
  Drive drive(with_downlink(noisy));
  drive.run_to(100);
  const RoadsideBatch batch = guidance(100, drive.air().frames.sender[0], -0.37);
  drive.step(&batch);
  EXPECT_EQ(drive.traffic().missed[0], static_cast<std::uint8_t>(AdviceFate::kLostRandom));
  EXPECT_EQ(state_of(drive), GuidanceState::kNeverAdvised);
  drive.run_to(150);
  EXPECT_EQ(drive.traffic().missed[0], static_cast<std::uint8_t>(AdviceFate::kLostRandom));
  drive.step();
  EXPECT_EQ(drive.traffic().missed[0], kNothingMissed);
}

TEST(EngineNodeRadio, ForgetsAMissedWordWhenANewerOneIsHeard) {
  EngineConfig config = with_downlink({});
  config.radio.downlink.loss_rate = 1.0;
  Drive drive(config);
  drive.run_to(100);
  const std::uint64_t car = drive.air().frames.sender[0];
  const RoadsideBatch lost = guidance(100, car, -0.37);
  drive.step(&lost);
  config.radio.downlink.loss_rate = 0.0;
  drive.node().change(config);
  const RoadsideBatch release = guidance(101, car, std::nullopt);
  drive.step(&release);
  EXPECT_EQ(drive.traffic().missed[0], kNothingMissed);
  EXPECT_EQ(state_of(drive), GuidanceState::kReleased);
}

TEST(EngineNodeRadio, PassesOnWhichCarsAnRsuHeard) {
  Drive drive(with_downlink({}));
  drive.run_to(100);
  RoadsideBatch batch;
  batch.step = 100;
  batch.rsu = 3;
  batch.uplink.add(Reception{.lost = LossCause::kBurst, .first = {}, .second = {}});
  drive.step(&batch);
  EXPECT_EQ(drive.traffic().uplink_vehicle, std::vector<std::uint32_t>{0});
  EXPECT_EQ(drive.traffic().uplink_rsu, std::vector<std::uint32_t>{3});
  EXPECT_EQ(drive.traffic().uplink.fate, batch.uplink.fate);
  drive.step();
  EXPECT_EQ(drive.traffic().uplink_vehicle.size(), 0U) << "nobody told";
}

TEST(EngineNodeRadio, RefusesAnRsuThatTellsOfFramesThatNobodySent) {
  EngineNode node(with_downlink({}));
  TrafficBatch traffic;
  AirBatch air;
  SignalBatch signal;
  signal.heads.assign(kLanes, static_cast<std::uint8_t>(Aspect::kGreen));
  ASSERT_TRUE(node.step(0, &signal, {}, traffic, air));
  RoadsideBatch batch;
  batch.uplink.add(Reception{.lost = LossCause::kBurst, .first = {}, .second = {}});
  const RoadsideBatch* heard = &batch;
  const auto refused = node.step(1, nullptr, std::span(&heard, 1), traffic, air);
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.error().text(),
            "topic lukou/roadside: what rsu0 heard in step 0 speaks of 1 frames, must speak of the 0 that were sent");
}

/// What an arriving car brings with it, by its number.
using Arrivals = std::map<std::uint32_t, std::tuple<double, std::uint8_t>>;

TEST(EngineNodeRadio, LeavesArrivalsAndDriversAloneHoweverBadItIsAndWhoeverFollows) {
  LinkModel harsh = {.latency = {.law = LatencyModel::Law::kGamma, .min_ms = 50.0, .mean_ms = 150.0}};
  harsh.loss_rate = 0.3;
  harsh.burst_rate = 0.2;
  harsh.burst_mean_length = 8.0;
  std::vector<Arrivals> seen;
  std::vector<std::vector<std::uint32_t>> counts;
  std::vector<std::vector<double>> accelerations;
  const traffic::ComplianceParameters mixed{.human_share = 0.5, .ignoring_share = 0.3};
  for (const auto& [model, compliance] : {std::pair(LinkModel{}, traffic::ComplianceParameters{}),
                                          {harsh, traffic::ComplianceParameters{}},
                                          {LinkModel{}, mixed}}) {
    EngineConfig config;
    config.traffic.compliance = compliance;
    for (auto& demand : config.traffic.demand) demand.flows = {{.from_s = 0.0, .flow_veh_per_h = 900.0}};
    config.radio = {.seed = config.traffic.seed, .modelled = true, .uplink = {}, .downlink = model};
    Drive drive(config);
    Arrivals arrivals;
    std::vector<std::uint32_t> arrived;
    RoadsideBatch batch;
    for (Step k = 0; k < 1500; ++k) {
      drive.step(k == 0 ? nullptr : &batch);
      // Guidance for the first car that speaks.
      batch = drive.air().frames.size() == 0
                  ? RoadsideBatch{.step = k}
                  : numbered(guidance(k, drive.air().frames.sender[0], -0.5), static_cast<std::uint32_t>(k));
      const TrafficBatch& traffic = drive.traffic();
      arrived.insert(arrived.end(), traffic.arrived.begin(), traffic.arrived.end());
      for (std::size_t i = 0; i < traffic.entered_vehicle.size(); ++i) {
        arrivals[traffic.entered_vehicle[i]] = {traffic.entered_desired_speed_mps[i], traffic.entered_equipped[i]};
      }
    }
    seen.push_back(arrivals);
    counts.push_back(arrived);
    accelerations.push_back(drive.traffic().acceleration_mps2);
  }
  EXPECT_GT(seen[0].size(), 100U);
  for (const std::size_t other : {1U, 2U}) {
    EXPECT_EQ(seen[0], seen[other]);
    EXPECT_EQ(counts[0], counts[other]);
    EXPECT_NE(accelerations[0], accelerations[other]) << "it made no difference: the test shows nothing";
  }
}

}  // namespace
}  // namespace lukou
