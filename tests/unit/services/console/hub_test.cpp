#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "common/core/keyed_random.hpp"
#include "console.pb.h"
#include "tests/unit/services/console/hub_rig.hpp"

namespace lukou::console {
namespace {

TEST(Hub, GreetsFirst) {
  Rig rig;
  const ViewerId early = rig.hub.came();
  EXPECT_EQ(rig.hub.next(early), nullptr) << "no run is known yet";
  rig.begin();
  const auto messages = rig.all(early);
  ASSERT_GE(messages.size(), 3U);
  EXPECT_TRUE(messages[0].has_hello());
  EXPECT_EQ(messages[0].hello().viewer(), early);
  EXPECT_TRUE(messages[1].has_history());
  EXPECT_TRUE(messages[2].has_hands());
  EXPECT_EQ(messages[2].hands().viewers(), 1U);
}

TEST(Hub, SendsTheNewestPictureAndSkipsTheOnesBetween) {
  Rig rig;
  rig.begin();
  const ViewerId viewer = rig.hub.came();
  for (Step step = 1; step <= 5; ++step) rig.show(step, 0.1 * static_cast<double>(step));
  auto pictures = rig.all(viewer, ToPage::kPicture);
  ASSERT_EQ(pictures.size(), 1U);
  EXPECT_EQ(pictures[0].picture().step(), 5);
  EXPECT_TRUE(pictures[0].picture().has_program()) << "the first one brings the program";
  rig.show(6, 0.6);
  pictures = rig.all(viewer, ToPage::kPicture);
  ASSERT_EQ(pictures.size(), 1U);
  EXPECT_FALSE(pictures[0].picture().has_program());
  rig.show(7, 0.7);
  EXPECT_TRUE(rig.all(viewer, ToPage::kPicture).empty()) << "two are not drawn yet";
  rig.draw(viewer);
  EXPECT_EQ(rig.all(viewer, ToPage::kPicture).size(), 1U);
}

TEST(Hub, TellsANewProgramAlsoToAViewerWhoSkippedItsFirstPicture) {
  Rig rig;
  rig.begin();
  const ViewerId viewer = rig.hub.came();
  rig.show(1, 0.1);
  rig.show(2, 0.2);
  ASSERT_EQ(rig.all(viewer, ToPage::kPicture).size(), 1U);
  rig.hub.hear({.directive_step = {100}, .directive_set = {"signals.preset=PAPER_YELLOW"}});
  // It takes over with the cycle that starts at 900.
  rig.show(899, 1.0);
  ASSERT_EQ(rig.all(viewer, ToPage::kPicture).size(), 1U);
  rig.show(900, 1.1);
  rig.show(901, 1.2);
  rig.draw(viewer);
  const auto pictures = rig.all(viewer, ToPage::kPicture);
  ASSERT_EQ(pictures.size(), 1U);
  EXPECT_EQ(pictures[0].picture().step(), 901);
  ASSERT_TRUE(pictures[0].picture().has_program());
  EXPECT_EQ(pictures[0].picture().program_from(), 900);
}

TEST(Hub, SendsStatisticsFiveTimesASecond) {
  Rig rig;
  rig.begin();
  const ViewerId viewer = rig.hub.came();
  std::size_t sent = 0;
  for (int i = 0; i < 100; ++i) {  // 10 s, ten pictures a second
    rig.show(i, 0.1 * i);
    rig.draw(viewer);
    sent += rig.all(viewer, ToPage::kStatistics).size();
  }
  EXPECT_LE(sent, 50U);
  EXPECT_GE(sent, 30U);
}

TEST(Hub, SendsTheFiguresOfTheLastStepBeforeAPause) {
  Rig rig;
  rig.begin();
  const ViewerId viewer = rig.hub.came();
  rig.show(1, 1.0);
  rig.show(2, 1.05);
  auto figures = rig.all(viewer, ToPage::kStatistics);
  ASSERT_EQ(figures.size(), 1U);
  EXPECT_EQ(figures[0].statistics().step(), 1);
  rig.hub.tell({.phase = RunPhase::kPaused}, 0.0, 1.1);
  EXPECT_TRUE(rig.all(viewer, ToPage::kStatistics).empty());
  rig.hub.tell({.phase = RunPhase::kPaused}, 0.0, 1.25);
  figures = rig.all(viewer, ToPage::kStatistics);
  ASSERT_EQ(figures.size(), 1U);
  EXPECT_EQ(figures[0].statistics().step(), 2);
}

TEST(Hub, PassesRequestsOfTheHolderToTheClockOneByOne) {
  Rig rig;
  rig.begin();
  const ViewerId viewer = rig.hub.came();
  rig.take_control(viewer);
  static_cast<void>(rig.all(viewer));
  rig.ask(viewer, "pause", 7);
  rig.ask(viewer, "set traffic.west.flow_veh_per_h=900", 8);
  EXPECT_EQ(rig.hub.take_request(), "pause");
  EXPECT_EQ(rig.hub.take_request(), std::nullopt) << "one is under way";
  rig.hub.answered(true, "pauses at step 10 (1.0 s)");
  EXPECT_EQ(rig.hub.take_request(), "set traffic.west.flow_veh_per_h=900");
  rig.hub.answered(false, "this run takes no changes");
  const auto replies = rig.all(viewer, ToPage::kReply);
  ASSERT_EQ(replies.size(), 2U);
  EXPECT_EQ(replies[0].reply().number(), 7U);
  EXPECT_TRUE(replies[0].reply().ok());
  EXPECT_EQ(replies[1].reply().number(), 8U);
  EXPECT_FALSE(replies[1].reply().ok());
  EXPECT_EQ(replies[1].reply().text(), "this run takes no changes");
}

TEST(Hub, RefusesItselfWhatIsNotForTheClock) {
  Rig rig;
  rig.begin();
  const ViewerId one = rig.hub.came();
  const ViewerId two = rig.hub.came();
  EXPECT_EQ(rig.refusal(one, "pause"), "nobody has control; take it first");
  rig.take_control(two);
  EXPECT_EQ(rig.refusal(one, "pause"), "viewer 2 has control");
  rig.take_control(one);
  EXPECT_EQ(rig.refusal(one, "pause"), "viewer 2 has control");
  rig.take_control(one, true);
  EXPECT_EQ(rig.refusal(one, "pause"), "");
  for (const char* foreign : {"interrupt", "scenario", "", " pause", "PAUSE", "restart"}) {
    EXPECT_NE(rig.refusal(one, foreign), "") << foreign;
  }
  EXPECT_NE(rig.refusal(one, "set a=" + std::string(40'000, 'x')), "");
  EXPECT_NE(rig.refusal(one, std::string("set a=1\0b", 9)), "");
  rig.hub.tell({.phase = RunPhase::kEnded}, 0.0, 1.0);
  EXPECT_EQ(rig.refusal(one, "pause"), "the run has ended");
}

TEST(Hub, LetsRequestsWaitUpToALimit) {
  Rig rig;
  rig.begin();
  const ViewerId viewer = rig.hub.came();
  rig.take_control(viewer);
  static_cast<void>(rig.all(viewer));
  for (std::uint32_t n = 1; n <= 64; ++n) rig.ask(viewer, "step", n);
  EXPECT_TRUE(rig.all(viewer, ToPage::kReply).empty());
  EXPECT_EQ(rig.refusal(viewer, "step"), "too many requests wait for their answer");
}

TEST(Hub, TellsEachChangeOnceWhoeverMadeIt) {
  Rig rig;
  rig.begin();
  const ViewerId actor = rig.hub.came();
  const ViewerId watcher = rig.hub.came();
  rig.take_control(actor);
  static_cast<void>(rig.all(watcher));
  rig.ask(actor, "set traffic.west.flow_veh_per_h=900");
  ASSERT_TRUE(rig.hub.take_request());
  rig.hub.answered(true, "traffic.west.flow_veh_per_h=900 from step 51 (5.1 s)");
  auto events = rig.all(watcher, ToPage::kEvent);
  ASSERT_EQ(events.size(), 1U) << "at once, also while the run is held";
  EXPECT_EQ(events[0].event().kind(), "directive");
  EXPECT_EQ(events[0].event().step(), 51);
  EXPECT_EQ(events[0].event().text(), "traffic.west.flow_veh_per_h=900");
  // Its grant comes later, with one that somebody made by `lukou ctl`.
  rig.hub.hear({.directive_step = {51, 51},
                .directive_set = {"traffic.west.flow_veh_per_h=900", "traffic.east.flow_veh_per_h=100"}});
  events = rig.all(watcher, ToPage::kEvent);
  ASSERT_EQ(events.size(), 1U);
  EXPECT_EQ(events[0].event().text(), "traffic.east.flow_veh_per_h=100");
}

TEST(Hub, TellsALaterViewerWhatHasHappened) {
  Rig rig;
  rig.begin({{20, "vehicles.equipped_ratio=0.5"}});
  for (int i = 1; i <= 20; ++i) rig.show(i, i);
  const ViewerId late = rig.hub.came();
  const auto messages = rig.all(late);
  ASSERT_TRUE(messages[1].has_history());
  const History& history = messages[1].history();
  EXPECT_EQ(history.samples_size(), 20);
  ASSERT_EQ(history.events_size(), 1);
  EXPECT_EQ(history.events(0).text(), "vehicles.equipped_ratio=0.5");
  bool found = false;
  for (const LiveField& field : messages[0].hello().live()) {
    if (field.path() == "vehicles.equipped_ratio") found = field.value() == "0.5";
  }
  EXPECT_TRUE(found) << "the value in force";
}

TEST(Hub, TellsOfLossesAndReturns) {
  Rig rig;
  rig.begin();
  const ViewerId viewer = rig.hub.came();
  static_cast<void>(rig.all(viewer));
  rig.hub.hear({.kind = Control::Kind::kFence, .rsu = 0});
  rig.hub.hear({.kind = Control::Kind::kGrant, .attach_rsu = {0}, .attach_epoch = {2}, .attach_from = {80}});
  const auto events = rig.all(viewer, ToPage::kEvent);
  ASSERT_EQ(events.size(), 2U);
  EXPECT_EQ(events[0].event().kind(), "lost");
  EXPECT_EQ(events[1].event().kind(), "returned");
  EXPECT_EQ(events[1].event().step(), 80);
}

TEST(Hub, TellsStatusOnChangeAndNowAndThen) {
  Rig rig;
  rig.begin();
  const ViewerId viewer = rig.hub.came();
  const auto statuses = [&] { return rig.all(viewer, ToPage::kStatus).size(); };
  rig.hub.tell({.phase = RunPhase::kRunning}, 0.0, 0.0);
  EXPECT_EQ(statuses(), 1U);
  rig.hub.tell({.phase = RunPhase::kRunning, .recorded = 5}, 0.0, 0.1);
  EXPECT_EQ(statuses(), 0U) << "nothing that could not wait";
  rig.hub.tell({.phase = RunPhase::kPaused, .recorded = 5}, 0.0, 0.12);
  EXPECT_EQ(statuses(), 1U);
  rig.hub.tell({.phase = RunPhase::kPaused, .recorded = 5}, 0.0, 0.5);
  EXPECT_EQ(statuses(), 1U);
}

TEST(Hub, RestartsOnlyIfSomebodyListens) {
  Rig alone(false);
  alone.begin();
  const ViewerId there = alone.hub.came();
  alone.take_control(there);
  EXPECT_NE(alone.refusal(there, "restart 5"), "");
  EXPECT_EQ(alone.hub.take_restart(), std::nullopt);
  Rig rig;
  rig.begin();
  const ViewerId viewer = rig.hub.came();
  rig.take_control(viewer);
  EXPECT_EQ(rig.refusal(viewer, "restart x"), "restart: needs a seed, a whole number");
  EXPECT_EQ(rig.refusal(viewer, "restart -1"), "restart: needs a seed, a whole number");
  EXPECT_EQ(rig.refusal(viewer, "restart 18446744073709551615"), "restarts with seed 18446744073709551615");
  EXPECT_EQ(rig.hub.take_restart(), 18446744073709551615U);
  EXPECT_EQ(rig.hub.take_restart(), std::nullopt) << "once";
}

TEST(Hub, BeginsAnewWithAnotherRun) {
  Rig rig;
  rig.begin();
  const ViewerId viewer = rig.hub.came();
  rig.show(10, 1.0);
  rig.show(11, 2.0);
  static_cast<void>(rig.all(viewer));
  rig.begin();
  const auto messages = rig.all(viewer);
  ASSERT_GE(messages.size(), 2U);
  EXPECT_TRUE(messages[0].has_hello());
  EXPECT_EQ(messages[1].history().samples_size(), 0);
  for (const ToPage& message : messages) EXPECT_FALSE(message.has_picture()) << "of the other run";
  rig.show(1, 3.0);
  const auto pictures = rig.all(viewer, ToPage::kPicture);
  ASSERT_EQ(pictures.size(), 1U);
  EXPECT_TRUE(pictures[0].picture().has_program());
}

TEST(Hub, LetsAViewerGoWhoTakesNothing) {
  Rig rig;
  rig.begin();
  const ViewerId sleeper = rig.hub.came();
  for (int i = 0; i < 600; ++i) {
    rig.show(i, i);
    rig.hub.hear({.kind = Control::Kind::kFence});
  }
  EXPECT_TRUE(rig.hub.too_slow(sleeper));
  rig.hub.gone(sleeper);
  EXPECT_EQ(rig.hub.viewers(), 0U);
  EXPECT_EQ(rig.hub.next(sleeper), nullptr);
}

TEST(Hub, UnderstandsNoNonsense) {
  Rig rig;
  rig.begin();
  const ViewerId viewer = rig.hub.came();
  EXPECT_FALSE(rig.hub.said(viewer, ""));
  EXPECT_FALSE(rig.hub.said(viewer, "pause"));
  EXPECT_FALSE(rig.hub.said(99, FromPage().SerializeAsString()));
  // Random bytes, most of them with the tag of a request before: nothing but a verb of the page gets through to the
  // clock.
  rig.take_control(viewer);
  for (std::uint32_t i = 0; i < 20'000; ++i) {
    std::string bytes;
    const auto draw = [&](std::uint64_t n) { return uniform01({1, Purpose::kTest, i, n}); };
    const auto length = static_cast<std::size_t>(draw(0) * 40.0);
    for (std::size_t n = 0; n < length; ++n) bytes += static_cast<char>(draw(n + 1) * 256.0);
    if (i % 4 != 0)
      bytes =
          std::string("\x12") + static_cast<char>(bytes.size() + 2) + "\x12" + static_cast<char>(bytes.size()) + bytes;
    static_cast<void>(rig.hub.said(viewer, bytes));
    if (i % 64 == 0) static_cast<void>(rig.all(viewer));
    const auto request = rig.hub.take_request();
    EXPECT_EQ(request, std::nullopt) << "no forty random letters begin with a verb";
  }
  EXPECT_EQ(rig.hub.viewers(), 1U);
}

}  // namespace
}  // namespace lukou::console
