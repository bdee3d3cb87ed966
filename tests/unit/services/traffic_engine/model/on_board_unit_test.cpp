#include "services/traffic_engine/model/on_board_unit.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "services/traffic_engine/model/entrance.hpp"
#include "tests/unit/services/traffic_engine/model/rides.hpp"

namespace lukou::traffic {
namespace {

constexpr std::uint32_t kVehicle = 4;
using Kind = AdvisedDriver::Kind;

/// A unit whose RSU 0 is heard at every instant, unless the test silences it.
class Bench {
 public:
  explicit Bench(const AdvisedDriver& driver = {}, Step reaction = 10) : unit_(driver) { rules_.reaction = reaction; }

  /// An advice that was issued at the instant before the next step.
  void advise(double acceleration_mps2, Step lifetime, Step age = 0) {
    words_.push_back(
        {.acceleration_mps2 = acceleration_mps2, .issued = step_ - age, .lifetime = lifetime, .sequence = sequence_++});
  }
  void release() { words_.push_back({.release = true, .issued = step_, .sequence = sequence_++}); }
  void silence() { silent_ = true; }
  /// The next step; what the car makes of the advice in force.
  void step(AdviceOutcome outcome = AdviceOutcome::kApplied) {
    if (!silent_) heard_[0] = step_;
    rules_.everybody = heard_;
    ++step_;
    for (const Advice& word : words_) unit_.take(word, step_, kVehicle, outcomes_);
    words_.clear();
    unit_.advance(step_, 15.0, rules_, kVehicle, outcomes_);
    if (unit_.in_force()) unit_.used(outcome, kVehicle, outcomes_);
  }
  void steps(int count) {
    for (int i = 0; i < count; ++i) step();
  }
  [[nodiscard]] OnBoardUnit& unit() { return unit_; }
  [[nodiscard]] Step now() const { return step_; }
  std::vector<AdviceOutcome> take() {
    std::vector<AdviceOutcome> taken;
    for (const OutcomeEvent& event : outcomes_) taken.push_back(event.outcome);
    outcomes_.clear();
    return taken;
  }

