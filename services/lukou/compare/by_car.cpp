#include "services/lukou/compare/by_car.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <string_view>
#include <utility>

#include "common/core/contract.hpp"
#include "common/results/tables.hpp"
#include "scenario.pb.h"
#include "services/lukou/report/result.hpp"
#include "services/lukou/report/table_rows.hpp"

namespace lukou::compare {
namespace {

namespace fs = std::filesystem;

/// Measures of the summary, and the column of car.csv that they are the mean of.
constexpr std::array<std::pair<std::string_view, std::string_view>, 6> kColumns = {
    {{"mean_stop_time_s", "stop_time_s"},
     {"mean_delay_s", "delay_s"},
     {"mean_delta_s", "delta_s"},
     {"stops_per_vehicle", "stops"},
     {"fuel.mean_fuel_ml", "fuel_ml"},
     {"fuel.mean_fuel_standing_ml", "fuel_standing_ml"}}};

struct Car {
  double entered_s = 0.0;
  double value = 0.0;
};

Expected<std::map<std::int64_t, Car>> cars_of(const report::Result& result, std::string_view column) {
  const auto table = result.table(results::kCarTable, "");
  if (!table) return table.error();
  std::map<std::int64_t, Car> cars;
  const auto read =
      report::for_each_row(table.value(), {"vehicle", "entered_s", column},
                           [&](const report::TableRow& row) { cars[row.whole(0)] = {row.real(1), row.real(2)}; });
  if (!read) return read.error();
  return cars;
}

struct Sum {
  double a = 0.0;
  double b = 0.0;
  std::size_t cars = 0;
};

}  // namespace

bool is_of_cars(const std::string& measure) {
  return std::ranges::find(kColumns, measure, [](const auto& known) { return known.first; }) != kColumns.end();
}

double lag_one_correlation(const std::vector<double>& series) {
  const double n = static_cast<double>(series.size());
  const double mean = std::accumulate(series.begin(), series.end(), 0.0) / std::max(n, 1.0);
  double products = 0.0;
  double squares = 0.0;
  for (std::size_t i = 0; i < series.size(); ++i) {
    squares += (series[i] - mean) * (series[i] - mean);
    if (i > 0) products += (series[i] - mean) * (series[i - 1] - mean);
  }
  return squares > 0.0 ? products / squares : 0.0;
}

bool Batches::independent() const {
  return lag_one < 1.645 / std::sqrt(static_cast<double>(std::max<std::size_t>(1, pairs.arm.size())));
}

Expected<Batches> batches_of(const fs::path& a, const fs::path& b, const std::string& measure) {
  const auto known = std::ranges::find(kColumns, measure, [](const auto& entry) { return entry.first; });
  LUKOU_EXPECT(known != kColumns.end());
  const auto run_a = report::Result::open(a);
  if (!run_a) return run_a.error();
  const auto run_b = report::Result::open(b);
  if (!run_b) return run_b.error();
  const auto cars_a = cars_of(run_a.value(), known->second);
  if (!cars_a) return cars_a.error();
  const auto cars_b = cars_of(run_b.value(), known->second);
  if (!cars_b) return cars_b.error();
  const auto plan = scenario::signal_plan(run_b.value().scenario());
  if (!plan) return plan.error();

  const auto& run = run_b.value().scenario().message().run();
  const double cycle_s = time_s(plan.value().cycle);
  const double span_s = std::max(0.0, run.duration_s() - run.warmup_s());
  Batches batches;
  batches.length_s = cycle_s * std::max(1.0, std::floor(span_s / cycle_s / static_cast<double>(kBatchesAim)));
  std::map<std::int64_t, Sum> sums;
  for (const auto& [vehicle, car_b] : cars_b.value()) {
    const auto car_a = cars_a.value().find(vehicle);
    // A car belongs to the batch of its arrival in B, in both runs.
    if (car_a == cars_a.value().end() || car_b.entered_s < run.warmup_s()) continue;
    const auto number = static_cast<std::int64_t>((car_b.entered_s - run.warmup_s()) / batches.length_s);
    if (static_cast<double>(number + 1) * batches.length_s > span_s) continue;  // the end cuts its batch short
    Sum& sum = sums[number];
    sum.a += car_a->second.value;
    sum.b += car_b.value;
    ++sum.cars;
    ++batches.cars;
  }
  std::vector<double> differences;
  for (const auto& [number, sum] : sums) {
    const double cars = static_cast<double>(sum.cars);
    batches.pairs.arm.push_back(sum.a / cars);
    batches.pairs.baseline.push_back(sum.b / cars);
    differences.push_back((sum.a - sum.b) / cars);
  }
  batches.lag_one = lag_one_correlation(differences);
  return batches;
}

}  // namespace lukou::compare
