#include "services/lukou/replay/player.hpp"

#include <gtest/gtest.h>

namespace lukou::replay {
namespace {

/// A recording of 100 s that has been played to the due step at a time.
Player played_to(double now_s) {
  Player player(1000, 0.0);
  player.reached(now_s, player.due(now_s));
  return player;
}

std::string answer(Player& player, double now_s, const std::string& text) {
  const auto said = player.request(now_s, text);
  return said ? said.value() : "refused: " + said.error().text();
}

TEST(Player, PlaysInRealTimeAtFirst) {
  const Player player(1000, 50.0);
  EXPECT_EQ(player.due(50.0), 0);
  EXPECT_EQ(player.due(51.26), 12);
  EXPECT_EQ(player.due(1e6), 1000) << "and stays at the end";
}

TEST(Player, HoldsWhereItIsPausedAndGoesOnFromThere) {
  Player player = played_to(2.0);
  EXPECT_EQ(answer(player, 2.0, "pause"), "pauses at step 20 (2.0 s)");
  EXPECT_EQ(player.due(9.0), 20);
  EXPECT_EQ(player.state("r").phase, RunPhase::kPaused);
  EXPECT_EQ(answer(player, 10.0, "resume"), "runs");
  EXPECT_EQ(player.due(11.0), 30);
  EXPECT_EQ(player.state("r").phase, RunPhase::kRunning);
}

TEST(Player, PausesAtATimeThatIsAhead) {
  Player player = played_to(1.0);
  EXPECT_EQ(answer(player, 1.0, "pause at 3"), "pauses at step 30 (3.0 s)");
  EXPECT_EQ(player.due(2.0), 20);
  EXPECT_EQ(player.due(50.0), 30);
}

TEST(Player, FollowsThePace) {
  Player player = played_to(1.0);
  EXPECT_EQ(answer(player, 1.0, "pace 10"), "pace 10");
  EXPECT_EQ(player.due(2.0), 110);
  EXPECT_EQ(answer(player, 1.0, "pace max"), "pace max");
  EXPECT_EQ(player.due(1.0), 1000);
  EXPECT_EQ(player.state("r").pace, 0.0);
}

TEST(Player, SeeksForthAndBackAndPlaysOnFromThere) {
  Player player = played_to(1.0);
  EXPECT_EQ(answer(player, 1.0, "seek 60"), "at step 600 (60.0 s)");
  EXPECT_TRUE(player.seeking());
  EXPECT_EQ(player.due(1.0), 600);
  player.reached(1.1, 300);
  EXPECT_TRUE(player.seeking()) << "half the way";
  EXPECT_EQ(player.due(1.1), 600);
  player.reached(1.2, 600);
  EXPECT_FALSE(player.seeking());
  EXPECT_EQ(player.due(2.2), 610);
  EXPECT_EQ(answer(player, 2.2, "seek 10"), "at step 100 (10.0 s)");
  player.reached(2.3, 100);
  EXPECT_EQ(player.due(3.3), 110);
  EXPECT_EQ(answer(player, 3.3, "seek 5000"), "at step 1000 (100.0 s)") << "no further than the end";
}

TEST(Player, StaysPausedWhereItIsSentWhilePaused) {
  Player player = played_to(1.0);
  answer(player, 1.0, "pause");
  answer(player, 1.0, "seek 30");
  player.reached(1.1, 300);
  EXPECT_EQ(player.due(60.0), 300);
  EXPECT_EQ(player.state("r").phase, RunPhase::kPaused);
}

TEST(Player, TakesSingleStepsAtOnce) {
  Player player = played_to(1.0);
  EXPECT_EQ(answer(player, 1.0, "step"), "pauses at step 11 (1.1 s)");
  player.reached(1.0, player.due(1.0));
  EXPECT_EQ(answer(player, 1.0, "step 5"), "pauses at step 16 (1.6 s)");
  player.reached(1.0, player.due(1.0));
  EXPECT_EQ(player.due(9.0), 16);
}

TEST(Player, DoesNotCatchUpWithAPaceThatItCouldNotKeep) {
  Player player = played_to(1.0);
  answer(player, 1.0, "pace 10");
  player.reached(4.0, 100);  // 310 is due
  EXPECT_EQ(player.due(4.0), 100);
  EXPECT_EQ(player.due(4.125), 112);
}

TEST(Player, EndsWhenAViewerStopsIt) {
  Player player = played_to(1.0);
  EXPECT_EQ(answer(player, 1.0, "stop"), "ends at step 10 (1.0 s)");
  EXPECT_TRUE(player.stopped());
  EXPECT_EQ(player.state("r").phase, RunPhase::kEnded);
}

TEST(Player, RefusesWhatARecordingCannotDo) {
  Player player = played_to(1.0);
  EXPECT_EQ(answer(player, 1.0, "set vehicles.equipped_ratio=1"),
            "refused: set: nothing can be changed in a recording");
  EXPECT_EQ(answer(player, 1.0, "seek soon"),
            "refused: seek: `soon` is not a time; use a number of seconds of at least 0");
  EXPECT_EQ(answer(player, 1.0, "seek -1"), "refused: seek: `-1` is not a time; use a number of seconds of at least 0");
  EXPECT_EQ(answer(player, 1.0, "step 0"),
            "refused: step: `0` is not a number of steps; use a whole number of at least 1");
  EXPECT_EQ(answer(player, 1.0, "dance"),
            "refused: dance: is not a request; use pause, resume, step, pace, stop or seek");
}

}  // namespace
}  // namespace lukou::replay
