#include "tests/unit/common/lockstep/clock_rig.hpp"

namespace lukou {
namespace {

TEST(ClockGrants, GoAsFarAsTheRecordersCreditAllows) {
  ClockRig rig;
  rig.form();
  // Nothing is committed yet (-1): 200 steps more are 0..199.
  const Control first = rig.the(Control::Kind::kGrant);
  EXPECT_EQ(first.to, 0U);
  EXPECT_EQ(first.through, 199);
  EXPECT_FALSE(first.last);
  rig.idle(5.0);
  EXPECT_TRUE(rig.heard().empty()) << "no credit, no grant";
  rig.credit(50);
  EXPECT_EQ(rig.the(Control::Kind::kGrant).through, 250);
  rig.credit(50);
  rig.credit(30);
  EXPECT_TRUE(rig.heard().empty()) << "no news, or old news";
}

TEST(ClockGrants, EndWithTheLastStepAndSayItExactlyOnce) {
  ClockRig rig;
  rig.form();
  for (Step step = 100; step <= 700; step += 100) rig.credit(step);
  EXPECT_EQ(rig.granted(), 900);
  static_cast<void>(rig.heard());
  rig.credit(900);
  const Control last = rig.the(Control::Kind::kGrant);
  EXPECT_EQ(last.through, 1000);
  EXPECT_TRUE(last.last);
  EXPECT_EQ(last.text, "");
  EXPECT_EQ(rig.phase(), RunPhase::kEnding);
  rig.credit(1000);
  rig.idle(2.0);
  EXPECT_TRUE(rig.heard().empty());
}

TEST(ClockGrants, MayCoverTheWholeRunAtOnce) {
  auto settings = ClockRig::usual();
  settings.end = 3;
  ClockRig rig(settings);
  rig.form();
  const Control only = rig.the(Control::Kind::kGrant);
  EXPECT_EQ(only.through, 3);
  EXPECT_TRUE(only.last);
}

TEST(ClockGrants, EndOnlyWithTheRecordersClose) {
  auto settings = ClockRig::usual();
  settings.end = 3;
  ClockRig rig(settings);
  rig.form();
  rig.all_did(3);
  static_cast<void>(rig.heard());
  EXPECT_FALSE(rig.core.outcome().has_value());
  rig.close("", 3);
  EXPECT_EQ(rig.the(Control::Kind::kEnded).text, "");
  ASSERT_TRUE(rig.core.outcome().has_value());
  EXPECT_EQ(rig.core.outcome()->kind, RunOutcome::Kind::kDone);
  EXPECT_EQ(rig.core.outcome()->complete_to, 3);
  EXPECT_EQ(rig.phase(), RunPhase::kEnded);
}

TEST(ClockGrants, EndWithTheAnomalyThatTheRecorderFound) {
  ClockRig rig;
  rig.form();
  static_cast<void>(rig.heard());
  rig.close("overflow", 120);
  EXPECT_EQ(rig.the(Control::Kind::kEnded).text, "overflow");
  EXPECT_EQ(rig.core.outcome()->kind, RunOutcome::Kind::kAnomaly);
  EXPECT_EQ(rig.core.outcome()->text, "overflow");
  EXPECT_EQ(rig.core.outcome()->complete_to, 120);
  rig.credit(150);
  rig.idle(1.0);
  EXPECT_TRUE(rig.heard().empty()) << "nothing is granted any more";
}

TEST(ClockGrants, AreOverWhenEverybodyHasLeft) {
  ClockRig rig;
  rig.form();
  rig.close();
  for (const Incarnation member : {kEngine, kController, kRecorder}) {
    rig.up({.kind = Up::Kind::kLeave, .incarnation = member});
    EXPECT_FALSE(rig.core.all_left());
  }
  rig.core.gone(rig.now_s, kRsu);
  EXPECT_TRUE(rig.core.all_left()) << "a process that dies now has left, too";
  EXPECT_EQ(rig.core.outcome()->kind, RunOutcome::Kind::kDone);
}

ClockSettings paced(double pace) {
  auto settings = ClockRig::usual();
  settings.end = 100000;
  settings.pace = pace;
  return settings;
}

TEST(ClockPace, GrantsTenSimulatedSecondsInAWallSecondAtTenfoldSpeed) {
  ClockRig rig(paced(10.0));
  rig.form();
  EXPECT_EQ(rig.the(Control::Kind::kGrant).through, 0) << "step 0 is due at once";
  rig.now_s += 1.0;
  rig.core.tick(rig.now_s);
  // 1 s x 10 = 10 s of simulation = 100 steps.
  EXPECT_EQ(rig.the(Control::Kind::kGrant).through, 100);
  rig.credit(100);
  rig.now_s += 0.5;
  rig.core.tick(rig.now_s);
  EXPECT_EQ(rig.the(Control::Kind::kGrant).through, 150);
}

TEST(ClockPace, GrantsShortWindowsEvenlyAtOnceSpeed) {
  ClockRig rig(paced(1.0));
  rig.form();
  static_cast<void>(rig.heard());
  Step before = 0;
  for (int n = 1; n <= 50; ++n) {
    rig.idle(0.1);
    EXPECT_LE(rig.granted() - before, 2) << "never more than the tick that is due, and a rounding";
    before = rig.granted();
  }
  EXPECT_NEAR(static_cast<double>(rig.granted()), 50.0, 1.0);
}

TEST(ClockPace, IsBoundByTheCreditToo) {
  ClockRig rig(paced(10.0));
  rig.form();
  rig.idle(10.0);
  EXPECT_EQ(rig.granted(), 199);
}

TEST(ClockPace, DoesNotCatchUpWhatTheHostCouldNotKeep) {
  auto settings = paced(10.0);  // 100 steps a wall second
  settings.credit = 50;
  ClockRig rig(settings);
  rig.form();
  rig.idle(10.0);
  EXPECT_EQ(rig.granted(), 49) << "the recorder has committed nothing";
  // From now on it keeps up. Catching up would bring 2000 steps by the end of the next ten seconds; allowed are the
  // 1000 of these ten seconds and at most one second's worth that was owed.
  for (int n = 0; n < 1000; ++n) {
    rig.credit(rig.granted());
    rig.now_s += 0.01;
    rig.core.tick(rig.now_s);
  }
  EXPECT_GE(rig.granted(), 49 + 990);
  EXPECT_LE(rig.granted(), 49 + 1000 + 100 + 1);
}

TEST(ClockPace, CountsAnewFromTheStepAtWhichItWasChanged) {
  ClockRig rig(paced(10.0));
  rig.form();
  rig.idle(1.0);
  rig.credit(rig.granted());
  const Step then = rig.granted();
  EXPECT_NEAR(static_cast<double>(then), 100.0, 1.0);
  EXPECT_EQ(rig.ask("pace slow"), "pace slow");
  rig.idle(2.0);
  EXPECT_NEAR(static_cast<double>(rig.granted() - then), 20.0, 1.0);
  EXPECT_EQ(rig.core.state().pace, 1.0);
  EXPECT_EQ(rig.ask("pace max"), "pace max");
  EXPECT_EQ(rig.granted(), then + 200) << "credit alone limits it now";
  EXPECT_EQ(rig.ask("pace warp"),
            "refused: pace: `warp` is not a pace; use max, very-slow, slow, medium, fast or a factor in (0, 1000000]");
}

TEST(ClockPace, CountsAnewAfterAPause) {
  ClockRig rig(paced(1.0));
  rig.form();
  rig.idle(2.0);
  static_cast<void>(rig.ask("pause"));
  const Step then = rig.granted();
  rig.all_did(then);
  rig.idle(60.0);
  EXPECT_EQ(rig.granted(), then);
  static_cast<void>(rig.ask("resume"));
  EXPECT_EQ(rig.granted(), then);
  rig.idle(3.0);
  EXPECT_NEAR(static_cast<double>(rig.granted() - then), 30.0, 1.0) << "a pause is not owed";
}

TEST(PaceOf, KnowsTheWordsOfThePaperAndFactors) {
  EXPECT_EQ(pace_of("max").value(), 0.0);
  EXPECT_EQ(pace_of("very-slow").value(), 0.1);
  EXPECT_EQ(pace_of("slow").value(), 1.0);
  EXPECT_EQ(pace_of("medium").value(), 10.0);
  EXPECT_EQ(pace_of("fast").value(), 100.0);
  EXPECT_EQ(pace_of("2.5").value(), 2.5);
  EXPECT_EQ(pace_of("1000000").value(), 1e6);
  for (const char* wrong : {"", "0", "-1", "nan", "inf", "1000001", "2x", " 2", "MAX"}) {
    EXPECT_FALSE(pace_of(wrong).ok()) << wrong;
  }
}

}  // namespace
}  // namespace lukou
