#include "services/signal_controller/model/request_desk.hpp"

#include <gtest/gtest.h>

namespace lukou {
namespace {

Lane lane(const char* name) { return *lane_named(name); }
const LaneSet kWest{lane("WL"), lane("WC")};
const LaneSet kSouth{lane("SC")};

GreenRequest request(LaneSet lanes, Step asked, Step lifetime, std::uint32_t rsu = 0) {
  return {.rsu = rsu, .asked = asked, .lanes = lanes.bits(), .lifetime = lifetime};
}

TEST(RequestDesk, HoldsARequestForItsLifetime) {
  RequestDesk desk;
  EXPECT_FALSE(desk.wanted(4));
  desk.take(request(kWest, 4, 3), 5);
  for (Step k = 5; k <= 7; ++k) EXPECT_EQ(desk.wanted(k), kWest) << k;
  EXPECT_FALSE(desk.wanted(8));
  ASSERT_EQ(desk.news().size(), 1U);
  EXPECT_EQ(desk.news()[0].step, 8);
  EXPECT_EQ(desk.news()[0].outcome, RequestOutcome::kEnded);
}

TEST(RequestDesk, LetsANewerRequestTakeThePlace) {
  RequestDesk desk;
  desk.take(request(kWest, 4, 100), 5);
  desk.take(request(kSouth, 5, 1), 6);
  EXPECT_EQ(desk.wanted(6), kSouth);
  EXPECT_FALSE(desk.wanted(7)) << "the earlier one does not come back";
}

struct Bad {
  const char* why;
  GreenRequest request;
  RequestOutcome outcome;
};

TEST(RequestDesk, RefusesWholeWhatCannotBe) {
  const Bad bad[] = {
      {"crossing", request(kWest | kSouth, 6, 5), RequestOutcome::kConflict},
      {"no lane", request({}, 6, 5), RequestOutcome::kMalformed},
      {"a thirteenth lane", {.rsu = 0, .asked = 6, .lanes = 0x1001, .lifetime = 5}, RequestOutcome::kMalformed},
      {"no lifetime", request(kSouth, 6, 0), RequestOutcome::kMalformed},
      {"a negative lifetime", request(kSouth, 6, -1), RequestOutcome::kMalformed},
      {"more than an hour", request(kSouth, 6, 36'001), RequestOutcome::kMalformed},
  };
  for (const Bad& example : bad) {
    RequestDesk desk;
    desk.take(request(kWest, 4, 100), 5);
    desk.take(example.request, 7);
    ASSERT_EQ(desk.news().size(), 1U) << example.why;
    EXPECT_EQ(desk.news()[0].outcome, example.outcome) << example.why;
    EXPECT_EQ(desk.news()[0].step, 7) << example.why;
    EXPECT_EQ(desk.wanted(7), kWest) << "what was in force stays: " << example.why;
  }
}

TEST(RequestDesk, PrefersTheRsuWithTheLowerIndex) {
  RequestDesk desk;
  desk.take(request(kWest, 4, 3, 1), 5);
  desk.take(request(kSouth, 4, 3, 2), 5);
  EXPECT_EQ(desk.wanted(5), kWest);
  ASSERT_EQ(desk.news().size(), 1U);
  EXPECT_EQ(desk.news()[0].request.rsu, 2U);
  EXPECT_EQ(desk.news()[0].outcome, RequestOutcome::kOtherRsu);
  // Once the other's has ended, it may.
  desk.clear_news();
  desk.take(request(kSouth, 7, 3, 2), 8);
  EXPECT_EQ(desk.wanted(8), kSouth);
  // A lower one takes over; the other's is given up.
  desk.clear_news();
  desk.take(request(kWest, 8, 3, 0), 9);
  EXPECT_EQ(desk.wanted(9), kWest);
  ASSERT_EQ(desk.news().size(), 1U);
  EXPECT_EQ(desk.news()[0].request.rsu, 2U);
  EXPECT_EQ(desk.news()[0].outcome, RequestOutcome::kOtherRsu);
}

TEST(RequestDesk, TellsEachChangeOfTheOutcomeOnce) {
  RequestDesk desk;
  desk.tell(1, RequestOutcome::kAccepted);
  EXPECT_TRUE(desk.news().empty()) << "nothing is in force: the plan";
  desk.take(request(kWest, 4, 100), 5);
  desk.tell(5, RequestOutcome::kMinGreen);
  desk.tell(6, RequestOutcome::kMinGreen);
  desk.tell(7, RequestOutcome::kAccepted);
  desk.take(request(kWest, 7, 100), 8);
  desk.tell(8, RequestOutcome::kAccepted);
  ASSERT_EQ(desk.news().size(), 3U);
  EXPECT_EQ(desk.news()[0].outcome, RequestOutcome::kMinGreen);
  EXPECT_EQ(desk.news()[1].step, 7);
  EXPECT_EQ(desk.news()[1].request.asked, 4);
  EXPECT_EQ(desk.news()[2].request.asked, 7) << "a new request, though it asks for the same";
}

}  // namespace
}  // namespace lukou
