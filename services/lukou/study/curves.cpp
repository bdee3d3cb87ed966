#include <algorithm>
#include <cmath>

#include "services/lukou/study/number_text.hpp"
#include "services/lukou/study/overlay.hpp"
#include "services/lukou/study/panels.hpp"
#include "services/lukou/study/pictures.hpp"

namespace lukou::studies {
namespace {

using figure::Band;
using figure::Line;

constexpr std::size_t kPanelsMax = 12;
constexpr std::size_t kLinesMax = 7;
constexpr int kBaselineLook = 6;

/// Curves of one measure over the first factor of a grid.
class Curves {
 public:
  Curves(const Study& study, const Plan& plan, const Analysis& analysis, std::size_t grid, std::size_t measure)
      : study_(study), plan_(plan), analysis_(analysis), grid_(grid), measure_(measure) {
    for (std::size_t arm = 0; arm < study.arms.size(); ++arm)
      if (study.baseline != arm) arms_.push_back(arm);
    // One arm: a line for each level of the second factor. Several: a line for each arm.
    by_level_ = arms_.size() == 1 && study.grids[grid].factors.size() > 1;
  }

  std::vector<figure::Figure> panels() {
    const Grid& grid = study_.grids[grid_];
    const auto panels = panels_of(grid, by_level_ ? std::vector<std::size_t>{0, 1} : std::vector<std::size_t>{0});
    const std::size_t lines = by_level_ ? grid.factors[1].levels.size() : arms_.size();
    if (panels.size() > kPanelsMax || lines > kLinesMax || grid.factors[0].levels.size() < 2) return {};
    std::vector<figure::Figure> figures;
    for (const Panel& panel : panels) figures.push_back(figure_of(panel, lines));
    if (!drawn_) return {};
    for (figure::Figure& figure : figures) {
      figure.y.min = least_ >= 0.0 ? std::optional(0.0) : std::nullopt;
      if (figures.size() > 1) figure.y.max = std::ceil(most_ / step()) * step();
    }
    return figures;
  }

 private:
  [[nodiscard]] double step() const { return figure::nice_step(std::max(1e-9, most_) / 5.0); }

  figure::Figure figure_of(const Panel& panel, std::size_t lines) {
    const Grid& grid = study_.grids[grid_];
    const Measure& measure = analysis_.measures[measure_];
    figure::Figure figure{.title = measure.label + (panel.title.empty() ? "" : ": " + panel.title),
                          .subtitle = "mean and " + fixed(100.0 * study_.confidence, 0) + " % interval",
                          .x = numbers_axis(grid.factors[0]),
                          .y = {.label = measure.label, .unit = measure.unit}};
    for (std::size_t line = 0; line < lines; ++line) {
      std::vector<std::size_t> levels = panel.levels;
      if (by_level_) levels[1] = line;
      const std::size_t arm = by_level_ ? arms_.front() : arms_[line];
      add_line(figure, by_level_ ? text(grid.factors[1], line) : study_.arms[arm].name, levels, arm,
               static_cast<int>(line));
    }
    if (study_.baseline) {
      add_line(figure, study_.arms[*study_.baseline].name, panel.levels, *study_.baseline, kBaselineLook);
    }
    if (measure.path.starts_with("mean_delay")) add_overlays(figure, panel.levels);
    return figure;
  }

  void add_line(figure::Figure& figure, const std::string& name, std::vector<std::size_t> levels, std::size_t arm,
                int look) {
    const Factor& factor = study_.grids[grid_].factors[0];
    Line line{.name = name, .points = {}, .look = look, .markers = true};
    Band band{.name = {}, .x = {}, .low = {}, .high = {}, .look = look};
    for (std::size_t level = 0; level < factor.levels.size(); ++level) {
      levels[0] = level;
      const std::size_t point = plan_.cells[cell_at(study_, grid_, levels)].points[arm];
      const auto& found = analysis_.points[point].measures[measure_];
      const double x = place_of(factor, level);
      line.points.push_back({x, found ? found->mean : std::nan("")});
      if (!found) continue;
      drawn_ = true;
      least_ = std::min(least_, found->low());
      most_ = std::max(most_, found->high());
      band.x.push_back(x);
      band.low.push_back(found->low());
      band.high.push_back(found->high());
    }
    figure.layers.insert(figure.layers.begin(), band);
    figure.layers.emplace_back(std::move(line));
  }

