#include "common/intersection/conflicts.hpp"

#include <gtest/gtest.h>

#include <set>

namespace lukou {
namespace {

Lane lane(const char* name) { return *lane_named(name); }

/// The approach `quarter_turns` counter-clockwise from another: west, south, east, north.
Approach beside(Approach approach, int quarter_turns) {
  return static_cast<Approach>((static_cast<int>(approach) + quarter_turns) % kApproaches);
}

// By drawing the paths (stop lines 15.5 m from the centre, lanes 3.5 m wide):
// - straight on crosses straight on from both sides; from the approach on the right (counter-clockwise) also its left
//   turn crosses, while the left turn from the other side passes 3.5 m away on its way to the neighbouring exit lane;
// - left turns of neighbouring approaches cross; opposed ones pass 9 m apart (circles of 17.25 m, centres 43.8 m);
// - a left turn crosses the straight stream that comes towards it: the driver must yield;
// - a right turn keeps to its corner and has an exit lane of its own.
Conflict expected(Lane a, Lane b) {
  const auto one_way = [](Lane from, Lane other) {
    const bool straight = turn_of(from) == Turn::kCenter;
    const bool left = turn_of(from) == Turn::kLeft;
    const bool next = approach_of(other) == beside(approach_of(from), 1);
    const bool opposed = approach_of(other) == beside(approach_of(from), 2);
    const bool other_straight = turn_of(other) == Turn::kCenter;
    const bool other_left = turn_of(other) == Turn::kLeft;
    if (next && straight && (other_straight || other_left)) return Conflict::kHard;
    if (next && left && other_left) return Conflict::kHard;
    if (opposed && left && other_straight) return Conflict::kPermitted;
    return Conflict::kNone;
  };
  const Conflict forth = one_way(a, b);
  return forth != Conflict::kNone ? forth : one_way(b, a);
}

TEST(Conflict, IsWhatTheDrawingSaysForEveryPairOfLanes) {
  for (int i = 0; i < kLanes; ++i) {
    for (int j = 0; j < kLanes; ++j) {
      const auto a = static_cast<Lane>(i);
      const auto b = static_cast<Lane>(j);
      EXPECT_EQ(conflict(a, b), expected(a, b)) << name(a) << " " << name(b);
      EXPECT_EQ(conflict(a, b), conflict(b, a)) << name(a) << " " << name(b);
    }
  }
}

TEST(Conflict, IsHardBetweenCrossingStreams) {
  EXPECT_EQ(conflict(lane("WC"), lane("SC")), Conflict::kHard);
  EXPECT_EQ(conflict(lane("WC"), lane("NC")), Conflict::kHard);
  EXPECT_EQ(conflict(lane("WL"), lane("NC")), Conflict::kHard);
  EXPECT_EQ(conflict(lane("EL"), lane("NL")), Conflict::kHard);
}

TEST(Conflict, IsPermittedBetweenALeftTurnAndTheStreamThatComesTowardsIt) {
  EXPECT_EQ(conflict(lane("WL"), lane("EC")), Conflict::kPermitted);
  EXPECT_EQ(conflict(lane("SL"), lane("NC")), Conflict::kPermitted);
}

TEST(Conflict, IsNoneForRightTurnsAndWithinAnApproach) {
  for (int i = 0; i < kLanes; ++i) {
    for (const Approach approach : kAllApproaches) {
      EXPECT_EQ(conflict(lane_of(approach, Turn::kRight), static_cast<Lane>(i)), Conflict::kNone);
    }
    for (const Turn turn : {Turn::kLeft, Turn::kCenter, Turn::kRight}) {
      const auto here = static_cast<Lane>(i);
      EXPECT_EQ(conflict(here, lane_of(approach_of(here), turn)), Conflict::kNone);
    }
  }
}

std::set<std::string> pairs(const std::vector<PlanConflict>& conflicts) {
  std::set<std::string> texts;
  for (const PlanConflict& found : conflicts) texts.insert(std::string(name(found.a)) + std::string(name(found.b)));
  return texts;
}

TEST(ConflictsOfAPlan, AreOnlyThePermittedOnesOfThePaper) {
  // Both directions of an axis are green together: its two left turns meet the two straight streams.
  for (const SignalPlan& plan : {paper_plan(), paper_yellow_plan()}) {
    const auto found = conflicts_of(plan);
    EXPECT_EQ(pairs(found), (std::set<std::string>{"WLEC", "WCEL", "SLNC", "SCNL"}));
    for (const PlanConflict& pair : found) EXPECT_EQ(pair.kind, Conflict::kPermitted) << text(pair);
  }
  const auto found = conflicts_of(paper_plan());
  EXPECT_EQ(text(found.front()), "WL and EC at 0.0 s");
  EXPECT_EQ(found.back().at, 450) << "the second axis turns green after 45 s";
}

TEST(ConflictsOfAPlan, AreNoneIfLeftTurnsAreProtected) { EXPECT_TRUE(conflicts_of(protected_left_plan()).empty()); }

TEST(ConflictsOfAPlan, BeginWithTheFirstStepOfTheOverlapAndCountYellow) {
  // WC is green until 42 s and yellow until 45 s of the cycle, which starts at 5 s; SC turns green at 44 s already.
  SignalPlan plan = paper_plan();
  plan.offset = 50;
  plan.lanes[index(lane("WC"))] = {{Aspect::kGreen, 420}, {Aspect::kYellow, 30}, {Aspect::kRed, 450}};
  plan.lanes[index(lane("SC"))] = {{Aspect::kRed, 440}, {Aspect::kGreen, 460}};
  std::vector<PlanConflict> hard;
  for (const PlanConflict& found : conflicts_of(plan)) {
    if (found.kind == Conflict::kHard) hard.push_back(found);
  }
  // EC and EL are green until 45 s: SC meets WC, EC and EL.
  ASSERT_FALSE(hard.empty());
  EXPECT_EQ(pairs(hard), (std::set<std::string>{"WCSC", "SCEC", "SCEL"}));
  EXPECT_EQ(text(hard.front()), "WC and SC at 49.0 s") << "44 s after the cycle's start at 5 s";
}

TEST(ConflictsOfHeads, AreTheHardOnesThatShowGreenOrYellowTogether) {
  Heads heads;
  heads.fill(Aspect::kRed);
  EXPECT_TRUE(conflicts_of(heads, 7).empty());
  heads[index(lane("WC"))] = Aspect::kGreen;
  heads[index(lane("EL"))] = Aspect::kGreen;  // permitted: no matter for a monitor
  EXPECT_TRUE(conflicts_of(heads, 7).empty());
  heads[index(lane("SC"))] = Aspect::kYellow;
  const auto found = conflicts_of(heads, 7);
  EXPECT_EQ(pairs(found), (std::set<std::string>{"WCSC", "SCEL"}));
  EXPECT_EQ(found.front().at, 7);
}

TEST(HardConflicts, AreTheCrossingStreams) {
  // West straight on crosses both straight streams of the other axis and the left from the south; that from the north
  // turns into an exit lane beside its own.
  const LaneSet crossing = hard_conflicts(*lane_named("WC"));
  for (const char* lane : {"SC", "NC", "SL"}) EXPECT_TRUE(crossing.contains(*lane_named(lane))) << lane;
  for (const char* lane : {"WL", "WR", "EC", "ER", "EL", "NL"})
    EXPECT_FALSE(crossing.contains(*lane_named(lane))) << lane;
}

TEST(HardConflicts, OfASetAreThoseOfItsLanes) {
  const Lane wc = *lane_named("WC");
  const Lane sl = *lane_named("SL");
  EXPECT_EQ(hard_conflicts(LaneSet{wc, sl}), hard_conflicts(wc) | hard_conflicts(sl));
  EXPECT_TRUE(has_hard_conflict({wc, sl}));
  EXPECT_FALSE(has_hard_conflict({wc, *lane_named("EL")})) << "opposed left: permitted";
  EXPECT_FALSE(has_hard_conflict({}));
  EXPECT_TRUE(has_hard_conflict(kAllLanes));
}

}  // namespace
}  // namespace lukou
