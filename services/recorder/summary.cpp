#include "services/recorder/summary.hpp"

#include <nlohmann/json.hpp>
#include <utility>

#include "common/results/json.hpp"

namespace lukou {
namespace {

using Json = nlohmann::ordered_json;

Json number(const std::optional<double>& value) { return value ? Json(*value) : Json(nullptr); }

Json group_json(const GroupFigures& group) {
  return {{"cars_measured", group.cars},
          {"vehicles_arrived", group.vehicles_arrived},
          {"vehicles_entered", group.vehicles_entered},
          {"vehicles_left", group.vehicles_left},
          {"vehicles_waiting", group.vehicles_waiting},
          {"throughput_veh_per_h", number(group.throughput_veh_per_h)},
          {"throughput_intersection_veh_per_h", number(group.throughput_intersection_veh_per_h)},
          {"mean_delta_s", number(group.mean_delta_s)},
          {"mean_delay_s", number(group.mean_delay_s)},
          {"cars_arrived", group.cars_arrived},
          {"mean_delay_all_s", number(group.mean_delay_all_s)},
          {"mean_entry_wait_s", number(group.mean_entry_wait_s)},
          {"mean_stop_time_s", number(group.mean_stop_time_s)},
          {"stops_per_vehicle", number(group.stops_per_vehicle)},
          {"mean_queue_veh", number(group.mean_queue_veh)},
          {"mean_abs_acceleration_mps2", number(group.mean_abs_acceleration_mps2)}};
}

constexpr std::pair<AdviceFate, const char*> kRefused[] = {{AdviceFate::kPastStopLine, "past_stop_line"},
                                                           {AdviceFate::kExpired, "expired"},
                                                           {AdviceFate::kSuperseded, "superseded"},
                                                           {AdviceFate::kUnknownVehicle, "unknown_vehicle"},
                                                           {AdviceFate::kMalformed, "malformed"},
                                                           {AdviceFate::kOutOfLimit, "limit"},
                                                           {AdviceFate::kLate, "late"},
                                                           {AdviceFate::kNotComplied, "not_complied"}};
constexpr std::pair<AdviceFate, const char*> kLost[] = {
    {AdviceFate::kLostRandom, "random"},       {AdviceFate::kLostBurst, "burst"},
    {AdviceFate::kLostRange, "range"},         {AdviceFate::kLostPathLoss, "path_loss"},
    {AdviceFate::kLostCollision, "collision"}, {AdviceFate::kLostHalfDuplex, "half_duplex"},
    {AdviceFate::kLostOutage, "outage"}};
constexpr std::pair<AdviceFate, const char*> kDropped[] = {{AdviceFate::kStale, "stale"},
                                                           {AdviceFate::kDuplicate, "duplicate"}};
constexpr std::pair<AdviceFate, const char*> kChanged[] = {{AdviceFate::kChangedLimit, "limit"},
                                                           {AdviceFate::kChangedGuard, "guard"},
                                                           {AdviceFate::kChangedFollowing, "following"},
                                                           {AdviceFate::kChangedRed, "red"},
                                                           {AdviceFate::kChangedDriver, "driver"}};

template <std::size_t N>
Json fates_json(const RunFigures& figures, const std::pair<AdviceFate, const char*> (&fates)[N]) {
  Json json;
  std::uint64_t total = 0;
  for (const auto& [fate, name] : fates) total += figures.advice(fate);
  json["total"] = total;
  for (const auto& [fate, name] : fates) json[name] = figures.advice(fate);
  return json;
}

Json requests_json(const RequestFigures& requests) {
  return {{"requests", requests.asked},
          {"requests_accepted", requests.followed},
          {"requests_deferred", {{"min_green", requests.count(RequestOutcome::kMinGreen)}}},
          {"requests_overruled", {{"max_wait", requests.count(RequestOutcome::kMaxWait)}}},
          {"requests_refused",
           {{"total", requests.refused()},
            {"conflict", requests.count(RequestOutcome::kConflict)},
            {"malformed", requests.count(RequestOutcome::kMalformed)},
            {"other_rsu", requests.count(RequestOutcome::kOtherRsu)},
            {"fixed_plan", requests.fixed_plan}}}};
}

Json safety_json(const SafetyCounts& counts) {
  return {{"driven_s", static_cast<double>(counts.driven_steps) / static_cast<double>(kStepsPerSecond)},
          {"ttc", counts.count(SafetyKind::kTtc)},
          {"ttc_critical", counts.ttc_critical},
          {"ttc_min_s", number(counts.ttc_min_s)},
          {"mttc", counts.count(SafetyKind::kMttc)},
          {"drac", counts.count(SafetyKind::kDrac)},
          {"drac_critical", counts.drac_critical},
          {"hard_braking", counts.count(SafetyKind::kHardBraking)},
          {"jerk", counts.count(SafetyKind::kJerk)},
          {"pet", counts.count(SafetyKind::kPet)},
          {"pet_both_inside", counts.pet_both_inside}};
}

Json safety_json(const SafetyFigures& figures) {
  Json json = safety_json(figures.all);
  json["equipped"] = safety_json(figures.equipped);
  json["unequipped"] = safety_json(figures.unequipped);
  json["guided"] = safety_json(figures.guided);
  json["opposed_lefts"] = {{"pet", figures.opposed_lefts}, {"pet_both_inside", figures.opposed_lefts_both_inside}};
  return json;
}

Json fuel_json(const GroupFigures& group) {
  constexpr double kMl_per_l = 1000.0;
  const double fuel_l = group.fuel.fuel_ml / kMl_per_l;
  return {{"fuel_l", fuel_l},
          {"standing_l", group.fuel.standing_ml / kMl_per_l},
          {"accelerating_l", group.fuel.accelerating_ml / kMl_per_l},
          {"co2_kg", fuel_l * kCo2_kg_per_l},
          {"mean_fuel_ml", number(group.mean_fuel_ml)},
          {"mean_fuel_standing_ml", number(group.mean_fuel_standing_ml)},
          {"check_fuel_l", group.fuel.check_ml / kMl_per_l}};
}

}  // namespace

std::string summary_json(const RunFigures& figures, Step complete_to, double warmup_s, bool radio_modelled,
                         const SummaryExtras& extras) {
  Json json = {{"simulated_s", time_s(complete_to)}, {"warmup_s", warmup_s}};
  json.update(group_json(figures.all));
  json["equipped"] = group_json(figures.equipped);
  json["unequipped"] = group_json(figures.unequipped);
  json["stops_total"] = figures.stops_total;
  for (std::size_t cause = 0; cause < kStopCauses; ++cause) {
    json["stops_by_cause"][std::string(kStopCauseNames[cause])] = figures.stops_by_cause[cause];
  }
  json["advice_sent"] = figures.advice_sent;
  const auto of_kind = [&](AdviceKind kind) { return figures.advice_by_kind[static_cast<std::size_t>(kind)]; };
  const std::uint64_t others =
      of_kind(AdviceKind::kProfile) + of_kind(AdviceKind::kSpeed) + of_kind(AdviceKind::kLaneSpeed);
  for (std::size_t kind = 0; others > 0 && kind < kAdviceKinds; ++kind) {
    json["advice_by_kind"][std::string(name(static_cast<AdviceKind>(kind)))] = figures.advice_by_kind[kind];
  }
  json["advice_applied"] = figures.advice(AdviceFate::kApplied);
  json["advice_refused"] = fates_json(figures, kRefused);
  json["advice_changed"] = fates_json(figures, kChanged);
  if (radio_modelled) {
    json["advice_lost"] = fates_json(figures, kLost);
    json["advice_dropped"] = fates_json(figures, kDropped);
  }
  if (extras.requests) json["signals"] = requests_json(*extras.requests);
  if (extras.deadline_misses) json["rsu_deadline_misses"] = *extras.deadline_misses;
  json["guard_interventions"] = figures.guard_interventions;
  json["collisions"] = figures.collisions;
  json["reversals"] = figures.reversals;
  json["red_crossings"] = figures.red_crossings;
  json["min_head_distance_m"] = number(figures.min_head_distance_m);
  if (extras.safety) json["safety"] = safety_json(*extras.safety);
  json["fuel"] = fuel_json(figures.all);
  json["fuel"]["equipped"] = fuel_json(figures.equipped);
  json["fuel"]["unequipped"] = fuel_json(figures.unequipped);
  return results::json_text(json);
}

}  // namespace lukou
