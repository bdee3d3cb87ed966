// Cumulative arrivals and departures: the whole run, and some cycles of a lane in which the delay shows as the room
// between two curves.

#include <algorithm>
#include <cmath>

#include "common/results/tables.hpp"
#include "scenario.pb.h"
#include "services/lukou/report/plots/plot.hpp"
#include "services/lukou/report/plots/series.hpp"
#include "services/lukou/report/plots/signals.hpp"
#include "services/lukou/report/table_rows.hpp"

namespace lukou::report {
namespace {

constexpr double kStretch_s = 270.0;
constexpr Lane kUsualLane = lane_of(Approach::kWest, Turn::kCenter);

/// The times of some events, each curve counts them.
struct Curves {
  std::vector<double> entered_s;             ///< rising, as the next
  std::vector<double> at_line_unhindered_s;  ///< entrance and theoretical time
  std::vector<figure::Point> crossed;
  std::vector<figure::Point> left;
};

struct Cumulative {
  std::optional<Lane> lane;  ///< as the user asked
  Window run;
  Window stretch;
  Curves all;          ///< of the lanes asked for
  Curves lane_curves;  ///< of one lane
  std::vector<AspectSpan> spans;
};

/// Cars since the start, over time, within the window; begins with what there was before.
std::vector<figure::Point> counted(const std::vector<double>& times_s, const Window& window) {
  std::vector<figure::Point> curve;
  const auto first = std::ranges::lower_bound(times_s, window.from_s);
  auto count = static_cast<double>(first - times_s.begin());
  curve.push_back({window.from_s, count});
  for (auto at = first; at != times_s.end() && *at <= window.to_s; ++at) curve.push_back({*at, ++count});
  return curve;
}

/// The part of a curve in the window; it begins with the last value before, and ends with the window.
std::vector<figure::Point> cut(const std::vector<figure::Point>& curve, const Window& window) {
  std::vector<figure::Point> inside{{window.from_s, 0.0}};
  for (const figure::Point& point : curve) {
    if (point.x <= window.from_s) inside.front().y = point.y;
    if (point.x > window.from_s && point.x <= window.to_s) inside.push_back(point);
  }
  inside.push_back({window.to_s, inside.back().y});
  return inside;
}

figure::Figure frame(const Window& window, Language language) {
  figure::Figure figure;
  figure.x = {.label = says::kTime.in(language), .unit = "s", .min = window.from_s, .max = window.to_s};
  figure.y = {.label = Words{"cars since the start", "累计车辆数"}.in(language)};
  return figure;
}

figure::Figure over_the_run(const Cumulative& data, Language language) {
  figure::Figure figure = frame(data.run, language);
  figure.title = Words{"Cumulative arrivals and departures", "累计到达与驶离"}.in(language);
  figure.subtitle = says::lanes(data.lane, language);
  figure.layers.push_back(figure::Line{.name = Words{"came onto the road", "驶入"}.in(language),
                                       .points = thinned(counted(data.all.entered_s, data.run), 600),
                                       .look = 0});
  figure.layers.push_back(figure::Line{.name = Words{"crossed the stop line", "驶过停车线"}.in(language),
                                       .points = thinned(cut(data.all.crossed, data.run), 600),
                                       .look = 1});
  if (!data.all.left.empty()) {
    figure.layers.push_back(figure::Line{.name = Words{"left the exit", "驶离出口"}.in(language),
                                         .points = thinned(cut(data.all.left, data.run), 600),
                                         .look = 2});
  }
  return figure;
}

figure::Figure over_the_stretch(const Cumulative& data, Language language) {
  figure::Figure figure = frame(data.stretch, language);
  const Lane lane = data.lane.value_or(kUsualLane);
  figure.title = Words{"At the stop line of lane ", "停车线处，车道 "}.in(language) + std::string(name(lane));
  figure.subtitle =
      Words{"to the right: delay of a car; upwards: cars held up", "水平距离：单车延误；竖直距离：受阻车辆数"}.in(
          language);
  figure::Line arrivals{.name = Words{"would be there unhindered", "不受阻时应到达"}.in(language),
                        .points = counted(data.lane_curves.at_line_unhindered_s, data.stretch),
                        .look = 0,
                        .steps = true};
  figure::Line departures{.name = Words{"crossed", "驶过"}.in(language),
                          .points = cut(data.lane_curves.crossed, data.stretch),
                          .look = 1,
                          .steps = true,
                          .colour = figure::look_of(1).colour};
  double low = arrivals.points.front().y;
  double high = low + 1.0;
  for (const figure::Line* line : {&arrivals, &departures}) {
    for (const figure::Point& point : line->points) {
      low = std::min(low, point.y);
      high = std::max(high, point.y);
    }
  }
  const double height = (high - low) * 0.04;
  for (figure::Layer& strip : signal_strip(data.spans, low - 2.0 * height, low - height, language)) {
    figure.layers.push_back(std::move(strip));
  }
  figure.y.min = low - 2.0 * height;
  figure.y.max = high + height;
  figure.layers.emplace_back(std::move(arrivals));
  figure.layers.emplace_back(std::move(departures));
  return figure;
}

/// Cars of car.csv by lane: those that have left. A lane keeps its order, so that a lane's list is whole up to the
/// entrance of the last car on it.
struct Cars {
  std::array<std::vector<double>, kLanes> entered_s;
  std::array<std::vector<double>, kLanes> unhindered_s;

