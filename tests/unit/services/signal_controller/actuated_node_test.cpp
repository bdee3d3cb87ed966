#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "common/intersection/signal_promise.hpp"
#include "services/signal_controller/signal_controller_node.hpp"

namespace lukou {
namespace {

constexpr Step kPromise = 10;

Lane lane(const char* name) { return *lane_named(name); }

/// A controller that hears requests, with all that it has published.
class Rig {
 public:
  explicit Rig(const SignalPlan& plan, const Actuation& actuation = {}) : node_(plan, kPromise, actuation) {}

  /// Goes on through step `last`.
  void run(Step last) {
    for (; next_ <= last; ++next_) {
      if (!node_.step(next_, batch_)) continue;
      ASSERT_TRUE(promise_.extend(batch_.first, batch_.heads)) << next_;
      for (std::size_t i = 0; i < batch_.request_outcome.size(); ++i) {
        news_.push_back(std::to_string(batch_.request_step[i]) + " rsu" + std::to_string(batch_.request_rsu[i]) + " " +
                        std::to_string(batch_.request_outcome[i]));
      }
    }
  }
  /// A request of an RSU's step `asked`, before run(asked + 1).
  void ask(Step asked, LaneSet green, Step lifetime, std::uint32_t rsu = 0) {
    run(asked);
    RequestBatch request{.rsu = rsu, .step = asked, .lanes = {green.bits()}, .lifetime = {lifetime}};
    node_.hear(asked + 1, request);
  }
  [[nodiscard]] Aspect shown(const char* name, Step step) const { return promise_.at(step)[index(lane(name))]; }
  SignalControllerNode& node() { return node_; }
  [[nodiscard]] const SignalBatch& batch() const { return batch_; }
  [[nodiscard]] const std::vector<std::string>& news() const { return news_; }

 private:
  SignalControllerNode node_;
  Step next_ = 0;
  SignalBatch batch_;
  SignalPromise promise_;
  std::vector<std::string> news_;
};

TEST(ActuatedNode, FollowsThePlanWithItsClearances) {
  Rig rig(paper_plan());
  rig.run(1400);
  // 45 s each: green until the plan changes, 3 s yellow, 1 s all-red; from then on 41 s of green.
  struct Change {
    const char* lane;
    Step at;
    Aspect to;
  };
  for (const Change& change :
       {Change{"WC", 450, Aspect::kYellow}, Change{"WC", 480, Aspect::kRed}, Change{"SC", 490, Aspect::kGreen},
        Change{"SC", 900, Aspect::kYellow}, Change{"SC", 930, Aspect::kRed}, Change{"WC", 940, Aspect::kGreen},
        Change{"WC", 1350, Aspect::kYellow}}) {
    EXPECT_EQ(rig.shown(change.lane, change.at), change.to) << change.at;
    EXPECT_NE(rig.shown(change.lane, change.at - 1), change.to) << change.at;
  }
}

TEST(ActuatedNode, ActsOnARequestOnePromiseAfterItHearsIt) {
  Rig rig(paper_plan());
  // Asked in step 200, heard in step 201, in force for the heads of 211 ... 230; then the plan again.
  rig.ask(200, {lane("SC"), lane("NC")}, 20);
  rig.run(400);
  EXPECT_EQ(rig.shown("WC", 210), Aspect::kGreen);
  EXPECT_EQ(rig.shown("WC", 211), Aspect::kYellow);
  EXPECT_EQ(rig.shown("WC", 241), Aspect::kRed);
  EXPECT_EQ(rig.shown("SC", 251), Aspect::kRed) << "the request has ended: it was too short for the clearance";
  EXPECT_EQ(rig.shown("WC", 251), Aspect::kGreen) << "after its own all-red";
  EXPECT_EQ(rig.news(), (std::vector<std::string>{"201 rsu0 0", "221 rsu0 6"}));
}

TEST(ActuatedNode, KeepsARequestedGreenAgainstThePlan) {
  Rig rig(paper_plan());
  rig.ask(300, {lane("WC")}, 600);
  rig.run(900);
  for (const Step step : {400, 451, 899, 910}) EXPECT_EQ(rig.shown("WC", step), Aspect::kGreen) << step;
  EXPECT_EQ(rig.shown("SC", 899), Aspect::kRed);
}

TEST(ActuatedNode, TellsOfChangesThatAreCertainAlone) {
  Rig rig(paper_plan());
  rig.run(0);
  EXPECT_TRUE(rig.batch().change_step.empty()) << "which request comes, and when, nobody knows";
  // The batch of step 440 decides the heads through 450, the first yellow.
  rig.run(440);
  std::vector<std::string> changes;
  for (std::size_t i = 0; i < rig.batch().change_step.size(); ++i) {
    if (rig.batch().change_lane[i] != index(lane("WC"))) continue;
    changes.push_back(std::to_string(rig.batch().change_step[i]) + " " + std::to_string(rig.batch().change_aspect[i]));
  }
  EXPECT_EQ(changes, (std::vector<std::string>{"450 2", "480 1"}));
}

TEST(ActuatedNode, RefusesAndGoesOn) {
  Rig rig(paper_plan());
  rig.ask(20, {lane("WC"), lane("SC")}, 50);
  rig.ask(21, {}, 50);
  rig.ask(22, {lane("SC")}, 50, 1);
  rig.ask(23, {lane("WC")}, 50, 2);
  rig.run(30);
  EXPECT_EQ(rig.news(), (std::vector<std::string>{"21 rsu0 3", "22 rsu0 4", "23 rsu1 1", "24 rsu2 5"}))
      << "the third is followed, but the green of the west is younger than 8 s when it would end";
}

TEST(ActuatedNode, HearsTheLastOfSeveralRequests) {
  Rig rig(paper_plan());
  rig.run(100);
  const RequestBatch two{
      .rsu = 0, .step = 100, .lanes = {LaneSet{lane("SC")}.bits(), LaneSet{lane("WC")}.bits()}, .lifetime = {50, 50}};
  rig.node().hear(101, two);
  rig.run(140);
  EXPECT_EQ(rig.shown("WC", 112), Aspect::kGreen);
  EXPECT_EQ(rig.news(), (std::vector<std::string>{"101 rsu0 0"}));
}

TEST(ActuatedNode, TakesANewPlanForTheTimesWithoutARequest) {
  Rig rig(paper_plan());
  rig.run(99);
  rig.node().use_plan(protected_left_plan(), 100);
  rig.run(1200);
  // From the start of the next cycle, 900: W/E straight on for 18 s; the left lanes have to wait for theirs.
  EXPECT_EQ(rig.shown("WC", 1000), Aspect::kGreen);
  EXPECT_EQ(rig.shown("WL", 1000), Aspect::kRed);
}

}  // namespace
}  // namespace lukou