  void add_overlays(figure::Figure& figure, std::vector<std::size_t> levels) {
    const Factor& factor = study_.grids[grid_].factors[0];
    const std::size_t arm = study_.baseline.value_or(0);
    for (const Overlay overlay : study_.overlays) {
      Line line{.name = name(overlay), .points = {}, .width_pt = 1.0};
      line.look = overlay == Overlay::kWebster ? 3 : 4;
      for (std::size_t level = 0; level < factor.levels.size(); ++level) {
        levels[0] = level;
        const Point& point = plan_.points[plan_.cells[cell_at(study_, grid_, levels)].points[arm]];
        const auto scenario = scenario_of(study_, point, study_.first_seed);
        const auto delay_s = scenario ? formula_delay_s(scenario.value(), overlay) : std::nullopt;
        line.points.push_back({place_of(factor, level), delay_s.value_or(std::nan(""))});
      }
      figure.layers.emplace_back(std::move(line));
    }
  }

  const Study& study_;
  const Plan& plan_;
  const Analysis& analysis_;
  std::size_t grid_;
  std::size_t measure_;
  std::vector<std::size_t> arms_;
  bool by_level_ = false;
  bool drawn_ = false;
  double least_ = 0.0;
  double most_ = 0.0;
};

}  // namespace

std::vector<Picture> curves_of(const Study& study, const Plan& plan, const Analysis& analysis) {
  std::vector<Picture> pictures;
  for (std::size_t measure = 0; measure < analysis.measures.size(); ++measure)
    for (std::size_t grid = 0; grid < study.grids.size(); ++grid) {
      if (study.grids[grid].factors.empty()) continue;
      const auto panels = Curves(study, plan, analysis, grid, measure).panels();
      if (panels.empty()) continue;
      const Measure& what = analysis.measures[measure];
      std::string caption = title(what) + " over " + study.grids[grid].factors[0].name + ".";
      caption[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(caption[0])));
      if (!study.overlays.empty() && what.path.starts_with("mean_delay")) {
        caption +=
            " The formulas give control delay at a fixed plan, with the saturation flow of this model and the "
            "displayed green; the simulated delay also holds what is lost from the line to the end of the exit.";
      }
      pictures.push_back({"curves-" + slug(what.path) + "-" + std::to_string(grid + 1), what.label, std::move(caption),
                          svg_of(panels, 2)});
    }
  return pictures;
}

std::vector<Picture> bars_of(const Study& study, const Plan& plan, const Analysis& analysis) {
  std::vector<Picture> pictures;
  for (std::size_t grid = 0; grid < study.grids.size(); ++grid) {
    if (!study.grids[grid].factors.empty() || study.arms.size() < 2) continue;
    const Cell& cell = plan.cells[cell_at(study, grid, {})];
    for (std::size_t measure = 0; measure < analysis.measures.size(); ++measure) {
      const Measure& what = analysis.measures[measure];
      figure::Figure figure{.title = what.label,
                            .subtitle = "mean and " + fixed(100.0 * study.confidence, 0) + " % interval",
                            .x = {},
                            .y = {.label = what.label, .unit = what.unit}};
      figure::Bars bars{.bars = {}, .width = 0.6};
      figure::Intervals whiskers{.intervals = {}, .look = kBaselineLook};
      for (std::size_t arm = 0; arm < study.arms.size(); ++arm) {
        figure.x.names.push_back(study.arms[arm].name);
        const auto& found = analysis.points[cell.points[arm]].measures[measure];
        if (!found) continue;
        const auto at = static_cast<double>(arm);
        bars.bars.push_back({at, 0.0, found->mean});
        whiskers.intervals.push_back({{at, found->mean}, found->low(), found->high()});
      }
      if (bars.bars.empty()) continue;
      figure.layers = {bars, whiskers};
      pictures.push_back({"arms-" + slug(what.path) + "-" + std::to_string(grid + 1), what.label,
                          title(what) + " of each arm.", svg_of({figure}, 1)});
    }
  }
  return pictures;
}

}  // namespace lukou::studies
