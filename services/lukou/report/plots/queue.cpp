// How many cars stand, over the run and over a cycle of the signal.

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "common/core/step.hpp"
#include "common/results/tables.hpp"
#include "services/lukou/report/plots/plot.hpp"
#include "services/lukou/report/plots/series.hpp"
#include "services/lukou/report/plots/signals.hpp"
#include "services/lukou/report/table_rows.hpp"

namespace lukou::report {
namespace {

constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();
/// Without a cycle, what the run is told by.
constexpr double kMinute_s = 60.0;

/// Standing cars of some lanes over a stretch of time: a cycle, or a minute.
struct Stretch {
  double from_s = 0.0;
  double mean = 0.0;
  double most = 0.0;
};

/// Standing cars by second of the cycle.
struct Profile {
  std::vector<double> mean;
  std::vector<double> low;   ///< 5 % of the cycles have at most this
  std::vector<double> high;  ///< 95 % of the cycles have at most this
};

struct Queues {
  std::optional<Lane> lane;
  Window window;
  double stretch_s = kMinute_s;
  std::vector<Stretch> stretches;             ///< of the lane, or of all lanes together
  std::array<Profile, kApproaches> profiles;  ///< of each approach, a lane's mean; of the lane: the first
  std::vector<AspectSpan> spans;              ///< of the lane's head over the cycle
  std::size_t cycles = 0;
  bool cyclic = false;
};

/// Counts standing cars as the rows come.
class Counter {
 public:
  Counter(Queues& queues, const std::optional<SignalPlan>& plan, double profile_from_s)
      : queues_(queues), plan_(plan), profile_from_s_(profile_from_s) {
    if (!plan_) return;
    for (auto& seconds : by_second_) seconds.resize(static_cast<std::size_t>(plan_->cycle / kStepsPerSecond + 1));
  }

  void take(Step step, const std::array<double, kLanes>& standing) {
    const double at_s = time_s(step);
    if (!queues_.window.holds(at_s)) return;
    const double all = queues_.lane ? standing[index(*queues_.lane)] : sum(standing, 0, kLanes);
    if (queues_.stretches.empty() || at_s >= queues_.stretches.back().from_s + queues_.stretch_s) end_stretch(at_s);
    Stretch& stretch = queues_.stretches.back();
    stretch.most = std::max(stretch.most, all);
    stretch.mean += all;
    ++steps_;
    if (plan_ && at_s >= profile_from_s_ && step % kStepsPerSecond == 0) take_second(step, standing);
  }

  void end() {
    if (steps_ > 0 && !queues_.stretches.empty()) queues_.stretches.back().mean /= static_cast<double>(steps_);
    for (std::size_t group = 0; group < by_second_.size(); ++group) {
      Profile& profile = queues_.profiles[group];
      for (std::vector<double>& values : by_second_[group]) {
        std::ranges::sort(values);
        // A run of less than a cycle leaves seconds without a value.
        profile.mean.push_back(report::mean(values));
        profile.low.push_back(values.empty() ? kNothing : quantile(values, 0.05));
        profile.high.push_back(values.empty() ? kNothing : quantile(values, 0.95));
        queues_.cycles = std::max(queues_.cycles, values.size());
      }
    }
  }

 private:
  static double sum(const std::array<double, kLanes>& standing, std::size_t from, std::size_t lanes) {
    double all = 0.0;
    for (std::size_t lane = from; lane < from + lanes; ++lane) all += standing[lane];
    return all;
  }

  void end_stretch(double at_s) {
    if (steps_ > 0) queues_.stretches.back().mean /= static_cast<double>(steps_);
    steps_ = 0;
    queues_.stretches.push_back({.from_s = at_s});
  }

  void take_second(Step step, const std::array<double, kLanes>& standing) {
    const Step within = ((step - plan_->offset) % plan_->cycle + plan_->cycle) % plan_->cycle;
    const auto second = static_cast<std::size_t>(within / kStepsPerSecond);
    if (queues_.lane) {
      by_second_[0][second].push_back(standing[index(*queues_.lane)]);
      return;
    }
    for (std::size_t side = 0; side < kApproaches; ++side) {
      by_second_[side][second].push_back(sum(standing, side * kLanesPerApproach, kLanesPerApproach) /
                                         kLanesPerApproach);
    }
  }

