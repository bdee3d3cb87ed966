#include "common/scenario/check.hpp"

#include <cmath>
#include <optional>

#include "common/scenario/arrivals.hpp"
#include "common/scenario/field_check.hpp"
#include "common/scenario/plan.hpp"
#include "common/scenario/radio_preset.hpp"
#include "common/scenario/wording.hpp"

namespace lukou::scenario {
namespace {

using google::protobuf::FieldDescriptor;

/// Finds what is wrong and remembers it.
class Checker {
 public:
  explicit Checker(const Scenario& scenario) : scenario_(scenario), findings_(field_findings(scenario)) {}

  std::vector<Finding> run() && {
    demands();
    drivers();
    compliance();
    links();
    sensors();
    actuation();
    computing();
    for (Finding& finding : plan_findings(scenario_)) findings_.push_back(std::move(finding));
    return std::move(findings_);
  }

 private:
  void add(const FieldPath& path, const std::string& what, std::vector<FieldPath> also = {}) {
    findings_.push_back({path, std::move(also), text(path) + " " + what, ""});
  }

  void demands() {
    for (const Approach approach : kAllApproaches) {
      const Demand& demand = demand_of(scenario_, approach);
      const FieldPath path = demand_path(approach);
      one_arm(demand, path);
      const LaneShares& shares = demand.shares();
      if (shares.left() == 0.0 && shares.center() == 0.0 && shares.right() == 0.0) {
        add(extended(path, "shares"), "are all 0, at least one lane must have a share");
      }
      for (int i = 1; i < demand.flow_series_size(); ++i) {
        const double before = demand.flow_series(i - 1).from_s();
        if (demand.flow_series(i).from_s() > before) continue;
        add(extended(extended(path, "flow_series", i), "from_s"), "is " + number_text(demand.flow_series(i).from_s()) +
                                                                      " s, must be after the point before it, " +
                                                                      number_text(before) + " s");
      }
      if (!demand.has_arrivals_csv()) continue;
      const auto trace = read_arrivals(demand.arrivals_csv(), approach);
      if (trace.ok()) continue;
      const FieldPath csv = extended(path, "arrivals_csv");
      findings_.push_back({csv, {}, trace.error().what, trace.error().where});
      if (findings_.back().where.empty()) findings_.back().what = text(csv) + ": " + trace.error().what;
    }
  }

  void one_arm(const Demand& demand, const FieldPath& path) {
    std::vector<FieldPath> given;
    std::vector<std::string> names;
    for (const char* arm : {"flow_veh_per_h", "flow_series", "arrivals_csv"}) {
      const FieldDescriptor* field = Demand::descriptor()->FindFieldByName(arm);
      if (!has(demand, field)) continue;
      given.push_back(extended(path, field, field->is_repeated() ? 0 : -1));
      names.emplace_back(arm);
    }
    if (given.size() < 2) return;
    findings_.push_back(
        {given.back(), {}, text(path) + " has " + joined(names, " and ") + "; give one of them alone", ""});
  }

  void drivers() {
    const FieldPath driving = path_to({"driving"});
    const auto field = [&](const char* name) { return extended(driving, name); };
    const Driving& d = scenario_.driving();
    if (d.desired_speed_min() > d.desired_speed_max()) {
      add(field("desired_speed_min"),
          "is " + number_text(d.desired_speed_min()) + ", must not be above desired_speed_max, " +
              number_text(d.desired_speed_max()),
          {field("desired_speed_max")});
    } else if (d.desired_speed_mean() < d.desired_speed_min() || d.desired_speed_mean() > d.desired_speed_max()) {
      add(field("desired_speed_mean"),
          "is " + number_text(d.desired_speed_mean()) + ", must be within [desired_speed_min, desired_speed_max], [" +
              number_text(d.desired_speed_min()) + ", " + number_text(d.desired_speed_max()) + "]",
          {field("desired_speed_min"), field("desired_speed_max")});
    } else if (d.desired_speed_max() - d.desired_speed_min() < 0.05 * d.desired_speed_deviation()) {
      // The draw rejects what lies outside the interval: with less than 1 % of the mass inside it would not end.
      add(field("desired_speed_deviation"),
          "is " + number_text(d.desired_speed_deviation()) +
              ", must not be above 20 times the width of [desired_speed_min, desired_speed_max]",
          {field("desired_speed_min"), field("desired_speed_max")});
    }
    if (d.stop_rearm_kmh() <= d.stop_speed_kmh()) {
      add(field("stop_rearm_kmh"),
          "is " + number_text(d.stop_rearm_kmh()) + " km/h, must be above stop_speed_kmh, " +
              number_text(d.stop_speed_kmh()) + " km/h",
          {field("stop_speed_kmh")});
    }
  }

