// The paper's figure 5: the plane of speed difference and distance, with the thresholds of the following law and the
// way of a car through it.

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "common/results/tables.hpp"
#include "scenario.pb.h"
#include "services/lukou/report/plots/plot.hpp"
#include "services/lukou/report/plots/series.hpp"
#include "services/lukou/report/table_rows.hpp"
#include "services/traffic_engine/engine_config.hpp"
#include "services/traffic_engine/model/follow_law.hpp"

namespace lukou::report {
namespace {

constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();
constexpr double kReach_mps = 8.0;   ///< of the whole plane to both sides, at least
constexpr double kNear = 10.0;       ///< of the near one, in thresholds of perception
constexpr double kNearTop = 3.0;     ///< its height, in safe distances
constexpr double kFreeShare = 1.12;  ///< height of the whole plane, in reaction distances

/// The car ahead as the follower meets it: x is the speed difference (above 0: closing in), y the distance of the
/// heads.
struct Way {
  std::uint32_t vehicle = 0;
  std::vector<figure::Point> points;  ///< gaps where nobody is ahead
  std::vector<double> ahead_mps;      ///< speed of the car ahead at each of them
};

struct Plane {
  Way way;
  traffic::DrivingParameters driving;
  traffic::FollowLaw law;
};

/// A stretch of time in which the car is on the approach.
struct Life {
  std::uint32_t vehicle = 0;
  double from_s = 0.0;
  double to_s = 0.0;
};

/// A car that crosses the line so shortly after the one before follows it.
constexpr double kFollows_s = 3.0;

/// The car asked for; else the first after the warm-up that stood and follows another; else one that follows; else one.
Expected<Life> life_of(const Result& result, const PlotOptions& options) {
  const auto table = result.table(results::kCarTable, "(always)");
  if (!table) return table.error();
  const double from_s = options.from_s.value_or(warmup_s(result));
  std::array<std::optional<Life>, 3> choice;  // the best first
  std::array<double, kLanes> crossed_s;
  crossed_s.fill(-kFollows_s);
  const auto read =
      for_each_row(table.value(), {"vehicle", "entered_s", "act_time_s", "stops", "lane"}, [&](const TableRow& row) {
        const Life life{static_cast<std::uint32_t>(row.whole(0)), row.real(1), row.real(1) + row.real(2)};
        const auto lane = lane_named(row.text(4));
        if (!lane) return;
        const bool follows = life.to_s - std::exchange(crossed_s[index(*lane)], life.to_s) < kFollows_s;
        const bool asked = options.vehicle ? life.vehicle == *options.vehicle : life.from_s >= from_s;
        if (!asked) return;
        const std::size_t rank = !follows ? 2 : row.whole(3) > 0 ? 0 : 1;
        if (!choice[rank]) choice[rank] = life;
      });
  if (!read) return read.error();
  for (const std::optional<Life>& life : choice) {
    if (life) return *life;
  }
  // On the road at the end: it has no row.
  if (options.vehicle) return Life{*options.vehicle, 0.0, end_s(result)};
  return Error{table.value().string(),
               "has no car that entered from " + fixed(from_s, 0) + " s on; choose one by --vehicle"};
}

Expected<Way> way_of(const Result& result, run_log::RunLogReader log, const Life& life, double reaction_m) {
  const double approach_m = result.scenario().message().traffic().approach_length_m();
  Way way{.vehicle = life.vehicle};
  bool near = false;
  log.read_only({run_log::Channel::kCars});
  log.seek(step_at_or_after(std::floor(life.from_s * 10.0) / 10.0));
  bool seen = false;
  while (true) {
    const auto step = log.next();
    if (!step) return step.error();
    if (step.value() == nullptr || step.value()->step > step_at_or_after(life.to_s) + 1) break;
    if (!step.value()->cars) continue;
    const TrafficBatch& batch = step.value()->traffic;
    const auto found = std::ranges::find(batch.vehicle, life.vehicle);
    if (found == batch.vehicle.end()) continue;
    const auto i = static_cast<std::size_t>(found - batch.vehicle.begin());
    seen = true;
    if (batch.position_m[i] > approach_m) break;
    if (i == 0 || batch.lane[i - 1] != batch.lane[i]) {
      way.points.push_back({kNothing, kNothing});
      way.ahead_mps.push_back(kNothing);
      continue;
    }
    const double distance_m = batch.position_m[i - 1] - batch.position_m[i];
    const double ahead_mps = batch.speed_mps[i - 1];
    way.points.push_back({batch.speed_mps[i] - ahead_mps, distance_m});
    way.ahead_mps.push_back(ahead_mps);
    near = near || distance_m < reaction_m;
  }
  const std::string car = "vehicle " + std::to_string(life.vehicle);
  if (!seen) return Error{(result.folder() / run_log::kRunLog).string(), "has no " + car};
  if (!near) {
    return Error{(result.folder() / run_log::kRunLog).string(),
                 car + " never had a car ahead within " + fixed(reaction_m, 0) + " m; choose another by --vehicle"};
  }
  return way;
}

constexpr figure::Colour kBraking{246, 222, 216};
constexpr figure::Colour kBand{226, 240, 228};
constexpr figure::Colour kFree{228, 236, 246};

/// Texts and lines of a plane that reaches `side` to both sides.
class Thresholds {
 public:
  Thresholds(figure::Figure& figure, double side, Language language)
      : figure_(figure), side_(side), language_(language) {}

