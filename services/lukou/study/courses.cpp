#include <algorithm>
#include <cmath>

#include "services/lukou/study/number_text.hpp"
#include "services/lukou/study/panels.hpp"
#include "services/lukou/study/pictures.hpp"
#include "services/lukou/study/statistics/warm_up.hpp"

namespace lukou::studies {
namespace {

/// Cells that are drawn: all of a small study; of others those where MSER-5 would cut most.
constexpr std::size_t kCellsMax = 6;
constexpr std::size_t kArmsMax = 4;
/// Intervals to both sides of Welch's moving average: a fifth of a cycle each, so three cycles and a bit.
constexpr std::size_t kWindow = 8;

using SeriesOf = statistics::Series RunSeries::*;

/// The mean over a point's runs; empty if it has none.
statistics::Series mean_course(const std::vector<RunRecord>& runs, SeriesOf which) {
  std::vector<statistics::Series> all;
  for (const RunRecord& run : runs)
    if (run.state == RunRecord::State::kDone) all.push_back(run.series.*which);
  return all.empty() ? statistics::Series{} : statistics::mean_over_replications(all);
}

double interval_of(const std::vector<RunRecord>& runs) {
  for (const RunRecord& run : runs)
    if (run.has_result()) return run.series.interval_s;
  return 0.0;
}

std::vector<std::size_t> cells_to_draw(const Plan& plan, const Analysis& analysis) {
  std::vector<std::size_t> cells(plan.cells.size());
  for (std::size_t c = 0; c < cells.size(); ++c) cells[c] = c;
  if (cells.size() <= kCellsMax) return cells;
  const auto cut_s = [&](std::size_t cell) {
    double largest_s = 0.0;
    for (const std::size_t point : plan.cells[cell].points) {
      largest_s = std::max(largest_s, analysis.points[point].cut_s.value_or(1e9));
    }
    return -largest_s;
  };
  std::ranges::stable_sort(cells, {}, cut_s);
  cells.resize(2);
  std::ranges::sort(cells);
  return cells;
}

struct Course {
  SeriesOf which;
  std::string title;
  figure::Axis y;
  bool welch;  ///< draws the moving average over the mean
};

figure::Figure figure_of(const Study& study, const Plan& plan, const Outcome& outcome, std::size_t cell,
                         const Course& course) {
  const std::string where = text(study, plan.cells[cell]);
  figure::Figure figure{.title = course.title + (where.empty() ? "" : ": " + where),
                        .subtitle = course.welch ? "mean over the runs (thin), moving average over three cycles (thick)"
                                                 : "mean over the runs",
                        .x = {.label = "time", .unit = "s", .min = 0.0},
                        .y = course.y};
  for (std::size_t arm = 0; arm < std::min(kArmsMax, study.arms.size()); ++arm) {
    const std::size_t point = plan.cells[cell].points[arm];
    const auto& runs = outcome.gathered.points[point];
    const statistics::Series mean = mean_course(runs, course.which);
    const double interval_s = interval_of(runs);
    const auto line_of = [&](const statistics::Series& series, const std::string& name, double width_pt) {
      figure::Line line{.name = name, .points = {}, .look = static_cast<int>(arm), .width_pt = width_pt};
      for (std::size_t i = 0; i < series.size(); ++i) {
        line.points.push_back({(static_cast<double>(i) + (course.welch ? 0.5 : 1.0)) * interval_s, series[i]});
      }
      return line;
    };
    if (mean.empty()) continue;
    if (course.welch) {
      figure::Line thin = line_of(mean, "", 0.3);
      thin.colour = figure::mixed(figure::look_of(static_cast<int>(arm)).colour, figure::kWhite, 0.5);
      figure.layers.insert(figure.layers.begin(), thin);
    }
    figure.layers.emplace_back(
        line_of(course.welch ? statistics::welch_average(mean, kWindow) : mean, study.arms[arm].name, 1.2));
    if (course.welch && outcome.analysis.points[point].cut_s) {
      figure.layers.emplace_back(figure::Rule{.name = "",
                                              .at = *outcome.analysis.points[point].cut_s,
                                              .vertical = true,
                                              .colour = figure::look_of(static_cast<int>(arm)).colour});
    }
  }
  const double warmup_s = outcome.analysis.points[plan.cells[cell].points.front()].warmup_s;
  figure.layers.emplace_back(figure::Rule{
      .name = "end of the warm-up", .at = warmup_s, .vertical = true, .colour = figure::kInk, .dashed = false});
  return figure;
}

}  // namespace

std::vector<Picture> courses_of(const Study& study, const Plan& plan, const Outcome& outcome) {
  std::vector<Picture> pictures;
  const std::vector<std::size_t> cells = cells_to_draw(plan, outcome.analysis);
  const std::vector<std::pair<Course, std::string>> kinds = {
      {{&RunSeries::standing_veh, "Standing cars", {.label = "standing cars", .min = 0.0}, true},
       "Welch's picture: standing cars over time. Dashed lines: where MSER-5 would begin to measure; the solid one: "
       "where "
       "the study does."},
      {{&RunSeries::mean_stop_time_s,
        "Mean stop time so far",
        {.label = "mean stop time", .unit = "s", .min = 0.0},
        false},
       "The running mean stop time per car that has entered, from the first step on: the curve of the paper's figure "
       "6."}};
  for (std::size_t k = 0; k < kinds.size(); ++k) {
    std::vector<figure::Figure> panels;
    for (const std::size_t cell : cells) {
      if (outcome.analysis.points[plan.cells[cell].points.front()].runs == 0) continue;
      panels.push_back(figure_of(study, plan, outcome, cell, kinds[k].first));
    }
    if (panels.empty()) continue;
    std::string caption = kinds[k].second;
    if (cells.size() < plan.cells.size()) caption += " Of all cells the two that take longest to settle.";
    pictures.push_back({k == 0 ? "welch" : "course", "warm-up", std::move(caption), svg_of(panels, 2)});
  }
  return pictures;
}

}  // namespace lukou::studies
