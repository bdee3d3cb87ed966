#include "services/signal_controller/model/actuated_heads.hpp"

#include <gtest/gtest.h>

#include <map>
#include <string>
#include <vector>

namespace lukou {
namespace {

constexpr Actuation kRules{.min_green = 5, .yellow = 3, .all_red = 2, .max_wait = 100};

Lane lane(const char* name) { return *lane_named(name); }

LaneSet lanes(const std::vector<const char*>& names) {
  LaneSet set;
  for (const char* name : names) set.insert(lane(name));
  return set;
}

const LaneSet kWestEast = lanes({"WL", "WC", "WR", "EL", "EC", "ER"});

/// Heads that are wanted step after step, and what each lane showed: 'r', 'y', 'g'.
class Road {
 public:
  explicit Road(const Actuation& rules = kRules) : heads_(rules) {}

  /// Wants the lanes for the steps up to `last`.
  void want(LaneSet wanted, Step last) {
    for (; next_ <= last; ++next_) {
      outcomes_.push_back(heads_.decide(next_, wanted));
      for (const Lane each : kAllLanes) {
        const Aspect aspect = heads_.heads()[index(each)];
        shown_[each] += aspect == Aspect::kRed ? 'r' : aspect == Aspect::kYellow ? 'y' : 'g';
      }
    }
  }
  [[nodiscard]] const std::string& shown(const char* name) { return shown_[lane(name)]; }
  [[nodiscard]] RequestOutcome outcome(Step at) const { return outcomes_[static_cast<std::size_t>(at)]; }
  [[nodiscard]] const ActuatedHeads& heads() const { return heads_; }

 private:
  ActuatedHeads heads_;
  Step next_ = 0;
  std::map<Lane, std::string> shown_;
  std::vector<RequestOutcome> outcomes_;
};

TEST(ActuatedHeads, BeginWithWhatIsWanted) {
  Road road;
  road.want(lanes({"WC", "EL"}), 0);
  EXPECT_EQ(road.shown("WC"), "g");
  EXPECT_EQ(road.shown("EL"), "g") << "an opposed left is permitted";
  EXPECT_EQ(road.shown("SC"), "r");
}

TEST(ActuatedHeads, ClearTheJunctionBetweenCrossingGreens) {
  Road road;
  road.want(lanes({"WC"}), 7);
  road.want(lanes({"SC"}), 14);
  // Yellow with step 8 for three steps, red with step 11, two steps of red, green with step 13.
  EXPECT_EQ(road.shown("WC"), "ggggggggyyyrrrr");
  EXPECT_EQ(road.shown("SC"), "rrrrrrrrrrrrrgg");
  EXPECT_EQ(road.outcome(8), RequestOutcome::kAccepted);
}

TEST(ActuatedHeads, PutOffTheEndOfAYoungGreen) {
  Road road;
  road.want(lanes({"WC"}), 1);
  road.want(lanes({"SC"}), 11);
  EXPECT_EQ(road.shown("WC"), "gggggyyyrrrr");
  EXPECT_EQ(road.shown("SC"), "rrrrrrrrrrgg");
  for (Step at = 2; at < 5; ++at) EXPECT_EQ(road.outcome(at), RequestOutcome::kMinGreen) << at;
  EXPECT_EQ(road.outcome(5), RequestOutcome::kAccepted);
}

TEST(ActuatedHeads, OpenALaneThatCrossesNothingAtOnce) {
  Road road;
  road.want(lanes({"WC"}), 3);
  road.want(lanes({"WC", "EC"}), 5);
  EXPECT_EQ(road.shown("EC"), "rrrrgg");
  EXPECT_EQ(road.shown("WC"), "gggggg") << "what stays wanted stays green";
}

TEST(ActuatedHeads, DoNotTurnAYellowBack) {
  Road road;
  road.want(lanes({"WC"}), 5);
  road.want(lanes({"SC"}), 6);
  road.want(lanes({"WC"}), 12);
  // Yellow with step 6; red with step 9, for the all-red, though it is wanted again.
  EXPECT_EQ(road.shown("WC"), "ggggggyyyrrgg");
  EXPECT_EQ(road.shown("SC"), "rrrrrrrrrrrrr");
}

TEST(ActuatedHeads, ShowOneStepOfRedWithoutAnAllRed) {
  Road road({.min_green = 2, .yellow = 1, .all_red = 0, .max_wait = 100});
  road.want(lanes({"WC"}), 1);
  road.want(lanes({"SC"}), 2);
  road.want(lanes({"WC"}), 4);
  EXPECT_EQ(road.shown("WC"), "ggyrg");
}

TEST(ActuatedHeads, OpenCrossingLanesWithTheRedIfThereIsNoAllRed) {
  Road road({.min_green = 2, .yellow = 1, .all_red = 0, .max_wait = 100});
  road.want(lanes({"WC"}), 1);
  road.want(lanes({"SC"}), 3);
  EXPECT_EQ(road.shown("WC"), "ggyr");
  EXPECT_EQ(road.shown("SC"), "rrrg");
}

TEST(ActuatedHeads, ServeLanesThatWaitTooLongForTheirMinimumGreen) {
  Road road;
  road.want(kWestEast, 120);
  // Red since two steps before step 0, so for 100 steps with step 98: west yields, yellow 98 ... 100, red with 101,
  // south green 103 ... 107; then it yields, yellow 108 ... 110, red with 111, west green with 113.
  const std::string& south = road.shown("SC");
  const std::string& west = road.shown("WC");
  EXPECT_EQ(south, std::string(103, 'r') + "gggggyyy" + std::string(10, 'r'));
  EXPECT_EQ(west, std::string(98, 'g') + "yyy" + std::string(12, 'r') + std::string(8, 'g'));
  EXPECT_EQ(road.outcome(97), RequestOutcome::kAccepted);
  for (Step at = 98; at < 108; ++at) EXPECT_EQ(road.outcome(at), RequestOutcome::kMaxWait) << at;
  EXPECT_EQ(road.outcome(108), RequestOutcome::kAccepted);
}

TEST(ActuatedHeads, KeepTheWantedGreensThatDoNotCrossTheOnesThatWaitTooLong) {
  Road road;
  road.want(kWestEast, 110);
  EXPECT_EQ(road.shown("WR"), std::string(111, 'g')) << "a right turn into a lane of its own crosses nothing";
}

TEST(ActuatedHeads, ServeOfLanesThatWaitEquallyLongTheFirstFirst) {
  Road road;
  road.want(lanes({"WR"}), 110);
  // With step 98 all others are overdue. West and east go at once, for five steps; then south and north, after yellow
  // (103 ... 105) and all-red, with step 108.
  EXPECT_EQ(road.shown("WC").substr(96, 9), "rrgggggyy");
  EXPECT_EQ(road.shown("SC").substr(96), "rrrrrrrrrrrrggg");
}

TEST(ActuatedHeads, SayWhenAYellowEnds) {
  Road road;
  road.want(lanes({"WC"}), 6);
  EXPECT_EQ(road.heads().yellow_end(lane("WC")), -1);
  road.want(lanes({"SC"}), 8);
  EXPECT_EQ(road.heads().yellow_end(lane("WC")), 10);
  EXPECT_EQ(road.heads().yellow_end(lane("SC")), -1);
}

}  // namespace
}  // namespace lukou