  void box(double from, double to, figure::Colour colour) {
    figure_.layers.push_back(figure::Boxes{.name = {}, .boxes = {{-side_, side_, from, to}}, .colour = colour});
  }
  void line(std::vector<figure::Point> points, double width_pt = 0.9) {
    figure_.layers.push_back(
        figure::Line{.name = {}, .points = std::move(points), .width_pt = width_pt, .colour = figure::kInk});
  }
  void across(const std::string& name, double at) {
    line({{-side_, at}, {side_, at}}, 0.7);
    figure_.layers.push_back(figure::Note{.at = {side_ * 0.97, at + *figure_.y.max * 0.022},
                                          .text = name,
                                          .anchor = figure::Note::Anchor::kEnd,
                                          .colour = figure::kGrey});
  }
  /// `x` in shares of the side.
  void note(const Words& words, double x, double y) {
    figure_.layers.push_back(
        figure::Note{.at = {x * side_, y}, .text = words.in(language_), .anchor = figure::Note::Anchor::kMiddle});
  }

 private:
  figure::Figure& figure_;
  double side_;
  Language language_;
};

const Words kApproach{"approach", "接近"};
const Words kMoveAway{"move away", "离开"};
const Words kBrake{"brake", "刹车"};
const Words kRecover{"recover", "恢复"};
const Words kFollow{"follow", "跟随"};
const Words kFreeDriving{"free driving", "自由驾驶"};

void add_way(const std::vector<figure::Point>& points, Language language, figure::Figure& figure) {
  figure.layers.push_back(figure::Line{.name = Words{"way of the car", "车辆轨迹"}.in(language),
                                       .points = points,
                                       .width_pt = 1.3,
                                       .colour = figure::look_of(0).colour});
  const auto known = [](const figure::Point& point) { return std::isfinite(point.x); };
  const auto begin = std::ranges::find_if(points, known);
  const auto end = std::find_if(points.rbegin(), points.rend(), known);
  figure.layers.push_back(
      figure::Scatter{.name = Words{"begin", "起点"}.in(language), .points = {*begin}, .look = 0, .size_pt = 5.0});
  figure.layers.push_back(
      figure::Scatter{.name = Words{"stop line", "停车线"}.in(language), .points = {*end}, .look = 1, .size_pt = 5.0});
  figure.size = {85.0, 92.0};
}

/// As the paper draws it. The safe distance follows the speed of the car ahead: it has a way of its own.
figure::Figure whole_plane(const Plane& plane, Language language) {
  figure::Figure figure;
  figure.title =
      Words{"Following law: the way of car ", "跟驰相平面：车辆 "}.in(language) + std::to_string(plane.way.vehicle);
  figure.subtitle =
      Words{"between the curves nobody perceives the difference, equation (6)", "两条曲线之间感知不到速度差，式 (6)"}
          .in(language);
  const double reaction_m = plane.driving.reaction_distance_m;
  double reach_mps = kReach_mps;
  for (const figure::Point& point : plane.way.points) reach_mps = std::fmax(reach_mps, std::ceil(std::abs(point.x)));
  figure.x = {.label = Words{"speed difference Δv, closing to the right", "速度差 Δv（右侧为接近）"}.in(language),
              .unit = "m/s",
              .min = -reach_mps,
              .max = reach_mps};
  figure.y = {.label = Words{"distance of the heads Δx", "车头间距 Δx"}.in(language),
              .unit = "m",
              .min = 0.0,
              .max = kFreeShare * reaction_m};
  Thresholds thresholds(figure, reach_mps, language);
  thresholds.box(reaction_m, *figure.y.max, kFree);
  for (const double sign : {-1.0, 1.0}) {
    std::vector<figure::Point> curve;
    constexpr int kPieces = 80;
    for (int i = 0; i <= kPieces; ++i) {
      const double distance_m = reaction_m * i / kPieces;
      curve.push_back({sign * plane.law.perceived_mps(distance_m), distance_m});
    }
    thresholds.line(std::move(curve));
  }
  thresholds.across(fixed(reaction_m, 0) + " m", reaction_m);
  thresholds.note(kApproach, 0.66, reaction_m * 0.42);
  thresholds.note(kMoveAway, -0.66, reaction_m * 0.42);
  thresholds.note(kFollow, 0.0, reaction_m * 0.85);
  thresholds.note(kFreeDriving, 0.0, (reaction_m + *figure.y.max) / 2.0);
  figure::Line safe{
      .name = Words{"safe distance S then", "当时的安全距离 S"}.in(language), .points = {}, .look = 1, .width_pt = 0.9};
  for (std::size_t i = 0; i < plane.way.points.size(); ++i) {
    const double ahead_mps = plane.way.ahead_mps[i];
    safe.points.push_back(
        {plane.way.points[i].x, std::isfinite(ahead_mps) ? plane.law.safe_distance_m(ahead_mps) : kNothing});
  }
  figure.layers.emplace_back(std::move(safe));
  add_way(plane.way.points, language, figure);
  return figure;
}

/// In units of the thresholds, which makes them straight whatever the car ahead does.
figure::Figure near_plane(const Plane& plane, Language language) {
  figure::Figure figure;
  figure.title = Words{"The same near the safe distance", "安全距离附近"}.in(language);
  figure.subtitle = Words{"in units of the thresholds at each instant", "以各时刻的阈值为单位"}.in(language);
  figure.x = {.label = Words{"Δv / perceived difference", "Δv / 感知阈值"}.in(language),
              .unit = {},
              .min = -kNear,
              .max = kNear};
  figure.y = {
      .label = Words{"Δx / safe distance S", "Δx / 安全距离 S"}.in(language), .unit = {}, .min = 0.5, .max = kNearTop};
  const double near = 1.0 / plane.driving.band_near;
  const double far = 1.0 / plane.driving.band_far;
  Thresholds thresholds(figure, kNear, language);
  thresholds.box(0.5, near, kBraking);
  thresholds.box(near, far, kBand);
  thresholds.line({{-1.0, 0.5}, {-1.0, kNearTop}});
  thresholds.line({{1.0, near}, {1.0, kNearTop}});
  thresholds.across("1/" + fixed(plane.driving.band_far, 2), far);
  thresholds.across("S", 1.0);
  thresholds.across("1/" + fixed(plane.driving.band_near, 2), near);
  thresholds.note(kApproach, 0.62, 2.4);
  thresholds.note(kMoveAway, -0.62, 2.4);
  thresholds.note({"close the gap", "缩小间距"}, 0.0, 2.4);
  thresholds.note(kFollow, 0.0, (near + far) / 2.0);
  thresholds.note(kBrake, 0.4, 0.7);
  thresholds.note(kRecover, -0.62, 0.7);
  std::vector<figure::Point> points;
  for (std::size_t i = 0; i < plane.way.points.size(); ++i) {
    const figure::Point& point = plane.way.points[i];
    points.push_back(
        {point.x / plane.law.perceived_mps(point.y), point.y / plane.law.safe_distance_m(plane.way.ahead_mps[i])});
  }
  add_way(points, language, figure);
  return figure;
}

}  // namespace

Expected<Drawing> draw_phase_plane(const Result& result, const PlotOptions& options) {
  auto log = result.run_log(run_log::Level::kSecond, "the phase plane");
  if (!log) return log.error();
  const auto life = life_of(result, options);
  if (!life) return life.error();
  const auto config = engine_config(result.scenario());
  if (!config) return config.error();
  const traffic::EngineParameters& parameters = config.value().traffic;
  auto way = way_of(result, std::move(log).value(), life.value(), parameters.driving.reaction_distance_m);
  if (!way) return way.error();
  const Plane plane{std::move(way).value(), parameters.driving,
                    traffic::FollowLaw(parameters.vehicles, parameters.driving)};
  return Drawing([plane](Language language) {
    return Panels{.figures = {whole_plane(plane, language), near_plane(plane, language)}};
  });
}

}  // namespace lukou::report
