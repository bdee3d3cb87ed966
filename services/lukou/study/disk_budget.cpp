#include "services/lukou/study/disk_budget.hpp"

#include <algorithm>
#include <filesystem>
#include <map>

#include "common/results/event_tables.hpp"
#include "common/results/radio_table.hpp"
#include "common/results/tables.hpp"
#include "scenario.pb.h"
#include "services/lukou/study/number_text.hpp"

namespace lukou::studies {
namespace {

// Bytes, measured with `lukou run paper --duration 3600` and with record.guidance, and rounded up.
constexpr double kAlways =
    30'000.0;  ///< summary, manifest, scenario, series and log, in whole blocks of the file system
constexpr double kStopPerStep = 75.0;
constexpr double kRoadPerStep = 80.0;
constexpr double kStopTimePerStep = 115.0;
constexpr double kRadioPerStep = 50.0;
constexpr double kCarPerCar = 110.0;
constexpr double kStopsPerCar = 80.0;
constexpr double kSafetyPerCar = 350.0;
constexpr double kRequestsPerStep = 30.0;
constexpr double kGuidancePerEquipped = 25'000.0;

/// Arrivals of the whole run, roughly.
double cars_of(const scenario::Scenario& scenario) {
  constexpr double kUnknown_veh_per_h = 1800.0;  // of a trace
  double flow_veh_per_h = 0.0;
  const auto& traffic = scenario.traffic();
  for (const scenario::Demand* demand : {&traffic.west(), &traffic.south(), &traffic.east(), &traffic.north()}) {
    double peak = demand->has_flow_veh_per_h() ? demand->flow_veh_per_h() : 0.0;
    for (const auto& point : demand->flow_series()) peak = std::max(peak, point.flow_veh_per_h());
    flow_veh_per_h += demand->has_arrivals_csv() ? kUnknown_veh_per_h : peak;
  }
  return flow_veh_per_h * scenario.run().duration_s() / 3600.0;
}

std::map<std::string, double> bytes_by_table(const scenario::Scenario& scenario) {
  const double steps = scenario.run().duration_s() * static_cast<double>(kStepsPerSecond);
  const double cars = cars_of(scenario);
  return {{results::kStopTable, kStopPerStep * steps},
          {results::kRoadTable, kRoadPerStep * steps},
          {results::kStopTimeTable, kStopTimePerStep * steps},
          {results::kRadioTable, kRadioPerStep * steps},
          {results::kCarTable, kCarPerCar * cars},
          {results::kStopsTable, scenario.record().stops() ? kStopsPerCar * cars : 0.0},
          {results::kSafetyTable, scenario.record().safety() ? kSafetyPerCar * cars : 0.0},
          {results::kRequestsTable, scenario.signals().has_actuation() ? kRequestsPerStep * steps : 0.0},
          {results::kGuidanceTable,
           scenario.record().guidance() ? kGuidancePerEquipped * cars * scenario.vehicles().equipped_ratio() : 0.0}};
}

std::string size_text(double bytes) {
  return bytes < 1e9 ? fixed(bytes / 1e6, bytes < 1e7 ? 1 : 0) + " MB" : fixed(bytes / 1e9, 1) + " GB";
}

}  // namespace

DiskNeed disk_need(const Study& study, const Plan& plan, const std::vector<RunKey>& runs, int jobs) {
  DiskNeed need;
  std::map<std::size_t, std::pair<double, double>> of_point;  ///< kept, at work
  double largest = 0.0;
  for (const RunKey& run : runs) {
    const auto [at, fresh] = of_point.try_emplace(run.point, 0.0, 0.0);
    if (fresh) {
      const auto scenario = scenario_of(study, plan.points[run.point], run.seed);
      if (!scenario) continue;
      const bool all = std::ranges::find(study.keep, "*") != study.keep.end();
      at->second.first = kAlways;
      for (const auto& [table, bytes] : bytes_by_table(scenario.value().message())) {
        at->second.second += bytes;
        if (all || std::ranges::find(study.keep, table) != study.keep.end()) at->second.first += bytes;
      }
    }
    need.kept += at->second.first;
    largest = std::max(largest, at->second.second);
  }
  need.at_work = largest * static_cast<double>(std::min<std::size_t>(runs.size(), static_cast<std::size_t>(jobs)));
  return need;
}

Expected<Done> check_disk(const StudyFolder& folder, const std::vector<RunKey>& runs, int jobs, std::string& said) {
  const DiskNeed need = disk_need(folder.study(), folder.plan(), runs, jobs);
  std::error_code code;
  const auto space = std::filesystem::space(folder.path(), code);
  if (code) return Error{folder.path().string(), "its room cannot be told: " + code.message()};
  const auto room = static_cast<double>(space.available);
  said = "needs about " + size_text(need.total()) + " of disk (" + size_text(need.kept) + " to keep, " +
         size_text(need.at_work) + " for runs at work, by bytes a step and a car), has " + size_text(room);
  if (need.total() <= room) return Done{};
  return Error{folder.path().string(), said + "; keep fewer tables (`keep`), or give another --out"};
}

}  // namespace lukou::studies
