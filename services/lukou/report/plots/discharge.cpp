// How standing queues discharge: headways by place in the queue.

#include <algorithm>
#include <array>
#include <cmath>

#include "common/measures/discharge.hpp"
#include "common/results/tables.hpp"
#include "services/lukou/report/plots/plot.hpp"
#include "services/lukou/report/plots/series.hpp"
#include "services/lukou/report/plots/signals.hpp"
#include "services/lukou/report/table_rows.hpp"

namespace lukou::report {
namespace {

/// Places with fewer headways than this are left out: their means say nothing.
constexpr std::uint64_t kHeadwaysLeast = 3;

struct Queues {
  Discharge discharge;
  std::optional<Lane> lane;
};

/// With a minus as long as a figure.
std::string signed_text(double value) { return (value < 0.0 ? "\u2212" : "") + fixed(std::abs(value), 2); }

Panels panels_of(const Queues& queues, Language language) {
  figure::Figure figure;
  figure.title = Words{"Discharge headways", "消散车头时距"}.in(language);
  figure.subtitle = says::lanes(queues.lane, language) +
                    Words{"; mean and standard deviation over the greens; the first from the green's begin",
                          "；各次绿灯的均值与标准差；第一辆从绿灯起算"}
                        .in(language);
  figure.x = {.label = Words{"place in the queue", "排队位置"}.in(language), .unit = {}, .min = 0.5};
  figure.y = {.label = Words{"headway at the stop line", "停车线处车头时距"}.in(language), .unit = "s", .min = 0.0};
  figure::Line means{.name = Words{"mean headway", "平均车头时距"}.in(language), .points = {}, .markers = true};
  figure::Intervals spread;
  const auto& places = queues.discharge.places();
  for (std::size_t place = 0; place < places.size(); ++place) {
    if (places[place].headways < kHeadwaysLeast) continue;
    const double at = places[place].mean_s();
    const double deviation = places[place].deviation_s();
    means.points.push_back({static_cast<double>(place + 1), at});
    spread.intervals.push_back({{static_cast<double>(place + 1), at}, std::max(0.0, at - deviation), at + deviation});
  }
  figure.x.max = std::max(5.5, means.points.back().x + 0.5);
  figure.layers.emplace_back(std::move(spread));
  figure.layers.emplace_back(std::move(means));
  if (const auto headway_s = queues.discharge.saturation_headway_s()) {
    const std::string h = fixed(*headway_s, 3);
    const std::string flow = fixed(3600.0 / *headway_s, 0);
    const std::string count = grouped(static_cast<std::int64_t>(queues.discharge.saturated().headways));
    const std::string lost = signed_text(*queues.discharge.lost_time_s());
    figure.layers.push_back(figure::Rule{
        .name = Words{"saturation, from the 5th on (" + count + "): " + h + " s, " + flow +
                          " veh/h; lost at the start " + lost + " s",
                      "饱和，第 5 辆起（" + count + " 个）：" + h + " s，" + flow + " 辆/小时；启动损失 " + lost + " s"}
                    .in(language),
        .at = *headway_s,
        .colour = figure::look_of(1).colour});
  }
  figure.size = {120.0, 75.0};
  return {.figures = {std::move(figure)}, .columns = 1};
}

}  // namespace

Expected<Drawing> draw_discharge(const Result& result, const PlotOptions& options) {
  const auto table = result.table(results::kCarTable, "(always)");
  if (!table) return table.error();
  if (!fixed_plan(result) && !result.holds(run_log::kRunLog)) {
    return Error{
        result.folder().string(),
        "holds no run.mcap, and its signal plan was actuated or changed, so that nothing says when lights were "
        "green; record it with `lukou run SCENARIO --set record.log=EVENTS`"};
  }
  const Window window = whole_run(result, options);
  std::array<std::vector<LineCrossing>, kLanes> crossings;
  const auto read =
      for_each_row(table.value(), {"lane", "entered_s", "act_time_s", "stop_time_s"}, [&](const TableRow& row) {
        const auto lane = lane_named(row.text(0));
        if (!lane || (options.lane && *lane != *options.lane)) return;
        crossings[index(*lane)].push_back({row.real(1) + row.real(2), row.real(3) > 0.0});
      });
  if (!read) return read.error();

  Queues queues{.discharge = {}, .lane = options.lane};
  for (std::size_t lane = 0; lane < crossings.size(); ++lane) {
    if (crossings[lane].empty()) continue;
    const auto spans = aspect_spans(result, static_cast<Lane>(lane), window);
    if (!spans) return spans.error();
    std::vector<double> greens_s;
    for (const AspectSpan& span : spans.value()) {
      // A green that is cut by the window has no known begin.
      if (span.aspect == Aspect::kGreen && span.from_s > window.from_s) greens_s.push_back(span.from_s);
    }
    std::ranges::sort(crossings[lane], {}, &LineCrossing::at_s);
    std::erase_if(crossings[lane], [&](const LineCrossing& crossing) { return crossing.at_s > window.to_s; });
    queues.discharge.add(crossings[lane], greens_s);
  }
  const auto& places = queues.discharge.places();
  const auto enough = [](const PlaceHeadways& place) { return place.headways >= kHeadwaysLeast; };
  if (std::ranges::none_of(places, enough)) {
    return Error{result.folder().string(),
                 "has no standing queues to discharge: with guidance hardly a car stands; use a run without it "
                 "(--rsu-algorithm none) or with more traffic"};
  }
  return Drawing([queues = std::move(queues)](Language language) { return panels_of(queues, language); });
}

}  // namespace lukou::report
