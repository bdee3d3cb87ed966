#include "tests/unit/common/lockstep/clock_rig.hpp"

namespace lukou {
namespace {

constexpr Incarnation kReborn = 21;

ClockRig running(ClockSettings settings = ClockRig::usual()) {
  ClockRig rig(std::move(settings));
  rig.form();
  rig.credit(0);
  static_cast<void>(rig.heard());
  return rig;
}

/// Everybody stands at a step and says again and again for whom it waits.
void stand_still(ClockRig& rig, double duration_s, const std::map<Incarnation, std::string>& waits_for) {
  for (int n = 0; n < static_cast<int>(duration_s * 10.0 + 0.5); ++n) {
    for (const auto& [who, whom] : waits_for) rig.progress(who, 41, whom);
    rig.idle(0.1);
  }
}

TEST(ClockWatch, NamesTheOneThatWaitsForNobody) {
  const std::map<Incarnation, std::string> waits = {
      {kEngine, "rsu0"}, {kController, "clock"}, {kRecorder, "traffic-engine"}, {kRsu, ""}};
  ClockRig rig = running();
  stand_still(rig, 29.5, waits);
  EXPECT_FALSE(rig.core.outcome().has_value());
  stand_still(rig, 1.0, waits);
  ASSERT_TRUE(rig.core.outcome().has_value());
  EXPECT_EQ(rig.core.outcome()->kind, RunOutcome::Kind::kStalled);
  EXPECT_EQ(rig.culprit(), "rsu0");
  EXPECT_EQ(rig.the(Control::Kind::kAbort).text, "has not finished step 42 for 30 s");
}

TEST(ClockWatch, NamesTheOneThatDoesNotEvenSayForWhomItWaits) {
  // A process that computes without end says nothing: its last word is from before that step.
  ClockRig rig = running();
  rig.progress(kRsu, 41, "traffic-engine");
  stand_still(rig, 31.0, {{kEngine, "rsu0"}, {kController, "clock"}, {kRecorder, "traffic-engine"}});
  EXPECT_EQ(rig.culprit(), "rsu0");
  EXPECT_EQ(rig.core.outcome()->kind, RunOutcome::Kind::kStalled);
}

TEST(ClockWatch, NamesTheStepFromThoseWhoWaitForIt) {
  // The RSU has never waited since step 0, so it has never said how far it is. The engine, done with step 41, needs for
  // step 42 what the RSU answers in step 41.
  ClockRig rig = running();
  stand_still(rig, 31.0, {{kEngine, "rsu0"}, {kController, "clock"}, {kRecorder, "traffic-engine"}});
  EXPECT_EQ(rig.core.outcome()->text, "has not finished step 41 for 30 s");

  // What the recorder, done with step 41, needs for step 42 is the engine's batch of that step.
  ClockRig engine = running();
  stand_still(engine, 31.0, {{kController, "clock"}, {kRecorder, "traffic-engine"}, {kRsu, "traffic-engine"}});
  EXPECT_EQ(engine.core.outcome()->text, "has not finished step 42 for 30 s");
}

TEST(ClockWatch, NamesItselfIfAllWaitForEachOther) {
  ClockRig rig = running();
  stand_still(rig, 31.0, {{kEngine, "rsu0"}, {kController, "clock"}, {kRecorder, "x"}, {kRsu, "traffic-engine"}});
  EXPECT_EQ(rig.culprit(), "clock");
  EXPECT_EQ(rig.core.outcome()->kind, RunOutcome::Kind::kStalled);
}

TEST(ClockWatch, IsContentAsLongAsAnybodyMakesProgress) {
  ClockRig rig = running();
  for (Step step = 0; step < 190; ++step) {
    rig.progress(kEngine, step, "");
    rig.idle(20.0);
  }
  EXPECT_FALSE(rig.core.outcome().has_value());
}

TEST(ClockWatch, DoesNotTakeRepeatedNewsForProgress) {
  ClockRig rig = running();
  rig.progress(kEngine, 41, "");
  stand_still(rig, 31.0, {{kEngine, ""}, {kController, "clock"}, {kRecorder, "traffic-engine"}, {kRsu, "clock"}});
  EXPECT_EQ(rig.culprit(), "traffic-engine");
}

TEST(ClockWatch, IsSilentWhileTheRunIsPaused) {
  ClockRig rig = running();
  rig.all_did(200);
  static_cast<void>(rig.ask("pause"));
  rig.all_did(rig.granted());
  rig.idle(3600.0);
  EXPECT_FALSE(rig.core.outcome().has_value());
}

TEST(ClockWatch, IsSilentWhileEverythingGrantedIsDone) {
  auto settings = ClockRig::usual();
  settings.pace = 0.001;  // a step every hundred seconds
  ClockRig rig = running(settings);
  for (int n = 0; n < 35; ++n) {
    rig.all_did(rig.granted());
    rig.idle(10.0);
  }
  EXPECT_EQ(rig.granted(), 3);
  EXPECT_FALSE(rig.core.outcome().has_value());
}

TEST(ClockWatch, CountsFromTheEndOfAPause) {
  ClockRig rig = running();
  static_cast<void>(rig.ask("pause"));
  rig.all_did(rig.granted());
  rig.idle(100.0);
  static_cast<void>(rig.ask("resume"));
  stand_still(rig, 29.0, {{kEngine, ""}});
  EXPECT_FALSE(rig.core.outcome().has_value());
  stand_still(rig, 2.0, {{kEngine, ""}});
  EXPECT_TRUE(rig.core.outcome().has_value());
}

TEST(ClockWatch, DoesNotWaitForAReturnedRsuInAPausedRun) {
  auto settings = ClockRig::usual();
  settings.on_rsu_loss = RsuLossPolicy::kContinue;
  ClockRig rig = running(settings);
  rig.core.gone(rig.now_s, kRsu);
  rig.up({.kind = Up::Kind::kReceipt, .incarnation = kEngine, .number = 0, .step = 42});
  static_cast<void>(rig.ask("pause"));
  rig.all_did(rig.granted());
  rig.join(kReborn, "rsu0");
  rig.everybody_sees();
  for (int n = 0; n < 600; ++n) {
    rig.progress(kReborn, -1, "clock");
    rig.idle(0.1);
  }
  EXPECT_FALSE(rig.core.outcome().has_value()) << rig.core.outcome()->text;
}

TEST(ClockWatch, ExpectsOfAReturnedRsuOnlyTheStepsFromItsAttachOn) {
  auto settings = ClockRig::usual();
  settings.on_rsu_loss = RsuLossPolicy::kContinue;
  ClockRig rig = running(settings);
  rig.core.gone(rig.now_s, kRsu);
  rig.up({.kind = Up::Kind::kReceipt, .incarnation = kEngine, .number = 0, .step = 42});
  static_cast<void>(rig.ask("pause"));
  rig.all_did(rig.granted());
  rig.join(kReborn, "rsu0");
  rig.everybody_sees();
  static_cast<void>(rig.heard());
  static_cast<void>(rig.ask("step 3"));  // the grant that attaches it, at a later step
  ASSERT_FALSE(rig.others.empty());
  ASSERT_EQ(rig.others.back().attach_from.size(), 1U);
  ASSERT_GT(rig.others.back().attach_from[0], rig.granted());
  for (int n = 0; n < 600; ++n) {
    for (const Incarnation who : {kEngine, kController, kRecorder}) rig.progress(who, rig.granted(), "clock");
    rig.progress(kReborn, -1, "clock");
    rig.idle(0.1);
  }
  EXPECT_FALSE(rig.core.outcome().has_value());
}

TEST(ClockWatch, WatchesTheRecorderWhileItCloses) {
  ClockRig rig = running();
  static_cast<void>(rig.ask("stop"));
  for (int n = 0; n < 310; ++n) {
    for (const Incarnation who : {kEngine, kController, kRsu}) rig.progress(who, rig.granted(), "clock");
    rig.idle(0.1);
  }
  EXPECT_EQ(rig.culprit(), "recorder") << "all steps are done; it has fallen silent over its files";
}

TEST(ClockWatch, StartsEveryDeadlineAgainAfterAGapInItsOwnTicks) {
  // Ctrl-Z, a suspended laptop: everybody looks late, the clock first of all.
  ClockRig rig = running();
  stand_still(rig, 20.0, {{kEngine, ""}});
  rig.now_s += 3600.0;
  rig.core.tick(rig.now_s);
  EXPECT_FALSE(rig.core.outcome().has_value());
  stand_still(rig, 29.0, {{kEngine, ""}});
  EXPECT_FALSE(rig.core.outcome().has_value());
  stand_still(rig, 2.0, {{kEngine, ""}});
  EXPECT_TRUE(rig.core.outcome().has_value());

  ClockRig forming;
  forming.idle(20.0);
  forming.now_s += 3600.0;
  forming.core.tick(forming.now_s);
  forming.idle(9.0);
  EXPECT_FALSE(forming.core.outcome().has_value()) << "29 s of its own time";
  forming.idle(2.0);
  EXPECT_TRUE(forming.core.outcome().has_value());
}

TEST(ClockWatch, HasNoDeadlineWithoutAWatchdog) {
  auto settings = ClockRig::usual();
  settings.watchdog = false;
  ClockRig forming(settings);
  forming.idle(1000.0);
  EXPECT_FALSE(forming.core.outcome().has_value());
  ClockRig rig = running(settings);
  stand_still(rig, 1000.0, {{kEngine, ""}});
  EXPECT_FALSE(rig.core.outcome().has_value());
}

}  // namespace
}  // namespace lukou
