// What the cars have burnt: on what, and how it is distributed.

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "common/results/tables.hpp"
#include "services/lukou/report/plots/plot.hpp"
#include "services/lukou/report/plots/series.hpp"
#include "services/lukou/report/table_rows.hpp"

namespace lukou::report {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kGroups = 3;  ///< all, equipped, unequipped
const std::array<const Words*, kGroups> kNames = {&says::kAll, &says::kEquipped, &says::kUnequipped};
constexpr std::array<int, kGroups> kLooks = {6, 0, 1};
constexpr int kBins = 40;

/// Litres of a group since the start, and per car that has entered.
struct Burnt {
  double cars = 0.0;
  double standing_l = 0.0;
  double accelerating_l = 0.0;
  double driving_l = 0.0;  ///< the rest
  double check_l = 0.0;    ///< all of it by the other model
};

struct Fuel {
  std::array<Burnt, kGroups> groups;
  std::array<std::vector<double>, kGroups> per_car_ml;
};

Burnt burnt_of(const Json& fuel, double cars) {
  Burnt burnt{.cars = cars,
              .standing_l = fuel.value("standing_l", 0.0),
              .accelerating_l = fuel.value("accelerating_l", 0.0),
              .check_l = fuel.value("check_fuel_l", 0.0)};
  burnt.driving_l = fuel.value("fuel_l", 0.0) - burnt.standing_l - burnt.accelerating_l;
  return burnt;
}

figure::Figure parts(const Fuel& fuel, Language language) {
  figure::Figure figure;
  figure.title = Words{"Fuel per car, and what it went on", "每辆车的燃油及其用途"}.in(language);
  figure.subtitle =
      Words{"by the model of Kamal et al., all cars since the start", "Kamal 等人的模型，自仿真开始的全部车辆"}.in(
          language);
  figure.y = {.label = Words{"fuel per car that entered", "每辆驶入车辆的燃油"}.in(language), .unit = "mL", .min = 0.0};
  figure::Bars driving{.name = Words{"driving", "行驶"}.in(language), .bars = {}, .width = 0.5, .look = 0};
  figure::Bars accelerating{.name = Words{"accelerating", "加速"}.in(language), .bars = {}, .width = 0.5, .look = 4};
  figure::Bars standing{.name = Words{"standing", "停车"}.in(language), .bars = {}, .width = 0.5, .look = 1};
  figure::Scatter check{.name = Words{"all, by VT-CPFM", "合计，VT-CPFM"}.in(language), .points = {}, .look = 6};
  for (std::size_t group = 0; group < kGroups; ++group) {
    const Burnt& burnt = fuel.groups[group];
    if (burnt.cars <= 0.0) continue;
    const auto at = static_cast<double>(figure.x.names.size());
    figure.x.names.push_back(kNames[group]->in(language));
    const double per_car_ml = 1000.0 / burnt.cars;
    double from = 0.0;
    const auto stack = [&](figure::Bars& bars, double litres) {
      bars.bars.push_back({at, from, from + litres * per_car_ml});
      from += litres * per_car_ml;
    };
    stack(driving, burnt.driving_l);
    stack(accelerating, burnt.accelerating_l);
    stack(standing, burnt.standing_l);
    check.points.push_back({at, burnt.check_l * per_car_ml});
  }
  figure.layers = {std::move(driving), std::move(accelerating), std::move(standing), std::move(check)};
  return figure;
}

figure::Figure distribution(const Fuel& fuel, Language language) {
  figure::Figure figure;
  figure.title = Words{"Fuel of a car, entrance to exit", "单车燃油（入口至出口）"}.in(language);
  figure.subtitle = Words{"cars that entered after the warm-up", "预热结束后驶入的车辆"}.in(language);
  figure.x = {.label = Words{"fuel", "燃油"}.in(language), .unit = "mL"};
  figure.y = {.label = Words{"share of cars", "车辆比例"}.in(language), .unit = {}, .min = 0.0};
  const Histogram bins = histogram(fuel.per_car_ml[0], kBins);
  figure.x.min = bins.from;
  figure.x.max = bins.to();
  for (std::size_t group = 1; group < kGroups; ++group) {
    const std::vector<double>& values = fuel.per_car_ml[group];
    if (values.empty()) continue;
    figure.layers.push_back(figure::Line{
        .name = kNames[group]->in(language) + Words{", mean ", "，均值 "}.in(language) + fixed(mean(values), 1) + " mL",
        .points = histogram_like(values, bins).outline(values.size()),
        .look = kLooks[group],
        .steps = true});
  }
  return figure;
}

}  // namespace

Expected<Drawing> draw_fuel(const Result& result, const PlotOptions& /*options*/) {
  const auto summary = result.need_summary();
  if (!summary) return summary.error();
  const Json& json = *summary.value();
  if (!json.contains("fuel")) return Error{result.folder().string(), "has no fuel in its summary: an older run"};
  Fuel fuel;
  const Json& burnt = json["fuel"];
  fuel.groups[0] = burnt_of(burnt, json.value("vehicles_entered", 0.0));
  for (const auto& [group, key] : {std::pair{1, "equipped"}, std::pair{2, "unequipped"}}) {
    fuel.groups[static_cast<std::size_t>(group)] = burnt_of(burnt[key], json[key].value("vehicles_entered", 0.0));
  }
  const auto table = result.table(results::kCarTable, "(always)");
  if (!table) return table.error();
  const double from_s = warmup_s(result);
  const auto read = for_each_row(table.value(), {"equipped", "entered_s", "fuel_ml"}, [&](const TableRow& row) {
    if (row.real(1) < from_s) return;
    fuel.per_car_ml[0].push_back(row.real(2));
    fuel.per_car_ml[row.whole(0) != 0 ? 1 : 2].push_back(row.real(2));
  });
  if (!read) return read.error();
  return Drawing([fuel = std::move(fuel)](Language language) {
    Panels panels{.figures = {parts(fuel, language)}};
    if (!fuel.per_car_ml[0].empty()) panels.figures.push_back(distribution(fuel, language));
    return panels;
  });
}

}  // namespace lukou::report
