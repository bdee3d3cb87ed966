#include "services/lukou/study/measure.hpp"

#include <array>
#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>

#include "services/recorder/summary.hpp"

namespace lukou::studies {
namespace {

using Json = nlohmann::ordered_json;

/// Words of the field where the key alone would not do.
constexpr std::array<std::pair<std::string_view, std::string_view>, 9> kLabels = {
    {{"mean_delay_all_s", "mean delay of all that arrived"},
     {"mean_delta_s", "mean delta at the stop line"},
     {"stops_per_vehicle", "stops per vehicle"},
     {"mean_fuel_ml", "fuel per vehicle"},
     {"mean_fuel_standing_ml", "fuel per vehicle, standing"},
     {"mean_queue_veh", "mean queue per lane"},
     {"mean_abs_acceleration_mps2", "mean size of the acceleration"},
     {"throughput_veh_per_h", "throughput per approach"},
     {"throughput_intersection_veh_per_h", "throughput"}}};

/// Endings of a key that are its unit, the longer ones first.
constexpr std::array<std::pair<std::string_view, std::string_view>, 9> kUnits = {{{"_veh_per_h", "veh/h"},
                                                                                  {"_mps2", "m/s²"},
                                                                                  {"_mps", "m/s"},
                                                                                  {"_veh", "veh"},
                                                                                  {"_ml", "ml"},
                                                                                  {"_kg", "kg"},
                                                                                  {"_s", "s"},
                                                                                  {"_m", "m"},
                                                                                  {"_l", "l"}}};

constexpr std::array<std::string_view, 8> kMoreIsBetter = {"throughput",          "vehicles_entered", "vehicles_left",
                                                           "cars_measured",       "advice_applied",   "ttc_min_s",
                                                           "min_head_distance_m", "requests_accepted"};

void collect(const Json& json, const std::string& prefix, std::vector<std::string>& paths) {
  for (const auto& [key, value] : json.items()) {
    if (value.is_object()) {
      collect(value, prefix + key + ".", paths);
    } else {
      paths.push_back(prefix + key);
    }
  }
}

}  // namespace

Measure measure_of(const std::string& path) {
  const std::size_t dot = path.rfind('.');
  const std::string group = dot == std::string::npos ? "" : path.substr(0, dot);
  const std::string key = dot == std::string::npos ? path : path.substr(dot + 1);
  Measure measure{.path = path, .label = key, .unit = {}};
  for (const auto& [ending, unit] : kUnits) {
    if (!key.ends_with(ending)) continue;
    measure.unit = unit;
    measure.label = key.substr(0, key.size() - ending.size());
    break;
  }
  for (char& letter : measure.label)
    if (letter == '_') letter = ' ';
  for (const auto& [known, label] : kLabels)
    if (key == known) measure.label = label;
  // "fuel.mean_fuel_ml" says it twice.
  if (!group.empty() && group != "fuel") measure.label += ", " + group;
  for (const std::string_view better : kMoreIsBetter)
    if (key.find(better) != std::string::npos) measure.less_is_better = false;
  return measure;
}

std::vector<std::string> known_measures() {
  // A summary with every part that some run has.
  RunFigures figures;
  figures.advice_by_kind.fill(1);
  SummaryExtras extras;
  extras.safety.emplace();
  extras.requests.emplace();
  extras.deadline_misses = 0;
  std::vector<std::string> paths;
  collect(Json::parse(summary_json(figures, 0, 0.0, true, extras)), "", paths);
  paths.emplace_back(kSettlingTime);
  return paths;
}

std::vector<std::string> default_measures() {
  return {"mean_stop_time_s", "stops_per_vehicle", "mean_delay_s", "mean_delay_all_s", "fuel.mean_fuel_ml"};
}

std::optional<double> value_of(const Json& summary, const std::string& path) {
  const Json* here = &summary;
  for (std::size_t from = 0; from <= path.size();) {
    const std::size_t to = std::min(path.find('.', from), path.size());
    const auto next = here->is_object() ? here->find(path.substr(from, to - from)) : here->end();
    if (!here->is_object() || next == here->end()) return std::nullopt;
    here = &*next;
    from = to + 1;
  }
  if (!here->is_number()) return std::nullopt;
  return here->get<double>();
}

std::string title(const Measure& measure) {
  return measure.unit.empty() ? measure.label : measure.label + " [" + measure.unit + "]";
}

}  // namespace lukou::studies
