#include "services/lukou/report/summary_text.hpp"

#include <cstdio>
#include <deque>
#include <fstream>
#include <nlohmann/json.hpp>

namespace lukou::report {
namespace {

using Json = nlohmann::ordered_json;

Json load(const std::filesystem::path& file) {
  std::ifstream stream(file);
  return Json::parse(stream, nullptr, false);
}

std::string cell(const Json& value) {
  if (value.is_null()) return "-";
  char text[32];
  if (value.is_number_float()) {
    std::snprintf(text, sizeof text, "%.2f", value.get<double>());
  } else {
    std::snprintf(text, sizeof text, "%lld", value.get<long long>());
  }
  return text;
}

struct Row {
  const char* key;
  const char* label;
};
constexpr Row kRows[] = {{"vehicles_entered", "vehicles entered"},
                         {"vehicles_left", "vehicles left"},
                         {"throughput_veh_per_h", "throughput per approach [veh/h]"},
                         {"mean_delay_s", "mean delay [s]"},
                         {"mean_delta_s", "mean delta at the stop line [s]"},
                         {"mean_stop_time_s", "mean stop time [s]"},
                         {"stops_per_vehicle", "stops per vehicle"},
                         {"mean_queue_veh", "mean queue per lane [veh]"}};

/// "stops: 912, of these 700 unequipped, 212 queue_ahead"
std::string stops_text(const Json& summary) {
  std::string text = "stops: " + cell(summary["stops_total"]);
  const char* between = ", of these ";
  for (const auto& [cause, count] : summary["stops_by_cause"].items()) {
    if (count == 0) continue;
    text += between + cell(count) + " " + cause;
    between = ", ";
  }
  return text + "\n";
}

/// "requests: 900 asked, 880 accepted (12 deferred by min_green, 3 overruled by max_wait), 20 refused: 20 conflict"
std::string requests_text(const Json& signals) {
  std::string text = "requests: " + cell(signals["requests"]) + " asked, " + cell(signals["requests_accepted"]) +
                     " accepted (" + cell(signals["requests_deferred"]["min_green"]) + " deferred by min_green, " +
                     cell(signals["requests_overruled"]["max_wait"]) + " overruled by max_wait), " +
                     cell(signals["requests_refused"]["total"]) + " refused";
  const char* between = ": ";
  for (const auto& [rule, count] : signals["requests_refused"].items()) {
    if (rule == "total" || count == 0) continue;
    text += between + cell(count) + " " + rule;
    between = ", ";
  }
  return text + "\n";
}

/// "encounters: 812 TTC < 3 s (20 < 1.5 s), 40 DRAC >= 3 m/s2, ...; with guidance in force ...; opposed lefts apart: 9"
std::string encounters_text(const Json& safety) {
  return "encounters: " + cell(safety["ttc"]) + " TTC < 3 s (" + cell(safety["ttc_critical"]) + " < 1.5 s), " +
         cell(safety["drac"]) + " DRAC >= 3 m/s2, " + cell(safety["hard_braking"]) + " hard brakings, " +
         cell(safety["pet"]) + " PET < 2 s; with guidance in force " + cell(safety["guided"]["ttc"]) +
         " TTC; opposed lefts, apart: " + cell(safety["opposed_lefts"]["pet"]) + " PET\n";
}

/// "fuel: 512.33 l (101.20 standing, 190.02 to accelerate), 61.20 ml per vehicle, 1202.81 kg CO2; VT-CPFM: 800.10 l"
std::string fuel_text(const Json& fuel) {
  return "fuel: " + cell(fuel["fuel_l"]) + " l (" + cell(fuel["standing_l"]) + " standing, " +
         cell(fuel["accelerating_l"]) + " to accelerate), " + cell(fuel["mean_fuel_ml"]) + " ml per vehicle, " +
         cell(fuel["co2_kg"]) + " kg CO2; VT-CPFM: " + cell(fuel["check_fuel_l"]) + " l\n";
}

}  // namespace

std::string summary_text(const launch::RunReport& report) {
  char line[160];
  std::snprintf(line, sizeof line, "%s after %.1f s simulated in %.2f s (%.0f steps/s, %.0fx real time)\n",
                report.ended.c_str(), static_cast<double>(report.steps) / 10.0, report.wall_s,
                report.wall_s > 0.0 ? static_cast<double>(report.steps) / report.wall_s : 0.0,
                report.wall_s > 0.0 ? static_cast<double>(report.steps) / 10.0 / report.wall_s : 0.0);
  std::string text = line;
  const Json summary = load(report.folder / "summary.json");
  if (summary.is_object()) {
    std::snprintf(line, sizeof line, "%-34s %10s %10s %10s\n", "", "all", "equipped", "unequipped");
    text += line;
    for (const Row& row : kRows) {
      std::snprintf(line, sizeof line, "%-34s %10s %10s %10s\n", row.label, cell(summary[row.key]).c_str(),
                    cell(summary["equipped"][row.key]).c_str(), cell(summary["unequipped"][row.key]).c_str());
      text += line;
    }
    text += "advice: " + cell(summary["advice_sent"]) + " sent, " + cell(summary["advice_applied"]) + " applied, " +
            cell(summary["advice_changed"]["total"]) + " changed by a rule, " +
            cell(summary["advice_refused"]["total"]) + " refused";
    if (summary.contains("advice_lost")) {
      text += ", " + cell(summary["advice_lost"]["total"]) + " lost on the air, " +
              cell(summary["advice_dropped"]["total"]) + " stale or heard twice";
    }
    text += "\n";
    if (summary.contains("signals")) text += requests_text(summary["signals"]);
    if (summary.contains("rsu_deadline_misses")) {
      text += "computing: " + cell(summary["rsu_deadline_misses"]) + " steps took an RSU longer than 0.1 s\n";
    }
    if (summary.contains("stops_by_cause")) text += stops_text(summary);
    text += "safety: " + cell(summary["collisions"]) + " collisions, " + cell(summary["reversals"]) + " reversals, " +
            cell(summary["red_crossings"]) + " crossings on red (cars that could not stop), least head distance " +
            cell(summary["min_head_distance_m"]) + " m\n";
    if (summary.contains("safety")) text += encounters_text(summary["safety"]);
    if (summary.contains("fuel")) text += fuel_text(summary["fuel"]);
    if (summary["mean_delay_s"].is_null()) {
      text += "(no means: no car entered after the warm-up of " + cell(summary["warmup_s"]) + " s and crossed)\n";
    }
  }
  return text + "results: " + report.folder.string() + "\n";
}

std::string last_words(const launch::RunReport& report) {
  constexpr std::size_t kLines = 5;
  std::ifstream log(report.folder / "operator.log");
  std::deque<std::string> lines;
  for (std::string line; std::getline(log, line);) {
    lines.push_back(line);
    if (lines.size() > kLines) lines.pop_front();
  }
  std::string text;
  for (const std::string& line : lines) text += "  " + line + "\n";
  return text.empty() ? "" : "operator.log ends with:\n" + text;
}

std::string summary_json(const launch::RunReport& report) {
  Json json = {{"exit_code", report.exit_code}, {"ended", report.ended}, {"folder", report.folder.string()}};
  for (const char* name : {"timing", "summary"}) {
    const Json content = load(report.folder / (std::string(name) + ".json"));
    json[name] = content.is_object() ? content : Json(nullptr);
  }
  return json.dump() + "\n";
}

}  // namespace lukou::report
