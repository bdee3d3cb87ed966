#include "tests/unit/common/lockstep/clock_rig.hpp"

namespace lukou {
namespace {

constexpr Incarnation kReborn = 21;
constexpr Incarnation kThird = 22;

/// A run that has granted steps 0..300, of which 100 are committed.
ClockRig running(RsuLossPolicy policy) {
  auto settings = ClockRig::usual();
  settings.on_rsu_loss = policy;
  settings.end = 10000;
  ClockRig rig(settings);
  rig.form();
  rig.credit(100);
  static_cast<void>(rig.heard());
  return rig;
}

void receipt(ClockRig& rig, Step cut) {
  rig.up({.kind = Up::Kind::kReceipt, .incarnation = kEngine, .number = 0, .step = cut});
}

/// Brings a new start of the RSU as far as the attach that its next grant holds.
Control attached_with(ClockRig& rig, Incarnation incarnation) {
  rig.join(incarnation, "rsu0");
  rig.everybody_sees();
  static_cast<void>(rig.heard(Control::Kind::kWelcome));
  rig.all_did(rig.granted());
  return rig.the(Control::Kind::kGrant);
}

TEST(ClockRsuContinue, FencesTheLostOneAtOnceAndGoesOn) {
  ClockRig rig = running(RsuLossPolicy::kContinue);
  rig.core.gone(rig.now_s, kRsu);
  const Control fence = rig.the(Control::Kind::kFence);
  EXPECT_EQ(fence.rsu, 0U);
  EXPECT_EQ(fence.epoch, 1U);
  EXPECT_EQ(fence.to, 0U);
  EXPECT_FALSE(rig.core.outcome().has_value());
  rig.credit(300);
  EXPECT_EQ(rig.the(Control::Kind::kGrant).through, 500) << "the others go on, receipt or not";
}

TEST(ClockRsuContinue, FencesOneThatSaysGoodBye) {
  ClockRig rig = running(RsuLossPolicy::kContinue);
  rig.up({.kind = Up::Kind::kLeave, .incarnation = kRsu, .step = 200});
  EXPECT_EQ(rig.the(Control::Kind::kFence).epoch, 1U);
  rig.core.gone(rig.now_s, kRsu);
  rig.up({.kind = Up::Kind::kLost, .incarnation = kLauncher, .role = "rsu0", .text = "ended"});
  EXPECT_TRUE(rig.heard().empty()) << "the same loss told again";
}

TEST(ClockRsuContinue, AnswersAJoinOnlyAfterTheReceipt) {
  ClockRig rig = running(RsuLossPolicy::kContinue);
  rig.core.gone(rig.now_s, kRsu);
  static_cast<void>(rig.heard());
  rig.join(kReborn, "rsu0");
  EXPECT_TRUE(rig.heard().empty()) << "neither welcomed nor refused: it asks again";
  receipt(rig, 187);
  rig.join(kReborn, "rsu0");
  const auto out = rig.heard();
  ASSERT_EQ(out.size(), 2U);
  EXPECT_EQ(out[0].kind, Control::Kind::kWelcome);
  EXPECT_EQ(out[0].epoch, 2U);
  EXPECT_EQ(out[1].kind, Control::Kind::kRoster);
  EXPECT_EQ(out[1].roster_version, 2U);
}

TEST(ClockRsuContinue, AttachesTheNextLifeBeyondEverythingGranted) {
  ClockRig rig = running(RsuLossPolicy::kContinue);
  rig.core.gone(rig.now_s, kRsu);
  receipt(rig, 187);
  const Control grant = attached_with(rig, kReborn);
  EXPECT_EQ(grant.attach_rsu, std::vector<std::uint32_t>{0});
  EXPECT_EQ(grant.attach_epoch, std::vector<std::uint32_t>{2});
  // Granted were 0..300. Promise 10: stride 5, delay 6; 301 + 6 + 5.
  EXPECT_EQ(grant.attach_from, std::vector<Step>{312});
  rig.all_did(rig.granted());
  EXPECT_TRUE(rig.the(Control::Kind::kGrant).attach_rsu.empty()) << "said once";
}

TEST(ClockRsuContinue, DoesNotAttachBeforeEverybodySeesTheNewOne) {
  ClockRig rig = running(RsuLossPolicy::kContinue);
  rig.core.gone(rig.now_s, kRsu);
  receipt(rig, 187);
  rig.join(kReborn, "rsu0");
  static_cast<void>(rig.heard());
  for (const Incarnation who : {kController, kRecorder, kReborn}) rig.sees(who);
  rig.core.sees(rig.now_s, rig.core.roster_version());
  rig.all_did(300);
  EXPECT_TRUE(rig.the(Control::Kind::kGrant).attach_rsu.empty()) << "the engine does not see it";
  rig.sees(kEngine);
  rig.all_did(500);
  const Control grant = rig.the(Control::Kind::kGrant);
  EXPECT_EQ(grant.attach_epoch, std::vector<std::uint32_t>{2});
  EXPECT_EQ(grant.attach_from, std::vector<Step>{512});
}

TEST(ClockRsuContinue, TellsTheNewOneEveryChangeSoFar) {
  ClockRig rig = running(RsuLossPolicy::kContinue);
  static_cast<void>(rig.ask("set good.a=1"));
  rig.all_did(300);
  rig.core.gone(rig.now_s, kRsu);
  receipt(rig, 187);
  static_cast<void>(rig.ask("set good.b=2"));  // not granted yet: it comes with the next grant
  static_cast<void>(rig.heard());
  rig.join(kReborn, "rsu0");
  const auto welcomes = rig.heard(Control::Kind::kWelcome);
  ASSERT_EQ(welcomes.size(), 1U);
  EXPECT_EQ(welcomes[0].directive_set, std::vector<std::string>{"good.a=1"});
  EXPECT_EQ(welcomes[0].directive_step, std::vector<Step>{301});
  rig.all_did(500);
  EXPECT_EQ(rig.the(Control::Kind::kGrant).directive_set, std::vector<std::string>{"good.b=2"});
}

TEST(ClockRsuContinue, CountsEveryLifeAndFencesTheOneThatIsLost) {
  ClockRig rig = running(RsuLossPolicy::kContinue);
  rig.core.gone(rig.now_s, kRsu);
  receipt(rig, 187);
  rig.join(kReborn, "rsu0");
  static_cast<void>(rig.heard());
  rig.core.gone(rig.now_s, kReborn);  // before it was attached
  EXPECT_EQ(rig.the(Control::Kind::kFence).epoch, 2U);
  rig.all_did(300);
  EXPECT_TRUE(rig.the(Control::Kind::kGrant).attach_rsu.empty()) << "its attach is void";
  receipt(rig, kNever);
  EXPECT_EQ(attached_with(rig, kThird).attach_epoch, std::vector<std::uint32_t>{3});
}

TEST(ClockRsuContinue, StillAbortsWhenAnybodyElseIsLost) {
  ClockRig rig = running(RsuLossPolicy::kContinue);
  rig.core.gone(rig.now_s, kEngine);
  EXPECT_EQ(rig.the(Control::Kind::kAbort).culprit, "traffic-engine");
}

TEST(ClockRsuContinue, FencesOneThatHasStalled) {
  ClockRig rig = running(RsuLossPolicy::kContinue);
  for (int n = 0; n < 310; ++n) {
    for (const Incarnation who : {kEngine, kController, kRecorder}) rig.progress(who, 42, "rsu0");
    rig.progress(kRsu, 41, "");
    rig.idle(0.1);
  }
  EXPECT_EQ(rig.the(Control::Kind::kFence).rsu, 0U);
  EXPECT_FALSE(rig.core.outcome().has_value());
}

TEST(ClockRsuWait, GrantsNothingUntilTheRsuIsBackAndAttached) {
  ClockRig rig = running(RsuLossPolicy::kWait);
  rig.core.gone(rig.now_s, kRsu);
  EXPECT_EQ(rig.the(Control::Kind::kFence).epoch, 1U);
  rig.all_did(300);
  rig.idle(120.0);
  EXPECT_TRUE(rig.heard().empty()) << "no grant, and no stall either";
  receipt(rig, 187);
  rig.join(kReborn, "rsu0");
  rig.idle(120.0);
  EXPECT_TRUE(rig.heard(Control::Kind::kGrant).empty()) << "not everybody sees it";
  EXPECT_FALSE(rig.core.outcome().has_value());
  rig.everybody_sees();
  const Control grant = rig.the(Control::Kind::kGrant);
  EXPECT_EQ(grant.through, 500);
  EXPECT_EQ(grant.attach_epoch, std::vector<std::uint32_t>{2});
  EXPECT_EQ(grant.attach_from, std::vector<Step>{312});
}

TEST(ClockRsuWait, StillAnswersTheOperator) {
  ClockRig rig = running(RsuLossPolicy::kWait);
  rig.core.gone(rig.now_s, kRsu);
  EXPECT_EQ(rig.ask("pause"), "pauses at step 300 (30.0 s)");
}

TEST(ClockRsuWait, EndsWithoutTheRsuWhereTheOperatorSaysSo) {
  ClockRig rig = running(RsuLossPolicy::kWait);
  rig.core.gone(rig.now_s, kRsu);
  rig.all_did(300);
  rig.idle(120.0);
  static_cast<void>(rig.heard());
  EXPECT_EQ(rig.ask("interrupt"), "ends at step 300 (30.0 s)");
  ASSERT_EQ(rig.others.size(), 1U);
  EXPECT_EQ(rig.others[0].kind, Control::Kind::kGrant);
  EXPECT_EQ(rig.others[0].through, 300);
  EXPECT_TRUE(rig.others[0].last);
  EXPECT_EQ(rig.others[0].text, "interrupted");
  rig.close("", 300);
  EXPECT_EQ(rig.core.outcome()->kind, RunOutcome::Kind::kStopped);
}

TEST(ClockRsuWait, GoesOnWaitingIfItIsToEndLater) {
  ClockRig rig = running(RsuLossPolicy::kWait);
  rig.core.gone(rig.now_s, kRsu);
  rig.all_did(300);
  static_cast<void>(rig.heard());
  EXPECT_EQ(rig.ask("stop at 60"), "ends at step 600 (60.0 s)");
  rig.idle(1.0);
  EXPECT_TRUE(rig.others.empty());
  EXPECT_TRUE(rig.heard().empty());
}

}  // namespace
}  // namespace lukou
