#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "console.pb.h"
#include "tests/unit/services/console/hub_rig.hpp"

namespace lukou::console {
namespace {

constexpr Step kLast = 9000;
const std::vector<Directive> kChanges = {{200, "traffic.west.flow_veh_per_h=900"},
                                         {3000, "signals.preset=PAPER_YELLOW"},
                                         {5000, "traffic.west.flow_veh_per_h=300"}};

/// A recording as it is replayed on the bus: a view after the other, and a seek that sets it on at another step.
struct Replay : Rig {
  Replay() {
    begin(kChanges, kLast);
    viewer = hub.came();
    take_control(viewer);
  }
  void play(Step steps) {
    for (Step i = 0; i < steps; ++i) {
      show(step++, now_s += 0.3);
      draw(viewer);
      for (ToPage& message : all(viewer)) heard.push_back(std::move(message));
    }
  }
  /// As the page asks and as a replay answers; the views that are under way come after the answer.
  void seek(const std::string& seconds, Step to) {
    ask(viewer, "seek " + seconds);
    EXPECT_EQ(hub.take_request(), "seek " + seconds);
    hub.answered(true, "at step " + std::to_string(to) + " (" + seconds + " s)");
    play(1);
    step = to;
  }
  [[nodiscard]] History past() {
    const ViewerId late = hub.came();
    for (const ToPage& message : all(late)) {
      if (message.has_history()) return message.history();
    }
    return {};
  }

  ViewerId viewer = 0;
  Step step = 0;
  double now_s = 0.0;
  std::vector<ToPage> heard;
};

TEST(HubOfARecording, SaysSoWithItsLastStepAndAllItsChanges) {
  Replay replay;
  const auto messages = replay.all(replay.viewer);
  ASSERT_GE(messages.size(), 2U);
  EXPECT_EQ(messages[0].hello().recorded_to(), kLast);
  EXPECT_FALSE(messages[0].hello().may_restart()) << "though somebody listens";
  ASSERT_EQ(messages[1].history().events_size(), 3);
  EXPECT_EQ(messages[1].history().events(1).step(), 3000);
  Rig run;
  run.begin();
  EXPECT_FALSE(run.all(run.hub.came())[0].hello().has_recorded_to());
}

TEST(HubOfARecording, TellsTheValueThatEachFieldBeganWith) {
  Replay replay;
  const Hello hello = replay.all(replay.viewer)[0].hello();
  for (const LiveField& field : hello.live()) {
    if (field.path() != "traffic.west.flow_veh_per_h") continue;
    EXPECT_EQ(field.initial(), "1800");
    EXPECT_EQ(field.value(), "300");
    return;
  }
  FAIL() << "no such field";
}

TEST(HubOfARecording, PassesASeekOnAndRefusesChanges) {
  Replay replay;
  EXPECT_EQ(replay.refusal(replay.viewer, "seek 300"), "");
  EXPECT_EQ(replay.hub.take_request(), "seek 300");
  replay.hub.answered(true, "at step 3000 (300.0 s)");
  EXPECT_EQ(replay.refusal(replay.viewer, "set traffic.west.flow_veh_per_h=1"),
            "nothing can be changed in a recording");
  EXPECT_EQ(replay.refusal(replay.viewer, "restart 5"), "nothing can be changed in a recording");
  EXPECT_EQ(replay.hub.take_restart(), std::nullopt);
  EXPECT_EQ(replay.refusal(replay.viewer, "vanish"),
            "`vanish` is not a request; use pause, resume, step, pace, stop or seek");
  Rig run;
  run.begin();
  const ViewerId viewer = run.hub.came();
  run.take_control(viewer);
  EXPECT_EQ(run.refusal(viewer, "seek 300"),
            "`seek` is not a request; use pause, resume, step, pace, stop, set or restart");
}

TEST(HubOfARecording, GoesBack) {
  Replay replay;
  replay.play(100);
  replay.seek("2", 20);
  replay.heard.clear();
  replay.play(1);
  // The picture and the figures of the place that was sought, at once.
  bool pictured = false;
  bool counted = false;
  for (const ToPage& message : replay.heard) {
    if (message.has_picture()) pictured = message.picture().step() == 20;
    if (message.has_statistics()) counted = message.statistics().step() == 20 && message.statistics().seeks() == 1;
  }
  EXPECT_TRUE(pictured);
  EXPECT_TRUE(counted);
}

TEST(HubOfARecording, ForgetsWhatLiesBeyondThePlaceItWentBackTo) {
  Replay replay;
  replay.play(100);
  EXPECT_EQ(replay.past().samples_size(), 100);
  replay.seek("2", 20);
  replay.play(10);
  const History past = replay.past();
  ASSERT_EQ(past.samples_size(), 30);
  for (int i = 0; i < past.samples_size(); ++i) {
    EXPECT_EQ(past.samples(i).step(), i);
    EXPECT_EQ(past.samples(i).seeks(), i < 20 ? 0U : 1U);
  }
  EXPECT_EQ(past.events_size() - 1, 3) << "its changes are known before and after; the other word is of the control";
}

TEST(HubOfARecording, JoinsNothingAcrossALeapForward) {
  Replay replay;
  replay.play(10);
  replay.seek("500", 5000);  // one view of the old place is still under way
  replay.play(10);
  const History past = replay.past();
  ASSERT_EQ(past.samples_size(), 21);
  EXPECT_EQ(past.samples(10).step(), 10);
  EXPECT_EQ(past.samples(10).seeks(), 0U);
  EXPECT_EQ(past.samples(11).step(), 5000);
  EXPECT_EQ(past.samples(11).seeks(), 1U);
}

TEST(HubOfARecording, MeasuresNoPaceAcrossALeap) {
  Replay replay;
  replay.play(20);
  replay.seek("500", 5000);
  replay.play(2);
  for (const ToPage& message : replay.heard) {
    if (!message.has_statistics()) continue;
    EXPECT_LT(message.statistics().pace_achieved(), 1.0) << "0.1 s every 0.3 s";
  }
}

TEST(HubOfARecording, ShowsTheProgramOfEachStepInAnyOrder) {
  Replay replay;
  const auto cycle_has_yellow = [&](Step at) {
    replay.heard.clear();
    replay.step = at;
    replay.play(1);
    for (const ToPage& message : replay.heard) {
      if (message.has_picture() && message.picture().has_program()) {
        return message.picture().program().lanes(0).aspect_size() == 3;
      }
    }
    ADD_FAILURE() << "no program at " << at;
    return false;
  };
  EXPECT_FALSE(cycle_has_yellow(100));
  // Set in step 3000, promised 10 steps ahead: from the cycle that starts at 3600.
  EXPECT_TRUE(cycle_has_yellow(3600));
  EXPECT_FALSE(cycle_has_yellow(3599)) << "back again";
  EXPECT_TRUE(cycle_has_yellow(8000));
}

}  // namespace
}  // namespace lukou::console
