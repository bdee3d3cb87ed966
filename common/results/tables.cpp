#include "common/results/tables.hpp"

#include <utility>

#include "common/core/contract.hpp"

namespace lukou::results {
namespace {

/// "WL,WC,...,NR", each with `ending`.
std::string lane_columns(const std::string& ending) {
  std::string columns;
  for (int i = 0; i < kLanes; ++i) columns += std::string(name(static_cast<Lane>(i))) + ending + ",";
  return columns;
}

void begin_step(TableWriter& table, Step step) {
  table.whole(step);
  table.tenths(step);
}

}  // namespace

std::string car_columns() {
  return "vehicle,lane,equipped,entered_s,init_velocity_mps,theoretical_time_s,act_time_s,delta_s,delay_s,stops,"
         "stop_time_s,left_s,fuel_ml,fuel_standing_ml";
}
std::string stop_columns() { return "step,time_s," + lane_columns("") + "system_total,mean_per_vehicle,standing_now"; }
std::string road_columns() {
  return "step,time_s," + lane_columns("") + "left_lanes_total,mean_per_lane,left_system_total";
}
std::string stop_time_columns() { return "step,time_s," + lane_columns("_s") + "system_total_s,mean_per_vehicle_s"; }

Expected<RunTables> RunTables::create(const std::filesystem::path& folder) {
  auto car = TableWriter::create(folder / kCarTable, car_columns());
  if (!car) return car.error();
  auto stop = TableWriter::create(folder / kStopTable, stop_columns());
  if (!stop) return stop.error();
  auto road = TableWriter::create(folder / kRoadTable, road_columns());
  if (!road) return road.error();
  auto stop_time = TableWriter::create(folder / kStopTimeTable, stop_time_columns());
  if (!stop_time) return stop_time.error();
  return RunTables(std::move(car).value(), std::move(stop).value(), std::move(road).value(),
                   std::move(stop_time).value());
}

RunTables::RunTables(TableWriter car, TableWriter stop, TableWriter road, TableWriter stop_time)
    : car_(std::move(car)), stop_(std::move(stop)), road_(std::move(road)), stop_time_(std::move(stop_time)) {}

void RunTables::add_car(const FinishedCar& row) {
  car_.count(row.vehicle);
  car_.name(name(row.lane));
  car_.whole(row.equipped ? 1 : 0);
  car_.real(row.entered_s);
  car_.real(row.initial_speed_mps);
  car_.real(row.theoretical_time_s);
  car_.real(row.act_time_s);
  car_.real(row.delta_s);
  car_.real(row.delay_s);
  car_.count(row.stops);
  car_.tenths(row.standing_steps);
  car_.real(row.left_s);
  car_.real(row.fuel_ml);
  car_.real(row.fuel_standing_ml);
  car_.end_row();
}

void RunTables::add_step(Step step, const StopRow& stop, const RoadRow& road, const StopTimeRow& stop_time) {
  LUKOU_EXPECT(step == last_step_ + 1);
  last_step_ = step;

  begin_step(stop_, step);
  for (const std::uint64_t stops : stop.stops) stop_.count(stops);
  stop_.count(stop.system_total);
  stop_.real(stop.mean_per_vehicle);
  stop_.count(stop.standing_now);
  stop_.end_row();

  begin_step(road_, step);
  for (const std::uint64_t crossed : road.crossed) road_.count(crossed);
  road_.count(road.left_lanes_total);
  road_.real(road.mean_per_lane);
  road_.count(road.left_system_total);
  road_.end_row();

  begin_step(stop_time_, step);
  for (const std::int64_t steps : stop_time.stood_steps) stop_time_.tenths(steps);
  stop_time_.tenths(stop_time.system_total_steps);
  stop_time_.real(stop_time.mean_per_vehicle_s);
  stop_time_.end_row();
}

Expected<Done> RunTables::flush() {
  for (TableWriter* table : {&car_, &stop_, &road_, &stop_time_}) {
    const auto flushed = table->flush();
    if (!flushed) return flushed;
  }
  return Done{};
}

Expected<Done> RunTables::sync() {
  for (TableWriter* table : {&car_, &stop_, &road_, &stop_time_}) {
    const auto synced = table->sync();
    if (!synced) return synced;
  }
  return Done{};
}

std::size_t RunTables::buffered_bytes() const {
  return car_.buffered_bytes() + stop_.buffered_bytes() + road_.buffered_bytes() + stop_time_.buffered_bytes();
}

std::vector<FileEntry> RunTables::entries() const {
  return {{kCarTable, car_.sha256(), car_.rows_flushed()},
          {kRoadTable, road_.sha256(), road_.rows_flushed()},
          {kStopTable, stop_.sha256(), stop_.rows_flushed()},
          {kStopTimeTable, stop_time_.sha256(), stop_time_.rows_flushed()}};
}

}  // namespace lukou::results