  void sensors() {
    for (int r = 0; r < scenario_.rsus_size(); ++r) {
      const Rsu& rsu = scenario_.rsus(r);
      for (int s = 0; s < rsu.sensors_size(); ++s) {
        sensor(rsu.sensors(s), extended(extended(FieldPath{}, "rsus", r), "sensors", s));
      }
    }
  }

  void computing() {
    for (int r = 0; r < scenario_.rsus_size(); ++r) {
      const Computing& said = scenario_.rsus(r).computing();
      const FieldPath path = extended(extended(FieldPath{}, "rsus", r), "computing");
      const bool declared = said.mode() == Computing::DECLARED;
      if (said.mode() == Computing::REAL && scenario_.signals().has_actuation()) {
        add(extended(path, "mode"),
            "is REAL, must be FREE or DECLARED in a run with signals.actuation: the measured delay of a request is not "
            "recorded",
            {path_to({"signals", "actuation"})});
      }
      if (declared && !said.has_declared_ms()) {
        add(extended(path, "mode"), "is DECLARED, but declared_ms is missing; it takes a number within [1, 5000] ms");
      } else if (!declared && said.has_declared_ms()) {
        add(extended(path, "declared_ms"),
            "is read with mode: DECLARED alone; mode is " + Computing::Mode_Name(said.mode()),
            {extended(path, "mode")});
      }
    }
  }

  void sensor(const Sensor& said, const FieldPath& path) {
    const std::string given = "is " + number_text(said.to_m()) + " m, must be ";
    if (said.to_m() <= said.from_m()) {
      add(extended(path, "to_m"), given + "above from_m, " + number_text(said.from_m()) + " m",
          {extended(path, "from_m")});
    }
    const double approach_m = scenario_.traffic().approach_length_m();
    if (said.to_m() > approach_m) {
      add(extended(path, "to_m"), given + "at most traffic.approach_length_m, " + number_text(approach_m) + " m",
          {path_to({"traffic", "approach_length_m"})});
    }
  }

  void actuation() {
    if (!scenario_.signals().has_actuation()) return;
    const Actuation& said = scenario_.signals().actuation();
    const FieldPath path = path_to({"signals", "actuation"});
    const double clearance_s = said.min_green_s() + said.yellow_s() + said.all_red_s();
    if (said.max_wait_s() < clearance_s) {
      add(extended(path, "max_wait_s"),
          "is " + number_text(said.max_wait_s()) + " s, must be at least min_green_s + yellow_s + all_red_s, " +
              number_text(clearance_s) + " s",
          {extended(path, "min_green_s")});
    }
    if (scenario_.signals().allow_conflicts()) {
      add(path, "keeps crossing streams apart; take it away, or signals.allow_conflicts",
          {path_to({"signals", "allow_conflicts"})});
    }
    if (scenario_.run().on_rsu_loss() != RsuLoss::ABORT) {
      add(path_to({"run", "on_rsu_loss"}),
          "is " + RsuLoss::Policy_Name(scenario_.run().on_rsu_loss()) +
              ", must be ABORT in a run with signals.actuation: when the controller stopped hearing an RSU is not "
              "recorded",
          {path});
    }
  }

  void compliance() {
    const Compliance& said = scenario_.vehicles().compliance();
    const FieldPath path = path_to({"vehicles", "compliance"});
    const double human = said.human_share();
    const double ignoring = said.ignoring_share();
    if (human < 0.0 || ignoring < 0.0 || human > 1.0 || ignoring > 1.0 || human + ignoring <= 1.0 + 1e-9) return;
    add(extended(path, "human_share"),
        "is " + number_text(human) + ", must be within [0, 1 - ignoring_share], [0, " + number_text(1.0 - ignoring) +
            "]",
        {extended(path, "ignoring_share")});
  }

