#include "services/lukou/redrive/comparison.hpp"

#include <gtest/gtest.h>

#include "common/messages/rsc.hpp"
#include "common/messages/spat.hpp"

namespace lukou::redrive {
namespace {

VehicleCoordination to_car(std::uint64_t car, double acceleration_mps2) {
  VehicleCoordination asked;
  asked.vehicle = car;
  asked.path = GuidedPath{{}, acceleration_mps2, 500};
  return asked;
}

/// An answer of one RSC; `count` numbers the message.
Answer answer(std::vector<VehicleCoordination> cars, std::uint8_t count = 0) {
  Answer answer;
  append(answer.frames, {.sender = 9, .sequence = count},
         Coordination{.rsu = 9, .count = count, .vehicles = std::move(cars)});
  return answer;
}

TapeStep recorded(Step step, Answer said) {
  TapeStep tape;
  tape.step = step;
  tape.cars = {{101, 4}, {102, 8}};
  tape.answers = {std::move(said)};
  return tape;
}

class RedriveComparison : public testing::Test {
 protected:
  std::vector<Difference> told;
  Comparison comparison{[this](const Difference& difference) { told.push_back(difference); }};
};

TEST_F(RedriveComparison, FindsEqualAnswersEqual) {
  comparison.add(recorded(3, answer({to_car(101, -0.5)})), 0, answer({to_car(101, -0.5)}));
  EXPECT_TRUE(comparison.same());
  EXPECT_EQ(comparison.steps(), 1U);
  EXPECT_EQ(comparison.words().at(Topic::Kind::kAdvice).same, 1U);
}

TEST_F(RedriveComparison, DoesNotMindHowMessagesAreNumbered) {
  comparison.add(recorded(3, answer({to_car(101, -0.5)}, 7)), 0, answer({to_car(101, -0.5)}, 8));
  EXPECT_TRUE(comparison.same());
  EXPECT_EQ(comparison.steps_differing(), 0U);
}

TEST_F(RedriveComparison, NamesStepAndCarOfWhatIsSaidOtherwiseAddedOrLeftOut) {
  comparison.add(recorded(3, answer({to_car(101, -0.5)})), 0, answer({to_car(101, -0.5)}));
  comparison.add(recorded(4, answer({to_car(101, -0.5), to_car(102, 0.25)})), 0,
                 answer({to_car(102, 0.26), to_car(103, 1.0)}));
  ASSERT_EQ(told.size(), 3U);
  EXPECT_EQ(comparison.steps_differing(), 1U);
  EXPECT_EQ(told[0].vehicle, 4U);
  EXPECT_EQ(told[0].recorded, "-0.50 m/s2 for 500 ms GUARD");
  EXPECT_EQ(told[0].now, "");
  EXPECT_EQ(told[1].vehicle, 8U);
  EXPECT_EQ(told[1].now, "0.26 m/s2 for 500 ms GUARD");
  EXPECT_EQ(told[2].vehicle, std::nullopt) << "nobody spoke with this id";
  EXPECT_EQ(comparison.first()->step, 4);
  const WordCounts& advice = comparison.words().at(Topic::Kind::kAdvice);
  EXPECT_EQ(advice.same, 1U);
  EXPECT_EQ(advice.missing, 1U);
  EXPECT_EQ(advice.changed, 1U);
  EXPECT_EQ(advice.added, 1U);
}

TEST_F(RedriveComparison, ComparesTheOtherMessagesAndRequestsToo) {
  Spat spat;
  for (auto& lane : spat.lanes) lane = {{Aspect::kRed, 0, 5}};
  Answer before;
  append(before.frames, {}, spat);
  before.request_lanes = {0b11};
  before.request_lifetime = {50};
  spat.lanes[2] = {{Aspect::kGreen, 0, 5}};
  Answer now;
  append(now.frames, {}, spat);
  comparison.add(recorded(3, before), 0, now);
  ASSERT_EQ(told.size(), 2U);
  EXPECT_EQ(told[0].topic.kind, Topic::Kind::kRequest);
  EXPECT_EQ(told[0].recorded, "green for WL WC for 50 steps");
  EXPECT_EQ(told[1].topic.kind, Topic::Kind::kSpat);
}

TEST_F(RedriveComparison, StopsWhereTheRecordLostTheRsu) {
  TapeStep silent = recorded(5, {});
  silent.answers = {std::nullopt};
  comparison.add(recorded(4, answer({})), 0, answer({}));
  comparison.add(silent, 0, answer({to_car(101, 1.0)}));
  comparison.add(recorded(6, answer({})), 0, answer({to_car(101, 1.0)}));
  EXPECT_TRUE(comparison.same());
  EXPECT_EQ(comparison.steps(), 1U);
  EXPECT_EQ(comparison.lost().at(0), 5);
}

}  // namespace
}  // namespace lukou::redrive