  /// The entrances of the lanes asked for, as far as all of them are whole, and when cars would be at the line.
  Curves curves(const std::optional<Lane>& only, double all_until_s, double drive_s) const {
    Curves curves;
    double whole_until_s = all_until_s;
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      if (only && lane != index(*only)) continue;
      whole_until_s = std::min(whole_until_s, entered_s[lane].empty() ? 0.0 : entered_s[lane].back());
      curves.entered_s.insert(curves.entered_s.end(), entered_s[lane].begin(), entered_s[lane].end());
      curves.at_line_unhindered_s.insert(curves.at_line_unhindered_s.end(), unhindered_s[lane].begin(),
                                         unhindered_s[lane].end());
    }
    std::erase_if(curves.entered_s, [&](double at_s) { return at_s > whole_until_s; });
    std::erase_if(curves.at_line_unhindered_s, [&](double at_s) { return at_s > whole_until_s + drive_s; });
    std::ranges::sort(curves.entered_s);
    std::ranges::sort(curves.at_line_unhindered_s);
    return curves;
  }
};

}  // namespace

Expected<Drawing> draw_cumulative(const Result& result, const PlotOptions& options) {
  const auto car_table = result.table(results::kCarTable, "(always)");
  if (!car_table) return car_table.error();
  const auto road_table = result.table(results::kRoadTable, "(always)");
  if (!road_table) return road_table.error();
  const Lane lane = options.lane.value_or(kUsualLane);
  Cumulative data{
      .lane = options.lane, .run = whole_run(result, options), .stretch = stretch(result, options, kStretch_s)};

  Cars cars;
  const auto read_cars =
      for_each_row(car_table.value(), {"lane", "entered_s", "theoretical_time_s"}, [&](const TableRow& row) {
        const auto on = lane_named(row.text(0));
        if (!on) return;
        cars.entered_s[index(*on)].push_back(row.real(1));
        cars.unhindered_s[index(*on)].push_back(row.real(1) + row.real(2));
      });
  if (!read_cars) return read_cars.error();
  const auto& traffic = result.scenario().message().traffic();
  const double drive_s = traffic.approach_length_m() / (result.scenario().message().vehicles().speed_limit_kmh() / 3.6);
  data.all = cars.curves(options.lane, data.run.to_s, drive_s);
  data.lane_curves = cars.curves(lane, data.run.to_s, drive_s);

  const std::string of_lane(name(lane));
  const std::string of_all = options.lane ? of_lane : "left_lanes_total";
  const auto read_road =
      for_each_row(road_table.value(), {"time_s", of_all, of_lane, "left_system_total"}, [&](const TableRow& row) {
        // A curve of steps: only where it rises.
        const auto add = [&](std::vector<figure::Point>& curve, double count) {
          if (curve.empty() || curve.back().y != count) curve.push_back({row.real(0), count});
        };
        add(data.all.crossed, row.real(1));
        add(data.lane_curves.crossed, row.real(2));
        if (!options.lane) add(data.all.left, row.real(3));
      });
  if (!read_road) return read_road.error();
  auto spans = aspect_spans(result, lane, data.stretch);
  if (!spans) return spans.error();
  data.spans = std::move(spans).value();
  return Drawing([data = std::move(data)](Language language) {
    return Panels{.figures = {over_the_run(data, language), over_the_stretch(data, language)}};
  });
}

}  // namespace lukou::report