  Queues& queues_;
  const std::optional<SignalPlan>& plan_;
  double profile_from_s_;
  std::size_t steps_ = 0;                                                ///< of the newest stretch
  std::array<std::vector<std::vector<double>>, kApproaches> by_second_;  ///< by approach and second of the cycle
};

figure::Figure over_the_run(const Queues& queues, Language language) {
  figure::Figure figure;
  figure.title = Words{"Standing cars over the run", "运行过程中的停车数"}.in(language);
  const std::string per = queues.cyclic ? Words{" of each cycle", "（每周期）"}.in(language)
                                        : Words{" of each minute", "（每分钟）"}.in(language);
  figure.subtitle = says::lanes(queues.lane, language);
  figure.x = {.label = says::kTime.in(language), .unit = "s", .min = queues.window.from_s, .max = queues.window.to_s};
  figure.y = {
      .label = Words{"standing cars", "停车数"}.in(language), .unit = Words{"veh", "辆"}.in(language), .min = 0.0};
  figure::Line most{.name = Words{"largest", "最大"}.in(language) + per,
                    .points = {},
                    .steps = true,
                    .width_pt = 0.8,
                    .colour = figure::look_of(1).colour};
  figure::Line mean{.name = Words{"mean", "平均"}.in(language) + per, .points = {}, .steps = true};
  for (const Stretch& stretch : queues.stretches) {
    most.points.push_back({stretch.from_s, stretch.most});
    mean.points.push_back({stretch.from_s, stretch.mean});
  }
  if (!queues.stretches.empty()) {
    most.points.push_back({queues.window.to_s, most.points.back().y});
    mean.points.push_back({queues.window.to_s, mean.points.back().y});
  }
  figure.layers.emplace_back(std::move(most));
  figure.layers.emplace_back(std::move(mean));
  return figure;
}

figure::Figure over_the_cycle(const Queues& queues, Language language) {
  figure::Figure figure;
  figure.title = Words{"Standing cars over the cycle", "一个周期内的停车数"}.in(language);
  const std::string cycles = std::to_string(queues.cycles);
  figure.subtitle =
      queues.lane
          ? says::lanes(queues.lane, language) +
                Words{", mean over " + cycles + " cycles", "，" + cycles + " 个周期的平均"}.in(language)
          : Words{"a lane's mean by approach, over " + cycles + " cycles", "各进口道每车道平均，" + cycles + " 个周期"}
                .in(language);
  figure.x = {
      .label = Words{"time in the cycle", "周期内时间"}.in(language), .unit = "s", .min = 0.0, .max = queues.stretch_s};
  figure.y = {
      .label = Words{"standing cars", "停车数"}.in(language), .unit = Words{"veh", "辆"}.in(language), .min = 0.0};
  double highest = 0.5;
  for (std::size_t group = 0; group < kApproaches; ++group) {
    const Profile& profile = queues.profiles[group];
    if (std::ranges::none_of(profile.mean, [](double value) { return std::isfinite(value); })) continue;
    figure::Line line{
        .name = queues.lane ? Words{"mean", "平均"}.in(language) : says::from(static_cast<Approach>(group), language),
        .points = {},
        .look = static_cast<int>(group)};
    figure::Band band{.name = Words{"5 to 95 % of the cycles", "5% 至 95% 的周期"}.in(language)};
    for (std::size_t second = 0; second < profile.mean.size(); ++second) {
      line.points.push_back({static_cast<double>(second), profile.mean[second]});
      band.x.push_back(static_cast<double>(second));
      highest = std::fmax(highest, queues.lane ? profile.high[second] : profile.mean[second]);
    }
    if (queues.lane) {
      band.low = profile.low;
      band.high = profile.high;
      figure.layers.emplace_back(std::move(band));
    }
    figure.layers.emplace_back(std::move(line));
  }
  if (queues.lane) {
    for (figure::Layer& strip : signal_strip(queues.spans, highest * 1.06, highest * 1.12, language)) {
      figure.layers.push_back(std::move(strip));
    }
  }
  return figure;
}

/// What the lane's head shows over one cycle of the plan.
std::vector<AspectSpan> spans_of_cycle(const SignalPlan& plan, Lane lane) {
  std::vector<AspectSpan> spans;
  double from_s = 0.0;
  for (const TimedAspect& timed : plan.lanes[index(lane)]) {
    spans.push_back({timed.aspect, from_s, from_s + time_s(timed.duration)});
    from_s = spans.back().to_s;
  }
  return spans;
}

}  // namespace

Expected<Drawing> draw_queue(const Result& result, const PlotOptions& options) {
  const auto table = result.table(results::kStopTimeTable, "(always)");
  if (!table) return table.error();
  const auto plan = fixed_plan(result);
  Queues queues{.lane = options.lane, .window = whole_run(result, options)};
  queues.cyclic = plan.has_value();
  if (plan) queues.stretch_s = time_s(plan->cycle);
  if (plan && options.lane) queues.spans = spans_of_cycle(*plan, *options.lane);
  std::vector<std::string> names;
  for (std::size_t lane = 0; lane < kLanes; ++lane) names.push_back(std::string(name(static_cast<Lane>(lane))) + "_s");
  std::vector<std::string_view> columns{"step"};
  columns.insert(columns.end(), names.begin(), names.end());

  Counter counter(queues, plan, options.from_s.value_or(warmup_s(result)));
  std::array<double, kLanes> before_s{};
  const auto read = for_each_row(table.value(), columns, [&](const TableRow& row) {
    // A lane's stop time grows by a step for each car that stands on it.
    std::array<double, kLanes> standing{};
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      const double stood_s = row.real(lane + 1);
      standing[lane] = std::round((stood_s - before_s[lane]) * static_cast<double>(kStepsPerSecond));
      before_s[lane] = stood_s;
    }
    counter.take(row.whole(0), standing);
  });
  if (!read) return read.error();
  counter.end();
  if (queues.stretches.empty())
    return Error{table.value().string(), "has no rows in the time that --from, --to choose"};
  return Drawing([queues = std::move(queues)](Language language) {
    Panels panels{.figures = {over_the_run(queues, language)}};
    if (queues.cycles > 0) panels.figures.push_back(over_the_cycle(queues, language));
    return panels;
  });
}

}  // namespace lukou::report
