#include "tests/unit/common/lockstep/clock_rig.hpp"

namespace lukou {
namespace {

TEST(ClockStart, WelcomesEachMemberWithTheScenarioAndItsEpoch) {
  ClockRig rig;
  rig.join(kRsu, "rsu0");
  const Control welcome = rig.the(Control::Kind::kWelcome);
  EXPECT_EQ(welcome.to, kRsu);
  EXPECT_EQ(welcome.text, "run { }");
  EXPECT_EQ(welcome.epoch, 1U);
  EXPECT_EQ(rig.phase(), RunPhase::kForming);
  EXPECT_EQ(rig.core.state().text, "traffic-engine signal-controller recorder") << "who is missing";
}

TEST(ClockStart, WelcomesOnlyOnceThoughMembersAskAgain) {
  ClockRig rig;
  rig.join(kRsu, "rsu0");
  rig.join(kRsu, "rsu0");
  EXPECT_EQ(rig.heard().size(), 1U);
}

TEST(ClockStart, ShowsTheRosterOnceEverybodyHasJoined) {
  ClockRig rig;
  rig.join(kEngine, "traffic-engine");
  rig.join(kController, "signal-controller");
  rig.join(kRecorder, "recorder");
  EXPECT_TRUE(rig.heard(Control::Kind::kRoster).empty());
  rig.join(kRsu, "rsu0");
  const Control roster = rig.the(Control::Kind::kRoster);
  EXPECT_EQ(roster.to, 0U);
  EXPECT_EQ(roster.roster_version, 1U);
  EXPECT_EQ(roster.roster_incarnation, (std::vector<Incarnation>{kClock, kEngine, kController, kRecorder, kRsu}));
  EXPECT_EQ(roster.roster_role,
            (std::vector<std::string>{"clock", "traffic-engine", "signal-controller", "recorder", "rsu0"}));
}

TEST(ClockStart, GrantsNothingBeforeAllSeeEachOtherTheClockIncluded) {
  const std::vector<Incarnation> members = {kEngine, kController, kRecorder, kRsu, kClock};
  for (const Incarnation last : members) {
    ClockRig rig;
    rig.everybody_joins();
    const auto sees = [&](Incarnation who) {
      who == kClock ? rig.core.sees(rig.now_s, rig.core.roster_version()) : rig.sees(who);
    };
    for (const Incarnation who : members) {
      if (who != last) sees(who);
    }
    rig.idle(1.0);
    EXPECT_TRUE(rig.heard(Control::Kind::kGrant).empty()) << last;
    EXPECT_EQ(rig.phase(), RunPhase::kForming);
    sees(last);
    EXPECT_EQ(rig.the(Control::Kind::kGrant).through, 199) << last;
    EXPECT_EQ(rig.phase(), RunPhase::kRunning);
  }
}

TEST(ClockStart, DoesNotTakeTheViewOfAnOlderRosterForTheNewOne) {
  ClockRig rig;
  rig.everybody_joins();
  for (const auto& [incarnation, role] : rig.core.roster()) {
    rig.up({.kind = Up::Kind::kSees, .incarnation = incarnation, .number = 0});
  }
  rig.core.sees(rig.now_s, 1);
  EXPECT_TRUE(rig.heard(Control::Kind::kGrant).empty());
}

TEST(ClockStart, RefusesAnotherProtocolWithBothVersions) {
  ClockRig rig;
  rig.up({.kind = Up::Kind::kJoin, .incarnation = kRsu, .role = "rsu0", .protocol = kProtocolVersion + 6});
  const Control refuse = rig.the(Control::Kind::kRefuse);
  EXPECT_EQ(refuse.to, kRsu);
  EXPECT_EQ(refuse.text, "speaks protocol version " + std::to_string(kProtocolVersion + 6) + ", the run speaks " +
                             std::to_string(kProtocolVersion));
  EXPECT_TRUE(rig.core.roster().empty());
}

TEST(ClockStart, RefusesAnotherScenarioWithBothHashes) {
  ClockRig rig;
  rig.up({.kind = Up::Kind::kJoin, .incarnation = kRsu, .role = "rsu0", .hash = "ffff"});
  EXPECT_EQ(rig.the(Control::Kind::kRefuse).text, "was started for the scenario with hash ffff, the run's is abc123");
  rig.up({.kind = Up::Kind::kJoin, .incarnation = kRsu, .role = "rsu0", .hash = "abc123"});
  EXPECT_EQ(rig.the(Control::Kind::kWelcome).to, kRsu);
}

TEST(ClockStart, RefusesARoleThatIsTakenOrUnknown) {
  ClockRig rig;
  rig.join(kEngine, "traffic-engine");
  static_cast<void>(rig.heard());
  rig.join(33, "traffic-engine");
  EXPECT_EQ(rig.the(Control::Kind::kRefuse).text,
            "role `traffic-engine` is unknown or taken; vacant: signal-controller");
  for (const char* role : {"rsu1", "clock", "observer", ""}) {
    rig.join(34, role);
    EXPECT_EQ(rig.the(Control::Kind::kRefuse).to, 34U) << role;
    rig.idle(1.0);
  }
  rig.everybody_joins();
  static_cast<void>(rig.heard());
  rig.join(35, "rsu0");
  EXPECT_EQ(rig.the(Control::Kind::kRefuse).text, "role `rsu0` is unknown or taken; vacant: none");
}

TEST(ClockStart, RefusesOnceASecondHoweverOftenItIsAsked) {
  // Everybody hears what is said to one: a stranger that asks without end must not make the clock talk without end.
  ClockRig rig;
  for (int n = 0; n < 5000; ++n) rig.join(34, "traffic-engin");
  EXPECT_EQ(rig.heard(Control::Kind::kRefuse).size(), 1U);
  rig.idle(1.0);
  rig.join(34, "traffic-engin");
  rig.join(35, "traffic-engin");
  EXPECT_EQ(rig.heard(Control::Kind::kRefuse).size(), 2U) << "again, and another";
}

TEST(ClockStart, SaysWhoRecordsAndHowMuchTheMembersIgnored) {
  ClockRig rig;
  EXPECT_EQ(rig.core.state().recorder, 0U);
  rig.form();
  EXPECT_EQ(rig.core.state().recorder, kRecorder);
  rig.up({.kind = Up::Kind::kProgress, .incarnation = kEngine, .number = 7, .step = 1});
  rig.up({.kind = Up::Kind::kProgress, .incarnation = kRsu, .number = 3, .step = 1});
  rig.up({.kind = Up::Kind::kProgress, .incarnation = kEngine, .number = 9, .step = 2});
  rig.up({.kind = Up::Kind::kProgress, .incarnation = 777, .number = 1000, .step = 2});
  EXPECT_EQ(rig.core.state().foreign_samples, 12U) << "each says its own sum, a stranger's word counts for nothing";
}

TEST(ClockStart, HoldsAtStepZeroIfItIsToldToWait) {
  auto settings = ClockRig::usual();
  settings.start_paused = true;
  ClockRig rig(settings);
  rig.form();
  EXPECT_EQ(rig.the(Control::Kind::kGrant).through, 0);
  EXPECT_EQ(rig.phase(), RunPhase::kPaused);
  EXPECT_EQ(rig.ask("resume"), "runs");
  EXPECT_EQ(rig.granted(), 199);
}

TEST(ClockStart, SendsTheChangesOfAReplayedRunWithTheFirstGrant) {
  auto settings = ClockRig::usual();
  settings.replay = {{5, "good.a=1"}, {800, "good.b=2"}};
  ClockRig rig(settings);
  rig.everybody_joins();
  EXPECT_TRUE(rig.heard(Control::Kind::kWelcome).front().directive_step.empty());
  rig.everybody_sees();
  const Control first = rig.the(Control::Kind::kGrant);
  EXPECT_EQ(first.directive_step, (std::vector<Step>{5, 800}));
  EXPECT_EQ(first.directive_set, (std::vector<std::string>{"good.a=1", "good.b=2"}));
  rig.credit(199);
  EXPECT_TRUE(rig.the(Control::Kind::kGrant).directive_step.empty()) << "once";
}

TEST(ClockStart, GivesUpOnMembersThatDoNotComeAndNamesTheFirst) {
  ClockRig rig;
  rig.join(kEngine, "traffic-engine");
  rig.join(kRsu, "rsu0");
  rig.idle(29.8);
  EXPECT_FALSE(rig.core.outcome().has_value());
  rig.idle(0.4);
  ASSERT_TRUE(rig.core.outcome().has_value());
  EXPECT_EQ(rig.core.outcome()->kind, RunOutcome::Kind::kLost);
  EXPECT_EQ(rig.culprit(), "signal-controller");
  const Control abort = rig.the(Control::Kind::kAbort);
  EXPECT_EQ(abort.culprit, "signal-controller");
  EXPECT_EQ(abort.text, "did not join within 30 s (missing: signal-controller)");
}

TEST(ClockStart, GivesUpOnMembersThatDoNotSeeEachOther) {
  auto settings = ClockRig::usual();
  settings.forming_limit_s = 4.0;
  ClockRig rig(settings);
  rig.everybody_joins();
  rig.idle(4.2);
  EXPECT_EQ(rig.culprit(), "clock");
  EXPECT_EQ(rig.core.outcome()->text,
            "did not join within 4 s (missing: everybody joined, but not all see each other)");
}

TEST(ClockStart, AnswersNobodyAfterTheEnd) {
  ClockRig rig;
  rig.idle(30.2);
  static_cast<void>(rig.heard());
  rig.join(kEngine, "traffic-engine");
  EXPECT_TRUE(rig.heard().empty());
}

}  // namespace
}  // namespace lukou
