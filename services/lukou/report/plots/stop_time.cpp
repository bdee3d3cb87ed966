// The paper's figure 6: the running mean of the stop time.

#include <cmath>

#include "common/core/step.hpp"
#include "common/measures/settling.hpp"
#include "common/results/tables.hpp"
#include "services/lukou/report/plots/plot.hpp"
#include "services/lukou/report/plots/series.hpp"
#include "services/lukou/report/table_rows.hpp"

namespace lukou::report {
namespace {

constexpr double kShare = 0.05;

struct RunningMean {
  std::vector<figure::Point> points;
  double last_s = 0.0;
  std::optional<double> settled_s;  ///< empty: not before the end of the run
  double warmup_s = 0.0;
  Window window;
};

Words settled_name(const RunningMean& mean) {
  if (!mean.settled_s) return {"has not settled", "尚未进入稳态"};
  const std::string at = fixed(*mean.settled_s, 0);
  return {"within 5 % of its last value from " + at + " s on", "自 " + at + " 秒起与终值相差 5% 以内"};
}

Panels panels_of(const RunningMean& mean, Language language) {
  figure::Figure figure;
  figure.title = Words{"Mean stop time", "平均停车时间"}.in(language);
  figure.subtitle = Words{"seconds stood by all cars since the start, over the cars that have entered",
                          "自仿真开始全部车辆的停车时间之和除以已驶入的车辆数"}
                        .in(language);
  figure.x = {.label = says::kTime.in(language), .unit = "s", .min = mean.window.from_s, .max = mean.window.to_s};
  figure.y = {.label = Words{"stop time per car", "每辆车的停车时间"}.in(language), .unit = "s", .min = 0.0};
  const double reach_s = kShare * mean.last_s;
  figure.layers.push_back(
      figure::Boxes{.name = Words{"last value ± 5 %", "终值 ± 5%"}.in(language),
                    .boxes = {{mean.window.from_s, mean.window.to_s, mean.last_s - reach_s, mean.last_s + reach_s}},
                    .colour = figure::kFaint});
  figure.layers.push_back(figure::Line{
      .name = Words{"running mean, at the end ", "累计平均，终值 "}.in(language) + fixed(mean.last_s, 2) + " s",
      .points = mean.points});
  if (mean.window.holds(mean.warmup_s) && mean.warmup_s > 0.0) {
    figure.layers.push_back(figure::Rule{
        .name = says::kWarmup.in(language), .at = mean.warmup_s, .vertical = true, .colour = figure::kGrey});
  }
  if (mean.settled_s && mean.window.holds(*mean.settled_s)) {
    figure.layers.push_back(figure::Rule{.name = settled_name(mean).in(language),
                                         .at = *mean.settled_s,
                                         .vertical = true,
                                         .colour = figure::look_of(1).colour,
                                         .dashed = false});
  }
  figure.size = {120.0, 75.0};
  return {.figures = {std::move(figure)}, .columns = 1};
}

}  // namespace

Expected<Drawing> draw_stop_time(const Result& result, const PlotOptions& options) {
  const auto table = result.table(results::kStopTimeTable, "(always)");
  if (!table) return table.error();
  std::vector<double> series;
  const auto read =
      for_each_row(table.value(), {"mean_per_vehicle_s"}, [&](const TableRow& row) { series.push_back(row.real(0)); });
  if (!read) return read.error();
  const auto settled = settled_from(series, kShare);
  if (!settled) return Error{table.value().string(), "has no mean stop time: no car has entered"};

  RunningMean mean{.last_s = series.back(), .warmup_s = warmup_s(result), .window = whole_run(result, options)};
  // Row i is of step i + 1.
  const auto at_s = [](std::size_t row) { return time_s(static_cast<Step>(row) + 1); };
  if (*settled + 1 < series.size()) mean.settled_s = at_s(*settled);
  std::vector<figure::Point> points;
  for (std::size_t row = 0; row < series.size(); ++row) {
    if (std::isfinite(series[row]) && mean.window.holds(at_s(row))) points.push_back({at_s(row), series[row]});
  }
  mean.points = thinned(points);
  return Drawing([mean = std::move(mean)](Language language) { return panels_of(mean, language); });
}

}  // namespace lukou::report