 private:
  OnBoardUnit unit_;
  UnitRules rules_;
  std::array<Step, 1> heard_ = {-1};
  std::vector<Advice> words_;
  std::vector<OutcomeEvent> outcomes_;
  Step step_ = 100;
  std::uint32_t sequence_ = 0;
  bool silent_ = false;
};

using Outcomes = std::vector<AdviceOutcome>;

TEST(OnBoardUnit, GoesFromStateToState) {
  Bench bench;
  bench.step();
  EXPECT_EQ(bench.unit().state(), Guidance::kNeverAdvised);
  bench.advise(-1.0, 2);
  bench.steps(2);
  EXPECT_EQ(bench.unit().state(), Guidance::kInForce);
  bench.step();
  EXPECT_EQ(bench.unit().state(), Guidance::kExpired);
  bench.advise(-1.0, 5);
  bench.step();
  bench.release();
  bench.step();
  EXPECT_EQ(bench.unit().state(), Guidance::kReleased);
  std::vector<OutcomeEvent> outcomes;
  bench.unit().forget(kVehicle, outcomes);
  EXPECT_EQ(bench.unit().state(), Guidance::kPastStopLine);
}

TEST(OnBoardUnit, FadesLinearlyWhenALifeEnds) {
  Bench bench;
  bench.advise(-1.0, 3);
  bench.steps(3);
  EXPECT_EQ(bench.unit().fallback_share(bench.now(), 10), 0.0);
  // Ten steps: 0.9, 0.8, ... 0.1, 0.
  for (int n = 1; n <= 12; ++n) {
    bench.step();
    EXPECT_NEAR(bench.unit().fallback_share(bench.now(), 10), std::max(0.0, 1.0 - 0.1 * n), 1e-12) << n;
    EXPECT_EQ(bench.unit().fallback_share(bench.now(), 0), 0.0);
  }
}

TEST(OnBoardUnit, EndsAnAdviceAtOnceOnARelease) {
  Bench bench;
  bench.advise(-1.0, 50);
  bench.step();
  bench.release();
  bench.step();
  EXPECT_EQ(bench.unit().fallback_share(bench.now(), 10), 0.0);
}

TEST(OnBoardUnit, GivesAnAdviceUpWhoseRsuIsSilent) {
  Bench bench;
  bench.advise(-1.0, 600);
  bench.steps(100);
  EXPECT_TRUE(bench.unit().in_force());  // it speaks
  bench.silence();
  // Heard last at the instant before the step before: 20 steps of silence are 2 s.
  bench.steps(19);
  EXPECT_TRUE(bench.unit().in_force());
  bench.step();
  EXPECT_EQ(bench.unit().state(), Guidance::kRsuUnheard);
  EXPECT_NEAR(bench.unit().fallback_share(bench.now(), 10), 0.9, 1e-12);
  EXPECT_EQ(bench.take(), Outcomes{AdviceOutcome::kApplied});
}

TEST(OnBoardUnit, ListensOnlyWhereSilenceCouldEndItsAdvice) {
  Bench bench;
  bench.silence();
  bench.advise(-1.0, 20);
  bench.step();
  bench.step();
  // Heard at 100, lost after 20 steps: first in step 121. Its life ends with step 120.
  EXPECT_FALSE(bench.unit().listens(0, bench.now() + 1, 20));
  bench.advise(-1.0, 20);  // lives one step longer than a silence from now on may last: no
  bench.step();
  EXPECT_FALSE(bench.unit().listens(0, bench.now() + 1, 20));
  bench.advise(-1.0, 21);
  bench.step();
  EXPECT_FALSE(bench.unit().listens(0, bench.now(), 20));  // heard at the very instant before
  EXPECT_TRUE(bench.unit().listens(0, bench.now() + 1, 20));
  EXPECT_FALSE(bench.unit().listens(1, bench.now() + 1, 20));  // of another RSU
}

TEST(OnBoardUnit, CallsWhatCameAfterItsLifeLate) {
  Bench bench;
  bench.advise(-1.0, 3, 3);  // good for the steps 98, 99, 100
  bench.step();
  EXPECT_EQ(bench.take(), Outcomes{AdviceOutcome::kLate});
  EXPECT_EQ(bench.unit().state(), Guidance::kNeverAdvised);
}

TEST(IgnoringDriver, LeavesEveryAdviceAlone) {
  Bench bench({.kind = Kind::kIgnoring});
  bench.advise(-1.0, 2);
  bench.steps(2);
  EXPECT_FALSE(bench.unit().in_force());
  EXPECT_EQ(bench.unit().state(), Guidance::kNotComplied);
  EXPECT_EQ(bench.take(), Outcomes{AdviceOutcome::kNotComplied});
  bench.step();
  EXPECT_EQ(bench.unit().state(), Guidance::kExpired);
  EXPECT_EQ(bench.unit().fallback_share(bench.now(), 10), 0.0);  // nothing was followed: nothing fades
}

TEST(HumanDriver, FollowsLateAndImperfectly) {
  Bench bench({.kind = Kind::kHuman, .gain = 1.25}, 3);
  bench.advise(-1.0, 50);
  bench.steps(3);
  EXPECT_EQ(bench.unit().state(), Guidance::kReacting);
  EXPECT_EQ(bench.take(), Outcomes{});
  bench.step();
  ASSERT_TRUE(bench.unit().in_force());
  EXPECT_EQ(bench.unit().command_mps2(), -1.0);
  EXPECT_EQ(bench.unit().acted_mps2(), -1.25);
  bench.steps(5);
  EXPECT_EQ(bench.take(), Outcomes{AdviceOutcome::kChangedDriver});  // once
}

TEST(HumanDriver, TracksAStreamOfShortAdviceBehindTheReaction) {
  Bench bench({.kind = Kind::kHuman}, 4);
  for (int i = 0; i < 12; ++i) {
    bench.advise(-0.5 - 0.1 * i, 2);  // each lives two steps, much shorter than the reaction
    bench.step();
    EXPECT_EQ(bench.unit().in_force(), i >= 4) << i;
    if (i < 4) continue;
    EXPECT_DOUBLE_EQ(bench.unit().command_mps2(), -0.5 - 0.1 * (i - 4));
  }
  EXPECT_EQ(bench.take(), Outcomes(8, AdviceOutcome::kChangedDriver));
  // The display goes dark: what the driver had not reacted to is over.
  bench.steps(2);
  EXPECT_EQ(bench.unit().state(), Guidance::kExpired);
  const Outcomes rest = bench.take();
  EXPECT_EQ(rest, (Outcomes{AdviceOutcome::kChangedDriver, AdviceOutcome::kExpired, AdviceOutcome::kExpired,
                            AdviceOutcome::kExpired}));
}

TEST(HumanDriver, IsTooLateForASingleShortAdvice) {
  Bench bench({.kind = Kind::kHuman}, 10);
  bench.advise(-1.0, 5);
  bench.steps(20);
  EXPECT_EQ(bench.take(), Outcomes{AdviceOutcome::kExpired});
}

TEST(HumanDriver, DropsWhatAReleaseOvertakes) {
  Bench bench({.kind = Kind::kHuman}, 10);
  bench.advise(-1.0, 50);
  bench.step();
  bench.release();
  bench.step();
  EXPECT_EQ(bench.take(), Outcomes{AdviceOutcome::kSuperseded});
  EXPECT_EQ(bench.unit().state(), Guidance::kReleased);
}

TEST(HumanDriver, LeavesSmallCommandsAlone) {
  Bench bench({.kind = Kind::kHuman}, 0);
  bench.advise(-0.09, 5);
  bench.step();
  EXPECT_EQ(bench.unit().state(), Guidance::kNotComplied);
  bench.advise(-0.1, 5);
  bench.step();
  EXPECT_TRUE(bench.unit().in_force());
  EXPECT_EQ(bench.take(), (Outcomes{AdviceOutcome::kNotComplied, AdviceOutcome::kApplied}));
}

TEST(HumanDriver, LosesWhatWaitsAtTheStopLine) {
  Bench bench({.kind = Kind::kHuman}, 10);
  bench.advise(-1.0, 50);
  bench.step();
  std::vector<OutcomeEvent> outcomes;
  bench.unit().forget(kVehicle, outcomes);
  ASSERT_EQ(outcomes.size(), 1U);
  EXPECT_EQ(outcomes[0].outcome, AdviceOutcome::kPastStopLine);
  EXPECT_EQ(outcomes[0].command_mps2, -1.0);
  EXPECT_EQ(outcomes[0].issued, 100);
}

TEST(Compliance, HasTheSharesThatAreAsked) {
  EngineParameters parameters;
  parameters.compliance = {.human_share = 0.3, .ignoring_share = 0.2};
  std::array<int, 3> count{};
  double sum = 0.0;
  double squares = 0.0;
  for (std::uint32_t vehicle = 0; vehicle < 10000; ++vehicle) {
    const AdvisedDriver driver = drawn_compliance(parameters, vehicle);
    ++count[static_cast<std::size_t>(driver.kind)];
    if (driver.kind != Kind::kHuman) continue;
    sum += driver.gain;
    squares += (driver.gain - 1.0) * (driver.gain - 1.0);
  }
  EXPECT_NEAR(count[0], 5000, 4.0 * std::sqrt(10000 * 0.25));
  EXPECT_NEAR(count[1], 3000, 4.0 * std::sqrt(10000 * 0.21));
  EXPECT_NEAR(count[2], 2000, 4.0 * std::sqrt(10000 * 0.16));
  // Normal(1, 0.1): the mean of n draws within 4 * 0.1 / sqrt(n), their deviation within 4 * 0.1 / sqrt(2 n).
  const double humans = count[1];
  EXPECT_NEAR(sum / humans, 1.0, 0.4 / std::sqrt(humans));
  EXPECT_NEAR(std::sqrt(squares / humans), 0.1, 0.4 / std::sqrt(2.0 * humans));
}

TEST(Compliance, OfOneShareLeavesTheOtherAlone) {
  EngineParameters few;
  few.compliance = {.human_share = 0.3, .ignoring_share = 0.2};
  EngineParameters more = few;
  more.compliance.ignoring_share = 0.6;
  for (std::uint32_t vehicle = 0; vehicle < 1000; ++vehicle) {
    const AdvisedDriver driver = drawn_compliance(few, vehicle);
    if (driver.kind == Kind::kAutomated) continue;
    EXPECT_EQ(drawn_compliance(more, vehicle).kind, driver.kind);
    EXPECT_EQ(drawn_compliance(more, vehicle).gain, driver.gain);
  }
}

// The same, in traffic.

TEST(Fallback, ReleasesTheBrakeSmoothly) {
  Ride ride(with_arrivals(calm_parameters(), {0.0}));
  ride.run_to(50);
  const Advice brake = ride.advise(0, -2.0, 10);
  ride.step({&brake, 1});
  ride.run_to(60);
  double before_mps2 = ride.cars()[0].motion.acceleration_mps2;
  EXPECT_NEAR(before_mps2, -2.0, 1e-12);
  // At 13 m/s and, while the brake is still on, a little less, the driver wants 2 ... 3 m/s2 back to 15: at once that
  // were a jump of 4 m/s2. In ten steps it is 5 / 10 each at most.
  for (int i = 0; i < 10; ++i) {
    ride.step();
    const double now_mps2 = ride.cars()[0].motion.acceleration_mps2;
    EXPECT_GT(now_mps2, before_mps2 - 1e-9);
    EXPECT_LT(now_mps2 - before_mps2, 0.5);
    before_mps2 = now_mps2;
  }
  const double wish_mps2 = (15.0 - ride.cars()[0].motion.speed_mps) / 1.0;
  EXPECT_NEAR(before_mps2, wish_mps2, 0.3);
}

TEST(Fallback, DoesNotDelayBrakingForRed) {
  EngineParameters parameters = with_arrivals(calm_parameters(), {0.0});
  Ride smooth(parameters, Aspect::kRed);
  parameters.unit.fallback_s = 0.0;
  Ride at_once(parameters, Aspect::kRed);
  for (Ride* ride : {&smooth, &at_once}) {
    ride->run_to(260);  // inside the reaction distance: the driver brakes
    const Advice go = ride->advise(0, 1.0, 5);
    ride->step({&go, 1});
    ride->run_to(266);
  }
  // The law of braking asks for less than the fading command: it is used whole.
  EXPECT_LT(smooth.cars()[0].motion.acceleration_mps2, -0.5);
  EXPECT_EQ(smooth.cars()[0].motion.acceleration_mps2, at_once.cars()[0].motion.acceleration_mps2);
  smooth.run_to(600);
  EXPECT_TRUE(smooth.crossings().empty());
  EXPECT_EQ(smooth.cars()[0].decider, Decider::kLight);
}

TEST(Fallback, LetsAnUnhinderedDriverSlowDownSmoothlyToo) {
  Ride ride(with_arrivals(calm_parameters(), {0.0}));
  ride.run_to(50);
  const Advice go = ride.advise(0, 1.0, 10);
  ride.step({&go, 1});
  ride.run_to(61);
  // At 16 m/s the driver wants -1 m/s2, nobody is in the way: nine tenths of the command are left.
  EXPECT_NEAR(ride.cars()[0].motion.acceleration_mps2, 0.9 * 1.0 + 0.1 * (15.0 - 16.0), 1e-9);
}

}  // namespace
}  // namespace lukou::traffic