  void links() {
    const Radio& radio = scenario_.radio();
    if (radio.has_uplink()) link(radio.uplink(), path_to({"radio", "uplink"}));
    if (radio.has_downlink()) link(radio.downlink(), path_to({"radio", "downlink"}));
    if (radio.has_vehicle_to_vehicle()) link(radio.vehicle_to_vehicle(), path_to({"radio", "vehicle_to_vehicle"}));
    if (radio.has_load() && !radio.vehicle_to_vehicle().has_path_loss() && !radio.uplink().has_path_loss()) {
      add(path_to({"radio", "load"}),
          "counts what stations hear of each other: give vehicle_to_vehicle or uplink a path_loss");
    }
    for (int i = 0; i < radio.outages_size(); ++i) {
      outage(radio.outages(i), extended(path_to({"radio"}), "outages", i));
    }
  }

  void outage(const Outage& said, const FieldPath& path) {
    if (said.to_s() <= said.from_s()) {
      add(extended(path, "to_s"),
          "is " + number_text(said.to_s()) + " s, must be after from_s, " + number_text(said.from_s()) + " s",
          {extended(path, "from_s")});
    }
    if (said.has_rsu() && static_cast<int>(said.rsu()) >= scenario_.rsus_size()) {
      add(extended(path, "rsu"), "is " + std::to_string(said.rsu()) + ", must be below " +
                                     std::to_string(scenario_.rsus_size()) + ", the number of RSUs");
    }
    const Area& area = said.area();
    const FieldPath area_path = extended(path, "area");
    if (area.x_max_m() < area.x_min_m()) below(area_path, "x_max_m", area.x_max_m(), "x_min_m", area.x_min_m());
    if (area.y_max_m() < area.y_min_m()) below(area_path, "y_max_m", area.y_max_m(), "y_min_m", area.y_min_m());
  }

  void below(const FieldPath& path, const char* upper, double upper_m, const char* lower, double lower_m) {
    add(extended(path, upper),
        "is " + number_text(upper_m) + " m, must not be below " + lower + ", " + number_text(lower_m) + " m",
        {extended(path, lower)});
  }

  void link(const Link& said, const FieldPath& path) {
    if (said.collisions() && !scenario_.radio().has_load()) {
      add(extended(path, "collisions"), "is true, but nothing counts the load: give radio.load={}");
    }
    const FieldPath latency = extended(path, "latency");
    one_latency(said.latency(), latency);
    const UniformLatency& uniform = said.latency().uniform();
    if (uniform.max_ms() < uniform.min_ms()) {
      at_least(extended(latency, "uniform"), "max_ms", uniform.max_ms(), "min_ms", uniform.min_ms());
    }
    const GammaLatency& gamma = said.latency().gamma();
    if (gamma.mean_ms() < gamma.min_ms()) {
      at_least(extended(latency, "gamma"), "mean_ms", gamma.mean_ms(), "min_ms", gamma.min_ms());
    }
    if (!said.loss().has_burst()) return;
    // With shorter bursts a loss would make the next one less likely: the model has no such links.
    const BurstLoss& burst = said.loss().burst();
    const FieldPath burst_path = extended(extended(path, "loss"), "burst");
    if (burst.rate() <= 0.0 || burst.rate() >= 1.0 || burst.mean_length() < 1.0) return;
    if (burst.mean_length() * (1.0 - burst.rate()) > 1.0 - 1e-9) return;
    add(extended(burst_path, "mean_length"),
        "is " + number_text(burst.mean_length()) + " steps, must be at least 1 / (1 - rate), " +
            number_text(1.0 / (1.0 - burst.rate())) + " steps: the length that independent losses have",
        {extended(burst_path, "rate")});
  }

  void at_least(const FieldPath& path, const char* upper, double upper_ms, const char* lower, double lower_ms) {
    add(extended(path, upper),
        "is " + number_text(upper_ms) + " ms, must be within [" + lower + ", 5000] ms, [" + number_text(lower_ms) +
            ", 5000] ms",
        {extended(path, lower)});
  }

  void one_latency(const Latency& latency, const FieldPath& path) {
    std::vector<FieldPath> given;
    std::vector<std::string> names;
    for (const char* arm : {"constant_ms", "uniform", "gamma"}) {
      if (!has(latency, Latency::descriptor()->FindFieldByName(arm))) continue;
      given.push_back(extended(path, arm));
      names.emplace_back(arm);
    }
    if (given.size() < 2) return;
    findings_.push_back(
        {given.back(), {}, text(path) + " has " + joined(names, " and ") + "; give one of them alone", ""});
  }

  const Scenario& scenario_;
  std::vector<Finding> findings_;
};

}  // namespace

std::vector<Finding> check(const Scenario& scenario) { return Checker(scenario).run(); }

}  // namespace lukou::scenario
