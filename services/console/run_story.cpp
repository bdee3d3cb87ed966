#include "services/console/run_story.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/core/version.hpp"
#include "common/intersection/conflicts.hpp"
#include "common/intersection/geometry.hpp"
#include "common/scenario/scenario_steps.hpp"
#include "console.pb.h"
#include "scenario.pb.h"

namespace lukou::console {
namespace {

constexpr double kPointEvery_m = 1.0;  ///< along a curve

void add_point(LanePath& path, const RoadLengths& road, Lane lane, double distance_m) {
  const Pose pose = pose_on_path(road, lane, distance_m);
  Point& point = *path.add_points();
  point.set_x_m(pose.x_m);
  point.set_y_m(pose.y_m);
  path.add_distance_m(distance_m);
}

/// Straight to the stop line, the curve in short pieces, straight to the end.
void fill(LanePath& path, const RoadLengths& road, Lane lane) {
  path.set_name(std::string(name(lane)));
  path.set_stop_line_m(road.approach_m);
  add_point(path, road, lane, 0.0);
  const double curve_m = std::min(curve_length_m(lane), road.exit_m);
  const int pieces = static_cast<int>(std::ceil(curve_m / kPointEvery_m));
  for (int piece = 0; piece <= pieces; ++piece) {
    add_point(path, road, lane, road.approach_m + curve_m * piece / pieces);
  }
  if (curve_m < road.exit_m) add_point(path, road, lane, road.approach_m + road.exit_m);
}

void fill(LiveField& field, const scenario::LiveValue& live) {
  field.set_path(live.path);
  field.set_unit(live.unit);
  field.set_value(live.value);
  if (live.min) field.set_min(*live.min);
  if (live.max) field.set_max(*live.max);
  field.set_source(live.source);
  for (const std::string& word : live.words) field.add_words(word);
}

std::string conflict_matrix() {
  std::string octets;
  for (std::uint8_t a = 0; a < kLanes; ++a) {
    for (std::uint8_t b = 0; b < kLanes; ++b) {
      const Conflict found = a == b ? Conflict::kNone : conflict(static_cast<Lane>(a), static_cast<Lane>(b));
      octets += static_cast<char>(found);
    }
  }
  return octets;
}

}  // namespace

SignalProgram message_of(const SignalPlan& plan, Step offset) {
  SignalProgram program;
  program.set_cycle_steps(static_cast<std::uint32_t>(plan.cycle));
  program.set_offset_steps(static_cast<std::uint32_t>(offset));
  for (const std::vector<TimedAspect>& lane : plan.lanes) {
    LaneProgram& of_lane = *program.add_lanes();
    for (const TimedAspect& timed : lane) {
      of_lane.add_aspect(static_cast<std::uint32_t>(timed.aspect));
      of_lane.add_steps(static_cast<std::uint32_t>(timed.duration));
    }
  }
  return program;
}

Expected<RunStory> RunStory::of(const std::string& run, const std::string& scenario_text,
                                std::optional<Step> recorded_to) {
  auto scenario = scenario::load_text(scenario_text, "scenario of " + run, "/");
  if (!scenario) return scenario.error();
  auto plan = scenario::signal_plan(scenario.value());
  if (!plan) return plan.error();
  return RunStory(run, std::move(scenario).value(), scenario_text, std::move(plan).value(), recorded_to);
}

RunStory::RunStory(std::string run, scenario::Resolved scenario, std::string text, SignalPlan plan,
                   std::optional<Step> recorded_to)
    : run_(std::move(run)),
      scenario_(std::move(scenario)),
      text_(std::move(text)),
      latest_(plan),
      plans_(std::move(plan)),
      promise_(scenario::signal_promise(scenario_)),
      recorded_to_(recorded_to) {
  for (const scenario::LiveValue& live : scenario::live_values(scenario_)) initial_[live.path] = live.value;
}

void RunStory::change(const Directive& directive) {
  // The clock has checked it; what this program cannot follow it leaves alone.
  if (!scenario::change(scenario_, directive.set)) return;
  const auto plan = scenario::signal_plan(scenario_);
  if (!plan || plan.value() == latest_) return;
  latest_ = plan.value();
  plans_.change(latest_, directive.step + promise_);
}

RunStory::Program RunStory::program_at(Step step) {
  if (!recorded_to_) plans_.forget_before(step);
  const PlanSchedule::Running& running = plans_.running_at(step);
  // Of a plan with an offset a cycle is under way when it takes over.
  const Step begun = std::max<Step>(running.from, 0);
  const Step start = next_cycle_start(running.plan, begun);
  return {&running, start > begun ? start - running.plan.cycle : start};
}

Hello RunStory::hello() const {
  const scenario::Scenario& s = scenario_.message();
  const RoadLengths road{.approach_m = s.traffic().approach_length_m(), .exit_m = s.traffic().exit_length_m()};
  Hello hello;
  hello.set_run(run_);
  hello.set_version(std::string(version()));
  hello.set_scenario_text(text_);
  for (std::uint8_t lane = 0; lane < kLanes; ++lane) fill(*hello.add_lanes(), road, static_cast<Lane>(lane));
  hello.set_vehicle_length_m(s.vehicles().length_m());
  hello.set_vehicle_width_m(s.vehicles().width_m());
  hello.set_lane_width_m(kLaneWidth_m);
  hello.set_speed_limit_mps(s.vehicles().speed_limit_kmh() / 3.6);
  hello.set_step_s(1.0 / static_cast<double>(kStepsPerSecond));
  for (const scenario::LiveValue& live : scenario::live_values(scenario_)) {
    LiveField& field = *hello.add_live();
    fill(field, live);
    if (const auto initial = initial_.find(live.path); initial != initial_.end()) field.set_initial(initial->second);
  }
  for (const scenario::Rsu& rsu : s.rsus()) {
    hello.add_rsus(rsu.algorithm());
    hello.add_antennas();  // at the centre of the junction
  }
  for (const scenario::NamedPlan& preset : scenario::signal_presets()) {
    Presets& named = *hello.add_presets();
    named.set_name(preset.name);
    *named.mutable_program() = message_of(preset.plan, preset.plan.offset);
  }
  hello.set_conflicts(conflict_matrix());
  hello.set_seed(std::to_string(s.run().seed()));
  if (recorded_to_) hello.set_recorded_to(*recorded_to_);
  return hello;
}

}  // namespace lukou::console
