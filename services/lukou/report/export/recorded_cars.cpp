#include "services/lukou/report/export/recorded_cars.hpp"

#include <string>

#include "scenario.pb.h"
#include "services/lukou/report/words.hpp"

namespace lukou::report {

RoadFacts road_facts(const Result& result) {
  const auto& scenario = result.scenario().message();
  return {.road = {.approach_m = scenario.traffic().approach_length_m(), .exit_m = scenario.traffic().exit_length_m()},
          .vehicle_length_m = scenario.vehicles().length_m(),
          .vehicle_width_m = scenario.vehicles().width_m()};
}

RecordedCar recorded_car(const TrafficBatch& batch, std::size_t i, const RoadLengths& road) {
  const auto lane = static_cast<Lane>(batch.lane[i]);
  return {.vehicle = batch.vehicle[i],
          .lane = lane,
          .equipped = batch.equipped[i] != 0,
          .past_line_m = batch.position_m[i] - road.approach_m,
          .position_m = batch.position_m[i],
          .front = pose_on_path(road, lane, batch.position_m[i]),
          .speed_mps = batch.speed_mps[i],
          .acceleration_mps2 = batch.acceleration_mps2[i],
          .advised = batch.guidance[i] == static_cast<std::uint8_t>(GuidanceState::kInForce)};
}

Expected<Step> period_of(const Result& result, const std::optional<Step>& wanted) {
  const auto log = result.run_log(run_log::Level::kSecond, "an export of trajectories");
  if (!log) return log.error();
  const bool full = log.value().facts().level == run_log::Level::kFull;
  const Step recorded = full ? 1 : kStepsPerSecond;
  if (!wanted) return recorded;
  if (*wanted % recorded == 0) return *wanted;
  return Error{"--period " + fixed(time_s(*wanted), 1) + "s",
               "must be whole seconds: the cars were recorded once a "
               "second (record.log=SECOND)"};
}

Expected<Done> for_each_instant(const Result& result, Step period, const TakeInstant& take) {
  auto log = result.run_log(run_log::Level::kSecond, "an export of trajectories");
  if (!log) return log.error();
  log.value().read_only({run_log::Channel::kCars});
  while (true) {
    const auto step = log.value().next();
    if (!step) return step.error();
    if (step.value() == nullptr) return Done{};
    if (!step.value()->cars || step.value()->step % period != 0) continue;
    if (auto taken = take(step.value()->step, step.value()->traffic); !taken) return taken;
  }
}

}  // namespace lukou::report
