#include "services/recorder/measure_config.hpp"

#include "common/scenario/scenario_steps.hpp"
#include "scenario.pb.h"

namespace lukou {
namespace {

run_log::Level level_of(scenario::Record::Log log) {
  switch (log) {
    case scenario::Record::EVENTS:
      return run_log::Level::kEvents;
    case scenario::Record::SECOND:
      return run_log::Level::kSecond;
    case scenario::Record::FULL:
      return run_log::Level::kFull;
    default:
      return run_log::Level::kNone;
  }
}

}  // namespace

RecorderConfig recorder_config(const scenario::Resolved& scenario) {
  const scenario::Scenario& s = scenario.message();
  const scenario::Protocol protocol = scenario::protocol(scenario);
  RecorderConfig config;
  config.measures = {.warmup_s = s.run().warmup_s(),
                     .road = {.approach_m = s.traffic().approach_length_m(), .exit_m = s.traffic().exit_length_m()},
                     .speed_limit_mps = s.vehicles().speed_limit_kmh() / 3.6,
                     .acceleration_max_mps2 = s.vehicles().acceleration_max_mps2(),
                     .speed_relaxation_s = s.driving().speed_relaxation_s(),
                     .stop_speed_mps = s.driving().stop_speed_kmh() / 3.6,
                     .stop_rearm_mps = s.driving().stop_rearm_kmh() / 3.6,
                     .vehicle_length_m = s.vehicles().length_m()};
  config.stop_on_overflow = s.run().on_overflow() == scenario::Overflow::STOP;
  config.record_stops = s.record().stops();
  config.record_guidance = s.record().guidance();
  config.record_safety = s.record().safety();
  config.log = level_of(s.record().log());
  config.actuated = s.signals().has_actuation();
  config.seed = protocol.seed;
  config.end = protocol.end;
  config.rsu_measured = protocol.rsu_measured;
  return config;
}

}  // namespace lukou
