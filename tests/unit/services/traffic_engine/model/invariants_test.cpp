#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <vector>

#include "common/core/keyed_random.hpp"
#include "services/traffic_engine/model/engine.hpp"
#include "tests/unit/services/traffic_engine/model/rides.hpp"

// The invariants of the model, checked after every step of random runs: any flow, any plan, any advice.

namespace lukou::traffic {
namespace {

/// Keeps what the last step looked like and fails the property when an invariant does not hold.
class Invariants {
 public:
  explicit Invariants(const EngineParameters& parameters)
      : parameters_(parameters),
        least_m_(parameters.driving.guard_spacing_m -
                 parameters.vehicles.acceleration_max_mps2 * kStep_s * kStep_s / 8.0 - 0.00125) {}

  void check(const Engine& engine, const Heads& heads) {
    count(engine, heads);
    std::map<std::uint32_t, Seen> now;
    for (int i = 0; i < kLanes; ++i) check_lane(engine.lane(Lane(i)).cars(), heads[index(Lane(i))], now);
    before_ = std::move(now);
  }

 private:
  struct Seen {
    Motion motion;
    Stage stage;
  };

  void count(const Engine& engine, const Heads& heads) {
    entered_ += engine.entries().size();
    departed_ += engine.events().departures.size();
    std::size_t on_road = 0;
    std::size_t arrived = 0;
    std::size_t waiting = 0;
    for (int i = 0; i < kLanes; ++i) on_road += engine.lane(Lane(i)).cars().size();
    for (const Approach approach : kAllApproaches) {
      arrived += engine.arrived(approach);
      waiting += engine.waiting(approach);
    }
    RC_ASSERT(arrived == waiting + on_road + departed_);
    RC_ASSERT(entered_ == on_road + departed_);
    for (const Crossing& crossing : engine.events().crossings) {
      RC_ASSERT(crossing.aspect == Aspect::kGreen || crossing.committed);
    }
    static_cast<void>(heads);
  }

  void check_lane(const std::vector<Car>& cars, Aspect aspect, std::map<std::uint32_t, Seen>& now) {
    const double braking_mps2 = parameters_.vehicles.acceleration_max_mps2;
    const auto stop = [&](const Motion& m) { return stopping_point_m(m.position_m, m.speed_mps, braking_mps2); };
    const Car* ahead = nullptr;
    for (const Car& car : cars) {
      const Motion& motion = car.motion;
      RC_ASSERT(motion.speed_mps >= 0.0);
      RC_ASSERT(motion.speed_mps <= parameters_.vehicles.speed_limit_mps);
      if (const auto found = before_.find(car.vehicle); found != before_.end()) {
        const Motion& old = found->second.motion;
        RC_ASSERT(motion.position_m >= old.position_m);
        RC_ASSERT(std::abs(motion.speed_mps - old.speed_mps) <= braking_mps2 * kStep_s + 1e-12);
        const double way_m = (old.speed_mps + motion.speed_mps) * kStep_s / 2.0;
        RC_ASSERT(std::abs(motion.position_m - old.position_m - way_m) <= 1e-12 * (1.0 + motion.position_m));
        RC_ASSERT(stop(motion) - stop(old) >= -1e-9);
        check_stage(found->second.stage, car, ahead, aspect);
      }
      if (ahead != nullptr) {
        RC_ASSERT(ahead->vehicle < car.vehicle);  // nobody overtakes: cars entered in the order of their numbers
        RC_ASSERT(ahead->motion.position_m - motion.position_m >= least_m_);
        RC_ASSERT(stop(ahead->motion) - stop(motion) >= least_m_);
        if (car.stage == Stage::kBlock) {  // contiguous, one speed
          RC_ASSERT(ahead->stage != Stage::kIn);
          if (ahead->stage == Stage::kBlock) RC_ASSERT(ahead->motion.speed_mps == motion.speed_mps);
        }
        if (car.stage == Stage::kExit) RC_ASSERT(ahead->stage == Stage::kExit);
      }
      RC_ASSERT((car.stage == Stage::kExit) == (motion.position_m >= parameters_.road.approach_m));
      now[car.vehicle] = {motion, car.stage};
      ahead = &car;
    }
  }

