#include "tests/unit/common/lockstep/clock_rig.hpp"

namespace lukou {
namespace {

/// A run in which everything granted is done and recorded.
ClockRig running(ClockSettings settings = ClockRig::usual()) {
  settings.end = 10000;
  ClockRig rig(std::move(settings));
  rig.form();
  rig.credit(100);
  static_cast<void>(rig.heard());
  EXPECT_EQ(rig.granted(), 300);
  return rig;
}

TEST(ClockRequests, PauseHoldsTheRunAtTheLastGrantedStep) {
  ClockRig rig = running();
  EXPECT_EQ(rig.ask("pause"), "pauses at step 300 (30.0 s)");
  EXPECT_EQ(rig.phase(), RunPhase::kPaused);
  rig.all_did(300);
  rig.idle(1.0);
  EXPECT_EQ(rig.granted(), 300);
  EXPECT_TRUE(rig.heard(Control::Kind::kGrant).empty());
}

TEST(ClockRequests, ResumeGoesOnFromThere) {
  ClockRig rig = running();
  static_cast<void>(rig.ask("pause"));
  rig.all_did(300);
  EXPECT_EQ(rig.ask("resume"), "runs");
  EXPECT_EQ(rig.phase(), RunPhase::kRunning);
  ASSERT_EQ(rig.others.size(), 1U);
  EXPECT_EQ(rig.others[0].through, 500);
}

TEST(ClockRequests, StepGrantsThatManyStepsAndPausesAgain) {
  ClockRig rig = running();
  static_cast<void>(rig.ask("pause"));
  rig.all_did(300);
  EXPECT_EQ(rig.ask("step"), "pauses at step 301 (30.1 s)");
  EXPECT_EQ(rig.granted(), 301);
  EXPECT_EQ(rig.phase(), RunPhase::kPaused);
  EXPECT_EQ(rig.ask("step 9"), "pauses at step 310 (31.0 s)");
  EXPECT_EQ(rig.granted(), 310);
  for (const char* wrong : {"step 0", "step -1", "step 1.5", "step x", "step nan", "step 1e300"}) {
    EXPECT_TRUE(rig.ask(wrong).starts_with("refused: step: `")) << wrong;
  }
  EXPECT_EQ(rig.granted(), 310);
}

TEST(ClockRequests, StepDoesNotWaitForThePace) {
  auto settings = ClockRig::usual();
  settings.pace = 0.1;
  settings.start_paused = true;
  ClockRig rig(settings);
  rig.form();
  EXPECT_EQ(rig.granted(), 0);
  static_cast<void>(rig.ask("step 20"));
  EXPECT_EQ(rig.granted(), 20);
}

TEST(ClockRequests, PauseAtHoldsTheRunAtASimulatedTime) {
  ClockRig rig = running();
  EXPECT_EQ(rig.ask("pause at 40.05"), "pauses at step 401 (40.1 s)") << "the first step at or after it";
  EXPECT_EQ(rig.phase(), RunPhase::kRunning);
  rig.all_did(300);
  EXPECT_EQ(rig.granted(), 401);
  EXPECT_EQ(rig.phase(), RunPhase::kPaused);
  EXPECT_EQ(rig.ask("pause at 1"), "pauses at step 401 (40.1 s)") << "what is granted stays granted";
  EXPECT_EQ(rig.granted(), 401);
}

TEST(ClockRequests, PauseAtKeepsThePaceOnTheWay) {
  auto settings = ClockRig::usual();
  settings.pace = 1.0;
  ClockRig rig(settings);
  rig.form();
  static_cast<void>(rig.ask("pause at 10"));
  EXPECT_EQ(rig.granted(), 0);
  rig.idle(2.0);
  EXPECT_NEAR(static_cast<double>(rig.granted()), 20.0, 1.0);
  rig.idle(10.0);
  EXPECT_EQ(rig.granted(), 100);
  EXPECT_EQ(rig.phase(), RunPhase::kPaused);
}

TEST(ClockRequests, StopEndsTheRunWithTheLastGrantedStep) {
  ClockRig rig = running();
  EXPECT_EQ(rig.ask("stop"), "ends at step 300 (30.0 s)");
  ASSERT_EQ(rig.others.size(), 1U);
  const Control& last = rig.others[0];
  EXPECT_EQ(last.kind, Control::Kind::kGrant);
  EXPECT_EQ(last.through, 300);
  EXPECT_TRUE(last.last);
  EXPECT_EQ(last.text, "stopped");
  EXPECT_EQ(rig.core.state().end, 300);
  rig.all_did(300);
  rig.close("", 300);
  EXPECT_EQ(rig.core.outcome()->kind, RunOutcome::Kind::kStopped);
}

TEST(ClockRequests, StopAtEndsItLater) {
  ClockRig rig = running();
  EXPECT_EQ(rig.ask("stop at 45"), "ends at step 450 (45.0 s)");
  EXPECT_TRUE(rig.others.empty());
  rig.all_did(300);
  const Control last = rig.the(Control::Kind::kGrant);
  EXPECT_EQ(last.through, 450);
  EXPECT_TRUE(last.last);
  EXPECT_EQ(last.text, "stopped");
}

TEST(ClockRequests, StopAtOrAfterThePlannedEndChangesNothing) {
  ClockRig rig = running();
  EXPECT_EQ(rig.ask("stop at 5000"), "ends at step 10000 (1000.0 s)");
  EXPECT_EQ(rig.core.state().end, 10000);
  rig.close("", 10000);
  EXPECT_EQ(rig.core.outcome()->kind, RunOutcome::Kind::kDone);
}

TEST(ClockRequests, StopEndsAPausedRun) {
  ClockRig rig = running();
  static_cast<void>(rig.ask("pause"));
  static_cast<void>(rig.ask("stop"));
  EXPECT_EQ(rig.phase(), RunPhase::kEnding);
}

TEST(ClockRequests, InterruptStopsAndSaysSo) {
  ClockRig rig = running();
  static_cast<void>(rig.ask("interrupt"));
  ASSERT_EQ(rig.others.size(), 1U);
  EXPECT_EQ(rig.others[0].text, "interrupted");
  EXPECT_TRUE(rig.others[0].last);
}

TEST(ClockRequests, SetIsStampedWithTheStepAfterTheLastGrantedOne) {
  ClockRig rig = running();
  EXPECT_EQ(rig.ask("set good.flow=900"), "good.flow=900 from step 301 (30.1 s)");
  rig.all_did(300);
  const Control grant = rig.the(Control::Kind::kGrant);
  EXPECT_EQ(grant.directive_step, std::vector<Step>{301});
  EXPECT_EQ(grant.directive_set, std::vector<std::string>{"good.flow=900"});
}

TEST(ClockRequests, SetBeforeTheStartIsStampedWithStepOneAtTheEarliest) {
  ClockRig rig;
  EXPECT_EQ(rig.ask("set good.flow=900"), "good.flow=900 from step 1 (0.1 s)");
  auto settings = ClockRig::usual();
  settings.start_paused = true;
  ClockRig held(settings);
  held.form();
  EXPECT_EQ(held.ask("set good.flow=900"), "good.flow=900 from step 1 (0.1 s)");
}

TEST(ClockRequests, SetKeepsTheWholeOfAValueWithSpaces) {
  ClockRig rig = running();
  static_cast<void>(rig.ask("set good.plan={ cycle_s: 60 }"));
  rig.all_did(300);
  EXPECT_EQ(rig.the(Control::Kind::kGrant).directive_set, std::vector<std::string>{"good.plan={ cycle_s: 60 }"});
}

TEST(ClockRequests, SetOfAnythingElseIsRefusedAndForgotten) {
  ClockRig rig = running();
  EXPECT_EQ(rig.ask("set run.seed=3"), "refused: run.seed=3: cannot change while a run goes on");
  rig.all_did(300);
  EXPECT_TRUE(rig.the(Control::Kind::kGrant).directive_step.empty());
}

TEST(ClockRequests, SetsStayInTheOrderOfTheirSteps) {
  auto settings = ClockRig::usual();
  settings.replay = {{700, "good.a=1"}};
  ClockRig rig = running(settings);
  EXPECT_EQ(rig.ask("set good.a=2"),
            "refused: set: this run replays a change at step 700; it takes others from then on");
  rig.all_did(300);
  rig.all_did(500);
  EXPECT_EQ(rig.granted(), 700);
  EXPECT_EQ(rig.ask("set good.a=2"), "good.a=2 from step 701 (70.1 s)");
}

TEST(ClockRequests, AreRefusedIfTheyAreUnknownOrMalformed) {
  ClockRig rig = running();
  EXPECT_EQ(rig.ask("fly"), "refused: fly: is not a request; use pause, resume, step, pace, stop or set");
  EXPECT_EQ(rig.ask(""), "refused: is not a request; use pause, resume, step, pace, stop or set");
  for (const char* wrong : {"pause at x", "stop at -1", "pause at nan", "stop at 1e10", "stop at", "stop 300"}) {
    const std::string answer = rig.ask(wrong);
    EXPECT_NE(answer.find("is not a time; use `at SECONDS`"), std::string::npos) << wrong << ": " << answer;
  }
  EXPECT_EQ(rig.phase(), RunPhase::kRunning) << "a slip of the pen neither pauses nor ends a run";
}

TEST(ClockRequests, AreRefusedWhenTheRunEnds) {
  ClockRig rig = running();
  static_cast<void>(rig.ask("stop"));
  EXPECT_EQ(rig.ask("pause"), "refused: pause: the run is ending");
  rig.close();
  EXPECT_EQ(rig.ask("set good.flow=1"), "refused: set: the run is ending");
}

TEST(ClockRequests, AreExecutedOnceThoughTheyAreRepeatedUntilTheAnswerArrives) {
  ClockRig rig = running();
  static_cast<void>(rig.ask("pause"));
  const auto step_ten = [&](Incarnation from, std::uint64_t number) {
    rig.up({.kind = Up::Kind::kRequest, .incarnation = from, .number = number, .text = "step 10"});
    return rig.the(Control::Kind::kReply);
  };
  rig.all_did(300);
  EXPECT_EQ(step_ten(kOperator, 1).text, "pauses at step 310 (31.0 s)");
  const Control again = step_ten(kOperator, 1);
  EXPECT_EQ(again.text, "pauses at step 310 (31.0 s)");
  EXPECT_TRUE(again.ok);
  EXPECT_EQ(again.to, kOperator);
  EXPECT_EQ(rig.granted(), 310);
  EXPECT_EQ(step_ten(kOperator, 2).text, "pauses at step 320 (32.0 s)") << "the next request";
  EXPECT_EQ(step_ten(kOperator + 1, 1).text, "pauses at step 330 (33.0 s)") << "somebody else's first";
}

TEST(ClockRequests, OfAReplayedRunEndItWhereItsOperatorDid) {
  auto settings = ClockRig::usual();
  settings.stop_at = 120;
  ClockRig rig(settings);
  rig.form();
  const Control last = rig.the(Control::Kind::kGrant);
  EXPECT_EQ(last.through, 120);
  EXPECT_TRUE(last.last);
  EXPECT_EQ(last.text, "stopped");
  rig.close("", 120);
  ASSERT_TRUE(rig.core.outcome().has_value());
  EXPECT_EQ(rig.core.outcome()->kind, RunOutcome::Kind::kStopped);
}

TEST(ClockRequests, MayComeBeforeTheStart) {
  ClockRig rig;
  EXPECT_EQ(rig.ask("pause at 20"), "pauses at step 200 (20.0 s)");
  EXPECT_EQ(rig.ask("stop at 30"), "ends at step 300 (30.0 s)");
  EXPECT_EQ(rig.phase(), RunPhase::kForming);
  rig.form();
  rig.all_did(199);
  EXPECT_EQ(rig.granted(), 300);
  EXPECT_EQ(rig.phase(), RunPhase::kEnding);
}

TEST(ClockRequests, TellALateObserverTheScenarioAndWhatGrantsHaveChanged) {
  ClockRig rig = running();
  EXPECT_TRUE(rig.ask("set good=1").starts_with("good=1 from step 301"));
  const auto told = [&] {
    rig.up({.kind = Up::Kind::kRequest, .incarnation = kOperator, .number = 7, .text = "scenario"});
    return rig.the(Control::Kind::kReply);
  };
  Control answer = told();
  EXPECT_EQ(answer.text, "run { }");
  EXPECT_EQ(answer.number, 7U);
  EXPECT_TRUE(answer.directive_set.empty()) << "no grant has said it yet: the observer will hear it from one";
  rig.all_did(300);
  answer = told();
  ASSERT_EQ(answer.directive_set.size(), 1U) << "the same question is answered anew";
  EXPECT_EQ(answer.directive_set[0], "good=1");
  EXPECT_EQ(answer.directive_step[0], 301);
}

TEST(ClockRequests, AreAnsweredUnderTheirNumber) {
  ClockRig rig = running();
  rig.up({.kind = Up::Kind::kRequest, .incarnation = kOperator, .number = 3, .text = "pause"});
  EXPECT_EQ(rig.the(Control::Kind::kReply).number, 3U);
  rig.up({.kind = Up::Kind::kRequest, .incarnation = kOperator, .number = 3, .text = "pause"});
  EXPECT_EQ(rig.the(Control::Kind::kReply).number, 3U) << "also the second time";
}

}  // namespace
}  // namespace lukou
