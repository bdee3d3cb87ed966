#include "tests/unit/common/lockstep/clock_rig.hpp"

namespace lukou {
namespace {

struct Role {
  Incarnation incarnation;
  const char* name;
};
constexpr Role kEverybody[] = {
    {kEngine, "traffic-engine"}, {kController, "signal-controller"}, {kRecorder, "recorder"}, {kRsu, "rsu0"}};

/// The run has ended with an Abort that names the culprit, and nothing is granted any more.
void expect_aborted(ClockRig& rig, const std::string& culprit, RunOutcome::Kind kind = RunOutcome::Kind::kLost) {
  const Control abort = rig.the(Control::Kind::kAbort);
  EXPECT_EQ(abort.culprit, culprit);
  EXPECT_EQ(abort.to, 0U);
  ASSERT_TRUE(rig.core.outcome().has_value());
  EXPECT_EQ(rig.core.outcome()->kind, kind);
  EXPECT_EQ(rig.culprit(), culprit);
  EXPECT_EQ(rig.core.state().culprit, culprit);
  EXPECT_EQ(rig.core.state().text, abort.text);
  EXPECT_EQ(rig.phase(), RunPhase::kAborted);
  rig.credit(500);
  rig.idle(1.0);
  EXPECT_TRUE(rig.heard().empty());
}

TEST(ClockLosses, OfAMemberThatIsGoneAbortTheRunAndNameIt) {
  for (const Role& role : kEverybody) {
    ClockRig rig;
    rig.form();
    rig.credit(80);
    static_cast<void>(rig.heard());
    rig.core.gone(rig.now_s, role.incarnation);
    ASSERT_TRUE(rig.core.outcome().has_value()) << role.name;
    EXPECT_EQ(rig.core.outcome()->complete_to, 80) << "what the recorder committed";
    expect_aborted(rig, role.name);
  }
}

TEST(ClockLosses, ThatTheLauncherReportsAbortTheRunWithItsWords) {
  for (const Role& role : kEverybody) {
    ClockRig rig;
    rig.form();
    static_cast<void>(rig.heard());
    rig.up({.kind = Up::Kind::kLost, .incarnation = kLauncher, .role = role.name, .text = "was killed by signal 9"});
    ASSERT_TRUE(rig.core.outcome().has_value()) << role.name;
    EXPECT_EQ(rig.core.outcome()->text, "was killed by signal 9");
    expect_aborted(rig, role.name);
  }
}

TEST(ClockLosses, OfAMemberThatLeavesBeforeTheEndAbortTheRun) {
  // As a process does that is told to terminate: it says good-bye, and the others would wait for its batches.
  for (const Role& role : kEverybody) {
    ClockRig rig;
    rig.form();
    static_cast<void>(rig.heard());
    rig.up({.kind = Up::Kind::kLeave, .incarnation = role.incarnation, .step = 17});
    ASSERT_TRUE(rig.core.outcome().has_value()) << role.name;
    EXPECT_EQ(rig.core.outcome()->text, "left before the end of the run");
    expect_aborted(rig, role.name);
  }
}

TEST(ClockLosses, ThatAMemberSeesAbortTheRunWithItsWords) {
  ClockRig rig;
  rig.form();
  static_cast<void>(rig.heard());
  // As the engine does that cannot use what the controller sends, and a member that ends with an error of its own.
  rig.up({.kind = Up::Kind::kLost, .incarnation = kEngine, .role = "signal-controller", .text = "leaves a gap"});
  EXPECT_EQ(rig.core.outcome()->text, "leaves a gap");
  expect_aborted(rig, "signal-controller");
}

TEST(ClockLosses, OfTheClockItselfAreItsOwnFault) {
  // It did not run for a while: the members have given it up, and their leaving is not their fault.
  ClockRig rig;
  rig.form();
  rig.credit(80);
  static_cast<void>(rig.heard());
  rig.up({.kind = Up::Kind::kLost, .incarnation = kEngine, .role = "clock", .text = "the clock is gone"});
  rig.up({.kind = Up::Kind::kLeave, .incarnation = kEngine, .step = 100});
  EXPECT_EQ(rig.core.outcome()->complete_to, 80);
  expect_aborted(rig, "clock");

  ClockRig ended;
  ended.form();
  static_cast<void>(ended.heard());
  ended.core.fail("clock", "was ended by a signal");
  ended.core.fail("clock", "and again");
  EXPECT_EQ(ended.core.outcome()->text, "was ended by a signal");
  expect_aborted(ended, "clock");
}

TEST(ClockLosses, WhileTheRunFormsAbortIt) {
  for (const Role& role : kEverybody) {
    ClockRig joined;
    joined.join(role.incarnation, role.name);
    static_cast<void>(joined.heard());
    joined.core.gone(joined.now_s, role.incarnation);
    expect_aborted(joined, role.name);

    ClockRig never;
    never.up({.kind = Up::Kind::kLost, .incarnation = kLauncher, .role = role.name, .text = "ended with code 2"});
    expect_aborted(never, role.name);
  }
}

TEST(ClockLosses, WhileTheRunEndsStillAbortIt) {
  ClockRig rig;
  rig.form();
  static_cast<void>(rig.ask("stop"));
  rig.core.gone(rig.now_s, kRecorder);
  expect_aborted(rig, "recorder");
}

TEST(ClockLosses, OfStrangersDoNotMatter) {
  ClockRig rig;
  rig.form();
  static_cast<void>(rig.heard());
  rig.core.gone(rig.now_s, 777);
  rig.up({.kind = Up::Kind::kLost, .incarnation = kLauncher, .role = "rsu9", .text = "?"});
  rig.up({.kind = Up::Kind::kLeave, .incarnation = 777});
  rig.up({.kind = Up::Kind::kCredit, .incarnation = 777, .step = 900});
  EXPECT_FALSE(rig.core.outcome().has_value());
  EXPECT_TRUE(rig.heard().empty());
}

TEST(ClockLosses, ThatStrangersTellOfDoNotMatter) {
  for (const Incarnation stranger : {Incarnation{0}, Incarnation{777}, kOperator}) {
    ClockRig rig;
    rig.form();
    static_cast<void>(rig.heard());
    for (const char* role : {"rsu0", "recorder", "clock"}) {
      rig.up({.kind = Up::Kind::kLost, .incarnation = stranger, .role = role, .text = "is lost, believe me"});
    }
    EXPECT_FALSE(rig.core.outcome().has_value()) << stranger;
    EXPECT_TRUE(rig.heard().empty());
  }
  // Nor while it forms, nor where nobody has said who the launcher is.
  auto settings = ClockRig::usual();
  settings.launcher = 0;
  ClockRig forming(settings);
  forming.up({.kind = Up::Kind::kLost, .role = "rsu0", .text = "is lost"});
  EXPECT_FALSE(forming.core.outcome().has_value());
}

TEST(ClockLosses, AfterTheEndChangeNothing) {
  ClockRig rig;
  rig.form();
  rig.close();
  static_cast<void>(rig.heard());
  rig.core.gone(rig.now_s, kEngine);
  rig.up({.kind = Up::Kind::kLost, .incarnation = kLauncher, .role = "recorder", .text = "?"});
  EXPECT_EQ(rig.core.outcome()->kind, RunOutcome::Kind::kDone);
  EXPECT_TRUE(rig.heard().empty());
}

TEST(ClockLosses, AreNotBelievedOnSilenceAloneWithoutAWatchdog) {
  auto settings = ClockRig::usual();
  settings.watchdog = false;
  ClockRig rig(settings);
  rig.form();
  rig.core.gone(rig.now_s, kRsu);
  EXPECT_FALSE(rig.core.outcome().has_value()) << "it may stand in a debugger";
  static_cast<void>(rig.heard());
  rig.up({.kind = Up::Kind::kLost, .incarnation = kLauncher, .role = "rsu0", .text = "ended with code 1"});
  expect_aborted(rig, "rsu0");
}

}  // namespace
}  // namespace lukou
