#include "common/process/fellows.hpp"

#include <gtest/gtest.h>

namespace lukou::process {
namespace {

using bus::Belief;

const Fellows::Roster kRoster = {{10, "traffic-engine"}, {11, "signal-controller"}, {12, "recorder"}, {20, "rsu0"}};

TEST(Fellows, AreBelievedOnTheTopicsOfTheirRolesAlone) {
  Fellows fellows;
  fellows.take(kRoster);
  EXPECT_EQ(fellows.belief(Topic::kAir, 10), Belief::kYes);
  EXPECT_EQ(fellows.belief(Topic::kRoadside, 20), Belief::kYes);
  EXPECT_EQ(fellows.belief(Topic::kAir, 20), Belief::kForeign) << "an RSU is no engine";
  EXPECT_EQ(fellows.belief(Topic::kSignal, 20), Belief::kForeign) << "nor a controller";
  EXPECT_EQ(fellows.belief(Topic::kAir, 99), Belief::kForeign) << "a stranger";
  EXPECT_EQ(fellows.role_of(20), "rsu0");
  EXPECT_EQ(fellows.role_of(99), "");
}

TEST(Fellows, AreNobodyBeforeTheRosterHasCome) {
  const Fellows fellows;
  EXPECT_EQ(fellows.belief(Topic::kAir, 10), Belief::kIgnored)
      << "what is said before one takes part is nobody's fault";
}

TEST(Fellows, ThatAreFencedAreIgnoredAndNoStrangers) {
  Fellows fellows;
  fellows.take(kRoster);
  fellows.fence("rsu0");
  EXPECT_EQ(fellows.belief(Topic::kRoadside, 20), Belief::kIgnored);
  EXPECT_EQ(fellows.role_of(20), "") << "its role is vacant";
  auto with_another = kRoster;
  with_another.erase(20);
  with_another[21] = "rsu0";
  fellows.take(with_another);
  EXPECT_EQ(fellows.belief(Topic::kRoadside, 21), Belief::kYes);
  EXPECT_EQ(fellows.belief(Topic::kRoadside, 20), Belief::kIgnored) << "a zombie";
}

TEST(Fellows, ThatANewRosterDoesNotNameAreIgnored) {
  Fellows fellows;
  fellows.take(kRoster);
  auto without = kRoster;
  without.erase(20);
  fellows.take(without);
  EXPECT_EQ(fellows.belief(Topic::kRoadside, 20), Belief::kIgnored);
}

TEST(Fellows, ThatAreDistrustedAreNotHeardAgain) {
  Fellows fellows;
  fellows.take(kRoster);
  EXPECT_TRUE(fellows.distrust(20));
  EXPECT_FALSE(fellows.distrust(20)) << "the clock is told once";
  EXPECT_EQ(fellows.belief(Topic::kRoadside, 20), Belief::kIgnored);
  EXPECT_EQ(fellows.role_of(20), "rsu0") << "it still has its role, and is the culprit by it";
}

}  // namespace
}  // namespace lukou::process
