#include "common/lockstep/roster.hpp"

#include <gtest/gtest.h>

#include <array>

#include "common/lockstep/messages.hpp"

namespace lukou {
namespace {

constexpr std::array<std::string_view, 7> kRoles = {kClockRole,    kEngineRole, kControllerRole, kRecorderRole,
                                                    kObserverRole, "rsu0",      "rsu12"};

/// The roles for which a question is answered with yes, as one text.
template <class Question>
std::string who(Question question, Topic topic) {
  std::string roles;
  for (const std::string_view role : kRoles) {
    if (question(role, topic)) roles += (roles.empty() ? "" : " ") + std::string(role);
  }
  return roles;
}

TEST(Roster, LetsNobodyButTheEngineTellTheTruthAndNobodyButTheRecorderReadIt) {
  EXPECT_EQ(who(writes, Topic::kTraffic), "traffic-engine");
  EXPECT_EQ(who(reads, Topic::kTraffic), "recorder");
}

TEST(Roster, WiresRoadAndRoadside) {
  EXPECT_EQ(who(writes, Topic::kAir), "traffic-engine");
  EXPECT_EQ(who(reads, Topic::kAir), "rsu0 rsu12");
  EXPECT_EQ(who(writes, Topic::kRoadside), "rsu0 rsu12");
  EXPECT_EQ(who(reads, Topic::kRoadside), "traffic-engine");
  EXPECT_EQ(who(writes, Topic::kSignal), "signal-controller");
  EXPECT_EQ(who(reads, Topic::kSignal), "traffic-engine recorder rsu0 rsu12");
}

TEST(Roster, WiresRequestsForGreensFromTheRsusToTheController) {
  EXPECT_EQ(who(writes, Topic::kRequest), "rsu0 rsu12");
  EXPECT_EQ(who(reads, Topic::kRequest), "signal-controller");
}

TEST(Roster, LetsTheClockSpeakToAllAndAllToTheClock) {
  EXPECT_EQ(who(writes, Topic::kControl), "clock");
  EXPECT_EQ(who(reads, Topic::kUp), "clock");
  EXPECT_EQ(who(reads, Topic::kControl), "traffic-engine signal-controller recorder observer rsu0 rsu12");
  EXPECT_EQ(who(writes, Topic::kUp), "traffic-engine signal-controller recorder observer rsu0 rsu12");
}

TEST(Roster, NumbersTheRsus) {
  EXPECT_EQ(rsu_role(0), "rsu0");
  EXPECT_EQ(rsu_role(12), "rsu12");
  EXPECT_EQ(rsu_index("rsu12"), 12);
  for (const char* other : {"rsu", "rsu1x", "rsux", "RSU1", "traffic-engine", ""}) EXPECT_EQ(rsu_index(other), -1);
}

TEST(Roster, ListsWhoMustBeThere) {
  EXPECT_EQ(roles_of_a_run(0), (std::vector<std::string>{"traffic-engine", "signal-controller", "recorder"}));
  EXPECT_EQ(roles_of_a_run(2),
            (std::vector<std::string>{"traffic-engine", "signal-controller", "recorder", "rsu0", "rsu1"}));
}

TEST(RunPhase, HasANameForPeople) {
  EXPECT_EQ(name(RunPhase::kForming), "forming");
  EXPECT_EQ(name(RunPhase::kRunning), "running");
  EXPECT_EQ(name(RunPhase::kPaused), "paused");
  EXPECT_EQ(name(RunPhase::kEnding), "ending");
  EXPECT_EQ(name(RunPhase::kEnded), "ended");
  EXPECT_EQ(name(RunPhase::kAborted), "aborted");
}

}  // namespace
}  // namespace lukou
