#include "common/results/tables.hpp"

#include <algorithm>
#include <limits>

#include "tests/unit/common/results/test_folder.hpp"

namespace lukou::results {
namespace {

TEST(Columns, AreThoseOfTheDesign) {
  EXPECT_EQ(car_columns(),
            "vehicle,lane,equipped,entered_s,init_velocity_mps,theoretical_time_s,act_time_s,delta_s,delay_s,stops,"
            "stop_time_s,left_s,fuel_ml,fuel_standing_ml");
  EXPECT_EQ(stop_columns(),
            "step,time_s,WL,WC,WR,SL,SC,SR,EL,EC,ER,NL,NC,NR,system_total,mean_per_vehicle,standing_now");
  EXPECT_EQ(road_columns(),
            "step,time_s,WL,WC,WR,SL,SC,SR,EL,EC,ER,NL,NC,NR,left_lanes_total,mean_per_lane,left_system_total");
  EXPECT_EQ(
      stop_time_columns(),
      "step,time_s,WL_s,WC_s,WR_s,SL_s,SC_s,SR_s,EL_s,EC_s,ER_s,NL_s,NC_s,NR_s,system_total_s,mean_per_vehicle_s");
}

using Tables = InTestFolder;

TEST_F(Tables, HaveARowPerStepAndARowPerCar) {
  auto tables = RunTables::create(folder());
  ASSERT_TRUE(tables.ok()) << tables.error().text();
  StopRow stop;
  stop.stops[0] = 2;
  stop.stops[11] = 1;
  stop.system_total = 3;
  stop.mean_per_vehicle = std::numeric_limits<double>::quiet_NaN();
  stop.standing_now = 1;
  RoadRow road;
  road.crossed[1] = 6;
  road.left_lanes_total = 6;
  road.mean_per_lane = 0.5;
  road.left_system_total = 4;
  StopTimeRow stop_time;
  stop_time.stood_steps[2] = 15;
  stop_time.system_total_steps = 15;
  stop_time.mean_per_vehicle_s = 0.75;
  tables.value().add_step(1, stop, road, stop_time);
  tables.value().add_car({.vehicle = 8,
                          .lane = lane_of(Approach::kNorth, Turn::kRight),
                          .equipped = true,
                          .entered_s = 0.1,
                          .initial_speed_mps = 12.5,
                          .theoretical_time_s = 30.25,
                          .act_time_s = 45.5,
                          .delta_s = 15.25,
                          .delay_s = 14.125,
                          .stops = 1,
                          .standing_steps = 83,
                          .left_s = 52.0625,
                          .fuel_ml = 61.5,
                          .fuel_standing_ml = 1.25});
  tables.value().add_step(2, stop, road, stop_time);
  ASSERT_TRUE(tables.value().sync().ok());
  EXPECT_EQ(content("stop.csv"),
            stop_columns() + "\n1,0.1,2,0,0,0,0,0,0,0,0,0,0,1,3,,1\n2,0.2,2,0,0,0,0,0,0,0,0,0,0,1,3,,1\n");
  EXPECT_EQ(content("road.csv"),
            road_columns() + "\n1,0.1,0,6,0,0,0,0,0,0,0,0,0,0,6,0.5,4\n2,0.2,0,6,0,0,0,0,0,0,0,0,0,0,6,0.5,4\n");
  const std::string stood = ",0.0,0.0,1.5,0.0,0.0,0.0,0.0,0.0,0.0,0.0,0.0,0.0,1.5,0.75\n";
  EXPECT_EQ(content("stop_time.csv"), stop_time_columns() + "\n1,0.1" + stood + "2,0.2" + stood);
  EXPECT_EQ(content("car.csv"), car_columns() + "\n8,NR,1,0.1,12.5,30.25,45.5,15.25,14.125,1,8.3,52.0625,61.5,1.25\n");
}

TEST_F(Tables, KnowTheirHashesAndRowsForTheManifest) {
  auto tables = RunTables::create(folder());
  ASSERT_TRUE(tables.ok());
  tables.value().add_step(1, {}, {}, {});
  tables.value().add_step(2, {}, {}, {});
  ASSERT_TRUE(tables.value().flush().ok());
  const auto entries = tables.value().entries();
  ASSERT_EQ(entries.size(), 4U);
  EXPECT_TRUE(std::is_sorted(entries.begin(), entries.end(),
                             [](const FileEntry& a, const FileEntry& b) { return a.name < b.name; }));
  for (const FileEntry& entry : entries) {
    EXPECT_EQ(entry.sha256, sha256_hex(content(entry.name))) << entry.name;
    EXPECT_EQ(entry.rows, entry.name == "car.csv" ? 0 : 2) << entry.name;
  }
}

TEST_F(Tables, RefuseAGapBetweenSteps) {
  auto tables = RunTables::create(folder());
  ASSERT_TRUE(tables.ok());
  tables.value().add_step(1, {}, {}, {});
  EXPECT_DEATH(tables.value().add_step(3, {}, {}, {}), "step == last_step_ \\+ 1");
}

}  // namespace
}  // namespace lukou::results
