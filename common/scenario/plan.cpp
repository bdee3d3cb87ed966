#include "common/scenario/plan.hpp"

#include <array>
#include <cmath>
#include <optional>

#include "common/core/contract.hpp"
#include "common/intersection/conflicts.hpp"
#include "common/scenario/scenario.hpp"
#include "common/scenario/wording.hpp"

namespace lukou::scenario {
namespace {

constexpr const char* kLaneList = "WL WC WR SL SC SR EL EC ER NL NC NR";

Step steps(double duration_s) {
  return static_cast<Step>(std::llround(duration_s * static_cast<double>(kStepsPerSecond)));
}

/// Lanes that are unknown, twice or missing.
std::vector<Finding> lane_findings(const SignalPlan& plan, const FieldPath& path) {
  std::vector<Finding> findings;
  std::array<int, kLanes> seen{};
  for (int i = 0; i < plan.lane_plans_size(); ++i) {
    const FieldPath lane_plan = extended(path, "lane_plans", i);
    for (int n = 0; n < plan.lane_plans(i).lanes_size(); ++n) {
      const FieldPath place = extended(lane_plan, "lanes", n);
      const std::string& given = plan.lane_plans(i).lanes(n);
      const auto lane = lane_named(given);
      if (!lane) {
        findings.push_back({place, {}, text(place) + " is `" + given + "`, must be one of " + kLaneList, ""});
      } else if (seen[index(*lane)]++ > 0) {
        findings.push_back({place, {}, text(place) + " is " + given + " again; every lane must stand here once", ""});
      }
    }
  }
  std::vector<std::string> missing;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    if (seen[i] == 0) missing.emplace_back(name(static_cast<Lane>(i)));
  }
  if (!missing.empty()) {
    const std::string what = " leaves out " + joined(missing, " ") + "; every lane must stand in it once";
    findings.push_back({path, {}, text(path) + what, ""});
  }
  return findings;
}

/// Lane plans whose durations do not add up to the cycle.
std::vector<Finding> duration_findings(const SignalPlan& plan, const FieldPath& path) {
  std::vector<Finding> findings;
  if (!plan.has_cycle_s() || !std::isfinite(plan.cycle_s())) return findings;
  for (int i = 0; i < plan.lane_plans_size(); ++i) {
    double sum_s = 0.0;
    for (const TimedAspect& timed : plan.lane_plans(i).aspects()) sum_s += timed.duration_s();
    if (std::fabs(sum_s - plan.cycle_s()) < 0.05) continue;
    const FieldPath place = extended(path, "lane_plans", i);
    // Rounded: the sum of tenths need not be the nearest number to its own tenth.
    const std::string sum = number_text(std::round(sum_s * 1000.0) / 1000.0);
    findings.push_back(
        {place,
         {extended(path, "cycle_s")},
         text(place) + " adds up to " + sum + " s, must be signals.plan.cycle_s, " + number_text(plan.cycle_s()) + " s",
         ""});
  }
  return findings;
}

/// Whether each field of the plan is there and within its range, so that a plan can be built from it.
bool can_be_built(const SignalPlan& plan) {
  const auto fits = [](double value_s, double max_s) { return value_s >= 0.0 && value_s <= max_s; };
  if (!plan.has_cycle_s() || !fits(plan.cycle_s(), 3600.0) || !fits(plan.offset_s(), 3600.0)) return false;
  for (const LanePlan& lane_plan : plan.lane_plans()) {
    for (const TimedAspect& timed : lane_plan.aspects()) {
      if (timed.aspect() < RED || timed.aspect() > GREEN || !fits(timed.duration_s(), 3600.0)) return false;
    }
  }
  return true;
}

lukou::SignalPlan built(const SignalPlan& plan) {
  lukou::SignalPlan result;
  result.cycle = steps(plan.cycle_s());
  result.offset = steps(plan.offset_s());
  for (const LanePlan& lane_plan : plan.lane_plans()) {
    for (const std::string& lane : lane_plan.lanes()) {
      for (const TimedAspect& timed : lane_plan.aspects()) {
        result.lanes[index(*lane_named(lane))].push_back(
            {static_cast<lukou::Aspect>(timed.aspect()), steps(timed.duration_s())});
      }
    }
  }
  return result;
}

std::vector<Finding> hard_conflicts(const Scenario& scenario, const lukou::SignalPlan& plan) {
  if (scenario.signals().allow_conflicts()) return {};
  std::vector<std::string> pairs;
  for (const PlanConflict& found : conflicts_of(plan)) {
    if (found.kind == Conflict::kHard) pairs.push_back(lukou::text(found));
  }
  if (pairs.empty()) return {};
  return {{path_to({"signals", "plan"}),
           {path_to({"signals", "allow_conflicts"})},
           "signals.plan lets crossing streams go together: " + joined(pairs, ", ") +
               "; separate them, or set signals.allow_conflicts: true",
           ""}};
}

}  // namespace

std::vector<Finding> plan_findings(const Scenario& scenario) {
  const FieldPath path = path_to({"signals", "plan"});
  if (!scenario.signals().has_plan()) return {};
  std::vector<Finding> findings;
  if (scenario.signals().has_preset()) {
    findings.push_back({path,
                        {path_to({"signals", "preset"})},
                        "signals has preset and plan; a plan stands in place of a preset, give one of them alone",
                        ""});
  }
  for (Finding& finding : lane_findings(scenario.signals().plan(), path)) findings.push_back(std::move(finding));
  for (Finding& finding : duration_findings(scenario.signals().plan(), path)) findings.push_back(std::move(finding));
  if (!findings.empty() || !can_be_built(scenario.signals().plan())) return findings;
  const auto plan = validated(built(scenario.signals().plan()));
  if (!plan) return {{path, {}, "signals.plan: " + plan.error().text(), ""}};
  return hard_conflicts(scenario, plan.value());
}

lukou::SignalPlan plan_of(const Scenario& scenario) {
  if (scenario.signals().has_plan()) return built(scenario.signals().plan());
  switch (scenario.signals().preset()) {
    case PAPER_YELLOW:
      return paper_yellow_plan();
    case PROTECTED_LEFT:
      return protected_left_plan();
    default:
      return paper_plan();
  }
}

Expected<lukou::SignalPlan> signal_plan(const Resolved& scenario) {
  const auto findings = plan_findings(scenario.message());
  if (!findings.empty()) return Error{"", findings.front().what};
  return validated(plan_of(scenario.message()));
}

}  // namespace lukou::scenario
