// Where the cars of a lane were over time, and what its head showed.

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "scenario.pb.h"
#include "services/lukou/report/plots/plot.hpp"
#include "services/lukou/report/plots/series.hpp"
#include "services/lukou/report/plots/signals.hpp"

namespace lukou::report {
namespace {

constexpr double kStretch_s = 240.0;
/// About so many points of a car are drawn over the window.
constexpr double kPoints = 300.0;
constexpr Lane kUsualLane = lane_of(Approach::kWest, Turn::kCenter);
constexpr figure::Point kGap{std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::quiet_NaN()};

/// A car's way; parts of it under advice.
struct Way {
  bool equipped = false;
  std::vector<figure::Point> points;
  std::vector<figure::Point> advised;
};

struct TimeSpace {
  Lane lane = kUsualLane;
  Window window;
  double approach_m = 0.0;
  double exit_m = 0.0;
  std::map<std::uint32_t, Way> ways;
  std::vector<AspectSpan> spans;
};

void take(const TrafficBatch& batch, TimeSpace& data) {
  const double at_s = time_s(batch.step);
  for (std::size_t i = 0; i < batch.vehicle.size(); ++i) {
    if (batch.lane[i] != static_cast<std::uint8_t>(data.lane)) continue;
    Way& way = data.ways[batch.vehicle[i]];
    way.equipped = batch.equipped[i] != 0;
    const figure::Point here{at_s, batch.position_m[i] - data.approach_m};
    way.points.push_back(here);
    const bool advised = batch.guidance[i] == static_cast<std::uint8_t>(GuidanceState::kInForce);
    if (advised) {
      way.advised.push_back(here);
    } else if (!way.advised.empty() && std::isfinite(way.advised.back().x)) {
      way.advised.push_back(kGap);
    }
  }
}

Panels panels_of(const TimeSpace& data, Language language) {
  figure::Figure figure;
  figure.title = Words{"Time-space diagram of lane ", "时空图，车道 "}.in(language) + std::string(name(data.lane));
  figure.subtitle = Words{"each line is the front of a car; the strip at 0 is the head at the stop line",
                          "每条线为一辆车车头的轨迹；0 处的色带为停车线信号灯"}
                        .in(language);
  figure.x = {.label = says::kTime.in(language), .unit = "s", .min = data.window.from_s, .max = data.window.to_s};
  figure.y = {.label = Words{"distance beyond the stop line", "相对停车线的距离"}.in(language),
              .unit = "m",
              .min = -data.approach_m,
              .max = data.exit_m};
  figure::Line unequipped{.name = says::kUnequipped.in(language), .points = {}, .look = 1, .width_pt = 0.7};
  figure::Line equipped{.name = says::kEquipped.in(language), .points = {}, .look = 0, .width_pt = 0.7};
  unequipped.colour = figure::look_of(1).colour;
  equipped.colour = figure::look_of(0).colour;
  figure::Line advised{.name = Words{"advice in force", "建议生效中"}.in(language),
                       .points = {},
                       .look = 2,
                       .width_pt = 1.6,
                       .colour = figure::look_of(2).colour};
  for (const auto& [vehicle, way] : data.ways) {
    figure::Line& line = way.equipped ? equipped : unequipped;
    line.points.insert(line.points.end(), way.points.begin(), way.points.end());
    line.points.push_back(kGap);
    advised.points.insert(advised.points.end(), way.advised.begin(), way.advised.end());
    advised.points.push_back(kGap);
  }
  const auto has_points = [](const figure::Line& line) {
    return std::ranges::any_of(line.points, [](const figure::Point& point) { return std::isfinite(point.x); });
  };
  for (figure::Line* line : {&advised, &equipped, &unequipped}) {
    if (has_points(*line)) figure.layers.emplace_back(std::move(*line));
  }
  const double half_m = (data.approach_m + data.exit_m) * 0.008;
  for (figure::Layer& strip : signal_strip(data.spans, -half_m, half_m, language)) {
    figure.layers.push_back(std::move(strip));
  }
  figure.size = {175.0, 100.0};
  return {.figures = {std::move(figure)}, .columns = 1};
}

}  // namespace

Expected<Drawing> draw_time_space(const Result& result, const PlotOptions& options) {
  auto log = result.run_log(run_log::Level::kSecond, "the time-space diagram");
  if (!log) return log.error();
  const auto& traffic = result.scenario().message().traffic();
  TimeSpace data{.lane = options.lane.value_or(kUsualLane),
                 .window = stretch(result, options, kStretch_s),
                 .approach_m = traffic.approach_length_m(),
                 .exit_m = traffic.exit_length_m()};
  const Step from = step_at_or_after(data.window.from_s);
  const Step to = step_at_or_after(data.window.to_s);
  const auto every = std::max<Step>(1, std::llround(data.window.length_s() * 10.0 / kPoints));
  log.value().read_only({run_log::Channel::kCars});
  log.value().seek(from);
  while (true) {
    const auto step = log.value().next();
    if (!step) return step.error();
    if (step.value() == nullptr || step.value()->step > to) break;
    const bool second = log.value().facts().level == run_log::Level::kSecond;
    if (step.value()->cars && (second || step.value()->step % every == 0)) take(step.value()->traffic, data);
  }
  if (data.ways.empty()) {
    return Error{(result.folder() / run_log::kRunLog).string(),
                 "has no car on lane " + std::string(name(data.lane)) + " from " + fixed(data.window.from_s, 1) +
                     " s to " + fixed(data.window.to_s, 1) + " s; choose others by --lane, --from, --to"};
  }
  auto spans = aspect_spans(result, data.lane, data.window);
  if (!spans) return spans.error();
  data.spans = std::move(spans).value();
  return Drawing([data = std::move(data)](Language language) { return panels_of(data, language); });
}

}  // namespace lukou::report
