#include "common/results/event_tables.hpp"

#include <limits>

#include "common/core/hash.hpp"
#include "tests/unit/common/results/test_folder.hpp"

namespace lukou::results {
namespace {

using Events = InTestFolder;

TEST_F(Events, AreWrittenAsDocumented) {
  auto tables = EventTables::create(folder(), {.stops = true, .guidance = true});
  ASSERT_TRUE(tables.ok()) << tables.error().text();
  tables.value().add(FinishedStop{.ended = 812,
                                  .vehicle = 9,
                                  .lane = lane_of(Approach::kSouth, Turn::kCenter),
                                  .equipped = true,
                                  .began = 500,
                                  .distance_m = 12.25,
                                  .standing_steps = 301,
                                  .cause = "lost_burst",
                                  .guidance = "expired",
                                  .missed = "lost_burst"});
  tables.value().add(SettledAdvice{.settled = 120,
                                   .issued = 112,
                                   .rsu = 0,
                                   .sequence = 77,
                                   .vehicle = 9,
                                   .lane = lane_of(Approach::kSouth, Turn::kCenter),
                                   .commanded_mps2 = -0.37,
                                   .fate = "applied",
                                   .first_used = 115,
                                   .last_used = 119});
  SettledAdvice garbled{.settled = 121, .rsu = 1, .sequence = 3, .fate = "malformed"};
  garbled.commanded_mps2 = std::numeric_limits<double>::quiet_NaN();
  tables.value().add(garbled);
  ASSERT_TRUE(tables.value().sync().ok());
  EXPECT_EQ(content("stops.csv"),
            "step,time_s,vehicle,lane,equipped,began_step,began_s,distance_m,stood_s,cause,guidance,missed\n"
            "812,81.2,9,SC,1,500,50.0,12.25,30.1,lost_burst,expired,lost_burst\n");
  // Used in step 115: it acts from t_114 on, 0.2 s after its issue.
  EXPECT_EQ(content("guidance.csv"),
            "step,time_s,issued_step,issued_s,rsu,sequence,vehicle,lane,commanded_mps2,fate,age_s,last_step,kind,"
            "commanded_speed_mps\n"
            "120,12.0,112,11.2,0,77,9,SC,-0.37,applied,0.2,119,acceleration,\n"
            "121,12.1,,,1,3,,,,malformed,,,acceleration,\n");
  const auto entries = tables.value().entries();
  ASSERT_EQ(entries.size(), 2U);
  EXPECT_EQ(entries[0].name, "guidance.csv");
  EXPECT_EQ(entries[0].rows, 2);
  EXPECT_EQ(entries[1].sha256, sha256_hex(content("stops.csv")));
}

TEST_F(Events, OfRequestsAreWrittenAsDocumented) {
  auto tables = EventTables::create(folder(), {.requests = true});
  ASSERT_TRUE(tables.ok()) << tables.error().text();
  const LaneSet lanes{lane_of(Approach::kSouth, Turn::kCenter), lane_of(Approach::kWest, Turn::kRight)};
  tables.value().add(RequestRow{.step = 21, .rsu = 0, .lanes = lanes, .outcome = RequestOutcome::kAccepted});
  tables.value().add(RequestRow{.step = 22, .rsu = 0, .lanes = lanes, .outcome = RequestOutcome::kMinGreen});
  tables.value().add(RequestRow{.step = 30, .rsu = 0, .lanes = lanes, .outcome = RequestOutcome::kMaxWait});
  tables.value().add(RequestRow{.step = 40, .rsu = 1, .lanes = {}, .outcome = RequestOutcome::kMalformed});
  tables.value().add(RequestRow{.step = 41, .rsu = 1, .lanes = lanes, .outcome = RequestOutcome::kConflict});
  tables.value().add(RequestRow{.step = 42, .rsu = 1, .lanes = lanes, .outcome = RequestOutcome::kOtherRsu});
  tables.value().add(RequestRow{.step = 50, .rsu = 0, .lanes = lanes, .outcome = RequestOutcome::kEnded});
  ASSERT_TRUE(tables.value().sync().ok());
  EXPECT_EQ(content("requests.csv"),
            "step,time_s,rsu,lanes,outcome,rule\n"
            "21,2.1,0,WR SC,accepted,\n"
            "22,2.2,0,WR SC,deferred,min_green\n"
            "30,3.0,0,WR SC,overruled,max_wait\n"
            "40,4.0,1,,refused,malformed\n"
            "41,4.1,1,WR SC,refused,conflict\n"
            "42,4.2,1,WR SC,refused,other_rsu\n"
            "50,5.0,0,WR SC,ended,\n");
  ASSERT_EQ(tables.value().entries().size(), 1U);
  EXPECT_EQ(tables.value().entries()[0].name, "requests.csv");
  EXPECT_EQ(tables.value().entries()[0].rows, 7);
}

TEST_F(Events, SayWhichSpeedAnAdviceAskedFor) {
  auto tables = EventTables::create(folder(), {.guidance = true});
  ASSERT_TRUE(tables.ok()) << tables.error().text();
  SettledAdvice speed{.settled = 120, .issued = 112, .vehicle = 9, .lane = Lane{4}, .commanded_mps2 = -0.5};
  speed.fate = "applied";
  speed.first_used = 113;
  speed.last_used = 117;
  speed.kind = "speed";
  speed.speed_mps = 12.5;
  tables.value().add(speed);
  ASSERT_TRUE(tables.value().sync().ok());
  EXPECT_EQ(content("guidance.csv"),
            "step,time_s,issued_step,issued_s,rsu,sequence,vehicle,lane,commanded_mps2,fate,age_s,last_step,kind,"
            "commanded_speed_mps\n"
            "120,12.0,112,11.2,0,0,9,SC,-0.5,applied,0.0,117,speed,12.5\n");
}

TEST_F(Events, HaveARowForADeadlineThatAnRsuMissed) {
  auto tables = EventTables::create(folder(), {.guidance = true});
  ASSERT_TRUE(tables.ok()) << tables.error().text();
  tables.value().add(MissedDeadline{.known = 121, .answered = 120, .rsu = 1, .took_ms = 137});
  ASSERT_TRUE(tables.value().sync().ok());
  EXPECT_EQ(content("guidance.csv"), guidance_columns() + "\n121,12.1,120,12.0,1,,,,,deadline_missed,0.137,,,\n");
}

TEST_F(Events, OfEncountersAreWrittenAsDocumented) {
  auto tables = EventTables::create(folder(), {.safety = true});
  ASSERT_TRUE(tables.ok()) << tables.error().text();
  tables.value().add(Encounter{.ended = 131,
                               .kind = SafetyKind::kTtc,
                               .vehicle = 9,
                               .lane = lane_of(Approach::kSouth, Turn::kCenter),
                               .equipped = true,
                               .other = 5,
                               .other_lane = lane_of(Approach::kSouth, Turn::kCenter),
                               .other_equipped = false,
                               .guided = true,
                               .began = 102,
                               .last = 121,
                               .worst = 115,
                               .value = 1.25,
                               .distance_m = 40.5,
                               .speed_mps = 12.0});
  tables.value().add(Encounter{.ended = 140, .kind = SafetyKind::kHardBraking, .vehicle = 3, .value = -4.5});
  ASSERT_TRUE(tables.value().sync().ok());
  EXPECT_EQ(content("safety.csv"),
            "step,time_s,kind,vehicle,lane,equipped,other,other_lane,other_equipped,guided,began_step,began_s,"
            "last_step,worst_step,worst_s,value,distance_m,speed_mps\n"
            "131,13.1,ttc,9,SC,1,5,SC,0,1,102,10.2,121,115,11.5,1.25,40.5,12\n"
            "140,14.0,hard_braking,3,WL,0,,,,0,0,0.0,0,0,0.0,-4.5,0,0\n");
  ASSERT_EQ(tables.value().entries().size(), 1U);
  EXPECT_EQ(tables.value().entries()[0].name, "safety.csv");
}

TEST_F(Events, AreLeftOutWhenNobodyAskedForThem) {
  auto tables = EventTables::create(folder(), {});
  ASSERT_TRUE(tables.ok());
  tables.value().add(FinishedStop{});
  ASSERT_TRUE(tables.value().sync().ok());
  EXPECT_TRUE(tables.value().entries().empty());
  EXPECT_TRUE(std::filesystem::is_empty(folder()));
}

}  // namespace
}  // namespace lukou::results
