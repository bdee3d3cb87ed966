#include <algorithm>
#include <array>
#include <cmath>

#include "common/intersection/conflicts.hpp"
#include "common/scenario/actuation.hpp"
#include "common/scenario/arrivals.hpp"
#include "common/scenario/plan.hpp"
#include "common/scenario/scenario.hpp"
#include "common/scenario/wording.hpp"

namespace lukou::scenario {
namespace {

/// The largest flow that a demand reaches [veh/h]; of a trace, the mean over the run.
double peak_flow_veh_per_h(const Scenario& scenario, Approach approach) {
  const Demand& demand = demand_of(scenario, approach);
  if (demand.has_arrivals_csv()) {
    const auto times_s = read_arrivals(demand.arrivals_csv(), approach);
    if (!times_s) return 0.0;
    const auto end = std::upper_bound(times_s.value().begin(), times_s.value().end(), scenario.run().duration_s());
    return static_cast<double>(end - times_s.value().begin()) * 3600.0 / scenario.run().duration_s();
  }
  double peak = demand.flow_veh_per_h();
  for (const FlowPoint& point : demand.flow_series()) {
    if (point.from_s() < scenario.run().duration_s()) peak = std::max(peak, point.flow_veh_per_h());
  }
  return peak;
}

void warn_of_demand(const Scenario& scenario, const lukou::SignalPlan& plan, std::vector<std::string>& warnings) {
  for (const Approach approach : kAllApproaches) {
    const LaneShares& shares = demand_of(scenario, approach).shares();
    const double demand = peak_flow_veh_per_h(scenario, approach);
    const double capacity = capacity_veh_per_h(plan, approach, {shares.left(), shares.center(), shares.right()});
    if (demand <= capacity) continue;
    const auto whole = [](double flow) { return std::to_string(std::lround(flow)); };
    warnings.push_back("traffic." + std::string(name(approach)) + ": the demand of " + whole(demand) +
                       " veh/h is above the capacity of " + whole(capacity) +
                       " veh/h under this signal plan; its queues grow until the entrance overflows");
  }
}

void warn_of_conflicts(const Scenario& scenario, const lukou::SignalPlan& plan, std::vector<std::string>& warnings) {
  std::vector<std::string> permitted;
  std::vector<std::string> hard;
  for (const PlanConflict& found : conflicts_of(plan)) {
    const std::string pair = std::string(name(found.a)) + "-" + std::string(name(found.b));
    (found.kind == Conflict::kHard ? hard : permitted).push_back(pair);
  }
  if (!hard.empty() && scenario.signals().allow_conflicts()) {
    warnings.push_back("signals: crossing streams go together, as signals.allow_conflicts permits: " +
                       joined(hard, ", "));
  }
  if (!permitted.empty()) {
    warnings.push_back("signals: left turns go together with the traffic that comes towards them (" +
                       joined(permitted, ", ") + "); they do not wait for a gap, and safety figures keep them apart");
  }
}

/// The plan stands in for requests; its own reds should not be what the maximum wait is for.
void warn_of_long_reds(const Scenario& scenario, const lukou::SignalPlan& plan, std::vector<std::string>& warnings) {
  const auto actuation = scenario::actuation(scenario);
  if (!actuation) return;
  std::vector<std::string> lanes;
  for (const Lane lane : kAllLanes) {
    Step red = 0;
    Step longest = 0;
    for (Step at = 0; at < 2 * plan.cycle; ++at) {
      red = aspect_at(plan, lane, at) == lukou::Aspect::kGreen ? 0 : red + 1;
      longest = std::max(longest, red);
    }
    if (longest + actuation->all_red > actuation->max_wait) lanes.emplace_back(name(lane));
  }
  if (lanes.empty()) return;
  warnings.push_back("signals.actuation.max_wait_s: the plan itself keeps " + joined(lanes, ", ") +
                     " red for longer than the maximum wait, which then comes before the plan");
}

/// An RSU does not know that two of its sensors see the same car.
void warn_of_overlapping_sensors(const Scenario& scenario, std::vector<std::string>& warnings) {
  for (int r = 0; r < scenario.rsus_size(); ++r) {
    const auto& sensors = scenario.rsus(r).sensors();
    for (int b = 0; b < sensors.size(); ++b) {
      for (int a = 0; a < b; ++a) {
        const double from_m = std::max(sensors[a].from_m(), sensors[b].from_m());
        const double to_m = std::min(sensors[a].to_m(), sensors[b].to_m());
        if (sensors[a].approach() != sensors[b].approach() || from_m >= to_m) continue;
        const std::string rsu = "rsus[" + std::to_string(r) + "].sensors";
        warnings.push_back(rsu + ": [" + std::to_string(a) + "] and [" + std::to_string(b) + "] both see the cars " +
                           number_text(from_m) + " to " + number_text(to_m) +
                           " m before the line; the RSU is told of each of them twice");
      }
    }
  }
}

}  // namespace

double capacity_veh_per_h(const lukou::SignalPlan& plan, Approach approach,
                          const std::array<double, kLanesPerApproach>& shares) {
  double sum = 0.0;
  for (const double share : shares) sum += share;
  double capacity = 0.0;
  bool first = true;
  for (int turn = 0; turn < kLanesPerApproach; ++turn) {
    const double share = shares[static_cast<std::size_t>(turn)];
    if (share <= 0.0) continue;
    const Lane lane = lane_of(approach, static_cast<Turn>(turn));
    const double at_saturation = kSaturationFlow_veh_per_h * green_share(plan, lane) * sum / share;
    capacity = first ? at_saturation : std::min(capacity, at_saturation);
    first = false;
  }
  return capacity;
}

std::vector<std::string> warnings(const Resolved& resolved) {
  const Scenario& scenario = resolved.message();
  const lukou::SignalPlan plan = plan_of(scenario);
  std::vector<std::string> warnings;
  warn_of_demand(scenario, plan, warnings);
  warn_of_conflicts(scenario, plan, warnings);
  warn_of_long_reds(scenario, plan, warnings);
  warn_of_overlapping_sensors(scenario, warnings);
  const double duration_s = scenario.run().duration_s();
  if (scenario.run().warmup_s() >= duration_s) {
    warnings.push_back("run.warmup_s: the warm-up of " + number_text(scenario.run().warmup_s()) +
                       " s does not end before the run does, after " + number_text(duration_s) +
                       " s: there will be no figures of the steady state");
  }
  if (scenario.driving().reaction_distance_m() > scenario.traffic().approach_length_m()) {
    warnings.push_back("driving.reaction_distance_m: drivers react to the light from " +
                       number_text(scenario.driving().reaction_distance_m()) + " m on, but the approach is only " +
                       number_text(scenario.traffic().approach_length_m()) + " m long");
  }
  return warnings;
}

}  // namespace lukou::scenario