  void check_stage(Stage old, const Car& car, const Car* ahead, Aspect aspect) const {
    if (old == Stage::kExit) RC_ASSERT(car.stage == Stage::kExit);
    if (car.stage == Stage::kBlock && old != Stage::kBlock) {  // joined in this step
      RC_ASSERT(old == Stage::kIn);
      RC_ASSERT(aspect != Aspect::kGreen);
      if (ahead != nullptr && ahead->stage == Stage::kBlock) {
        const double spacing_m = ahead->motion.position_m - car.motion.position_m;
        RC_ASSERT(spacing_m >= least_m_);
        RC_ASSERT(spacing_m <= parameters_.driving.standstill_spacing_m + 0.5);
      }
    }
  }

  EngineParameters parameters_;
  /// A stopping point grows by up to a_max dt^2 / 8 in the step in which a car comes to stand.
  double least_m_;
  std::map<std::uint32_t, Seen> before_;
  std::size_t entered_ = 0;
  std::size_t departed_ = 0;
};

/// Any cycle of green, yellow and red for each axis; greens may be short and may overlap.
Heads random_heads(const std::array<int, 6>& lengths_s, Step step) {
  Heads heads{};
  for (int i = 0; i < kLanes; ++i) {
    const auto axis = static_cast<std::size_t>(static_cast<int>(approach_of(Lane(i))) % 2) * 3;
    const Step green = lengths_s[axis] * 10;
    const Step yellow = lengths_s[axis + 1] * 10;
    const Step cycle = green + yellow + lengths_s[axis + 2] * 10;
    const Step phase = (step + static_cast<Step>(axis) * 37) % cycle;
    heads[index(Lane(i))] = phase < green ? Aspect::kGreen : (phase < green + yellow ? Aspect::kYellow : Aspect::kRed);
  }
  return heads;
}

std::vector<Advice> random_advice(const Engine& engine, std::uint64_t seed, Step step) {
  std::vector<Advice> advice;
  for (int i = 0; i < kLanes; ++i) {
    for (const Car& car : engine.lane(Lane(i)).cars()) {
      const auto u = [&](std::uint64_t n) {
        return uniform01({.run_seed = seed, .entity = car.vehicle, .index = static_cast<std::uint64_t>(step) * 8 + n});
      };
      if (!car.equipped || u(0) > 0.1) continue;
      advice.push_back({.target = car.temporary_id,
                        .acceleration_mps2 = -3.2 + 6.4 * u(1),
                        .binding = u(2) < 0.5 ? AdviceBinding::kGuard : AdviceBinding::kFollowing,
                        .release = u(3) < 0.1,
                        .issued = step,
                        .lifetime = static_cast<Step>(30.0 * u(4)),
                        .rsu = 0,
                        .sequence = static_cast<std::uint32_t>(step)});
    }
  }
  return advice;
}

EngineParameters random_parameters() {
  EngineParameters parameters;
  parameters.seed = *rc::gen::arbitrary<std::uint64_t>();
  const auto percent = [] { return *rc::gen::inRange(0, 101) / 100.0; };
  for (DemandParameters& demand : parameters.demand) {
    demand.flows = {{.from_s = 0.0, .flow_veh_per_h = 3600.0 * percent()}};
  }
  parameters.road.approach_m = *rc::gen::element(200.0, 500.0);
  parameters.vehicles.actuation_noise_mps2 = percent();
  parameters.vehicles.acceleration_max_mps2 = 2.0 + 3.0 * percent();
  parameters.driving.reaction_time_s = *rc::gen::element(0.1, 0.1, 0.5, 1.0);
  parameters.driving.standstill_spacing_m = 5.5 + 2.0 * percent();
  parameters.driving.discharge_speed_mps = (3.0 + 12.0 * percent()) / 3.6;
  parameters.equipped_ratio = *rc::gen::element(0.0, 0.3, 1.0);
  parameters.unit.fallback_s = *rc::gen::element(0.0, 1.0, 10.0);
  parameters.unit.rsu_lost_after_s = *rc::gen::element(0.1, 2.0);
  return parameters;
}

RC_GTEST_PROP(Invariants, HoldInEveryStepOfAnyRun, ()) {
  EngineParameters parameters = random_parameters();
  parameters.compliance = {.human_share = *rc::gen::element(0.0, 0.6),
                           .ignoring_share = 0.2,
                           .reaction_s = *rc::gen::element(0.0, 0.3, 2.0),
                           .gain_deviation = 0.5,
                           .threshold_mps2 = 0.2};
  std::array<int, 6> lengths_s{};
  for (int& length_s : lengths_s) length_s = *rc::gen::inRange(0, 40);
  lengths_s[2] += 1;
  lengths_s[5] += 1;
  Engine engine(parameters);
  Invariants invariants(parameters);
  std::vector<Advice> advice;
  for (Step k = 0; k <= 1500; ++k) {
    const Heads heads = random_heads(lengths_s, std::max<Step>(k - 1, 0));
    engine.step(k, heads, advice);
    invariants.check(engine, heads);
    advice = random_advice(engine, parameters.seed, k);
  }
}

RC_GTEST_PROP(Invariants, GiveEachAdviceExactlyOneFirstOutcome, ()) {
  const EngineParameters parameters = random_parameters();
  Engine engine(parameters);
  std::size_t sent = 0;
  std::size_t first = 0;
  std::vector<Advice> advice;
  for (Step k = 0; k <= 600; ++k) {
    engine.step(k, random_heads({20, 3, 20, 15, 3, 25}, std::max<Step>(k - 1, 0)), advice);
    sent += static_cast<std::size_t>(std::ranges::count(advice, false, &Advice::release));
    for (const OutcomeEvent& outcome : engine.events().outcomes) first += outcome.again ? 0U : 1U;
    RC_ASSERT(first == sent);  // on the ideal radio every advice is decided in the step that hears it
    advice = random_advice(engine, parameters.seed, k);
  }
}

TEST(Invariants, KeepCommittedCarsWithinThreeSecondsOfTheEndOfGreen) {
  EngineParameters parameters;
  parameters.equipped_ratio = 0.0;
  Engine engine(parameters);
  const SignalPlan plan = paper_plan();
  std::size_t late = 0;
  for (Step k = 0; k <= 18000; ++k) {
    Heads heads{};
    for (int i = 0; i < kLanes; ++i) heads[index(Lane(i))] = aspect_at(plan, Lane(i), k - 1);
    engine.step(k, heads, {});
    for (const Crossing& crossing : engine.events().crossings) {
      if (crossing.aspect == Aspect::kGreen) continue;
      ++late;
      ASSERT_TRUE(crossing.committed);
      ASSERT_LT(std::fmod(crossing.time_s, 45.0), 3.0);  // one axis' green ends every 45 s
    }
  }
  EXPECT_GT(late, 20U);  // the plan has no yellow
}

TEST(Invariants, LetNobodyCrossOnRedAfterThreeSecondsOfYellow) {
  EngineParameters parameters;
  parameters.equipped_ratio = 0.0;
  Engine engine(parameters);
  const SignalPlan plan = paper_yellow_plan();
  for (Step k = 0; k <= 18000; ++k) {
    Heads heads{};
    for (int i = 0; i < kLanes; ++i) heads[index(Lane(i))] = aspect_at(plan, Lane(i), k - 1);
    engine.step(k, heads, {});
    for (const Crossing& crossing : engine.events().crossings) ASSERT_NE(crossing.aspect, Aspect::kRed);
  }
}

}  // namespace
}  // namespace lukou::traffic
