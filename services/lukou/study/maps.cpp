#include <algorithm>
#include <cmath>
#include <limits>

#include "services/lukou/study/number_text.hpp"
#include "services/lukou/study/panels.hpp"
#include "services/lukou/study/pictures.hpp"

namespace lukou::studies {
namespace {

using figure::Cells;
using figure::ColourScale;
using figure::Contours;

constexpr std::size_t kPanelsMax = 12;
constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();

/// What stands in a cell of a map.
struct Entry {
  double value = kNothing;
  std::string text;
  std::string hover;
  bool hatched = false;
};

/// The map of one arm and one measure over the first two factors of a grid.
class Map {
 public:
  Map(const Study& study, const Plan& plan, const Analysis& analysis, std::size_t grid, std::size_t arm,
      std::size_t measure)
      : study_(study), plan_(plan), analysis_(analysis), grid_(grid), arm_(arm), measure_(measure) {}

  /// None if there is nothing to draw.
  std::vector<figure::Figure> panels() {
    const Grid& grid = study_.grids[grid_];
    for (const Panel& panel : panels_of(grid, {0, 1})) {
      std::vector<Entry> entries;
      for (std::size_t row = 0; row < grid.factors[1].levels.size(); ++row)
        for (std::size_t column = 0; column < grid.factors[0].levels.size(); ++column) {
          entries.push_back(entry(panel, column, row));
          if (!std::isfinite(entries.back().value)) continue;
          least_ = std::min(least_, entries.back().value);
          most_ = std::max(most_, entries.back().value);
        }
      entries_.push_back(std::move(entries));
      titles_.push_back(panel.title);
    }
    if (!(least_ <= most_) || entries_.size() > kPanelsMax) return {};
    std::vector<figure::Figure> figures;
    for (std::size_t i = 0; i < entries_.size(); ++i) figures.push_back(figure_of(titles_[i], entries_[i]));
    return figures;
  }

 private:
  [[nodiscard]] bool of_gain() const { return study_.baseline.has_value(); }

  Entry entry(const Panel& panel, std::size_t column, std::size_t row) const {
    std::vector<std::size_t> levels = panel.levels;
    levels[0] = column;
    levels[1] = row;
    const std::size_t cell = cell_at(study_, grid_, levels);
    const Measure& measure = analysis_.measures[measure_];
    const std::string where = text(study_, plan_.cells[cell]);
    if (of_gain()) {
      const Comparison* found = analysis_.find(cell, arm_, measure_);
      if (found == nullptr || !found->gain) return {};
      const double percent = 100.0 * found->gain->mean;
      std::string hover =
          where + ": " + percent_text(*found->gain) + ", " + value_text(found->of_baseline, measure.unit) + " to " +
          value_text(found->of_arm, measure.unit) + ", n = " + std::to_string(found->paired.difference.n);
      if (!found->comparable) hover += "; runs were ended by an anomaly";
      return {percent, fixed(percent, std::abs(percent) < 9.95 ? 1 : 0), std::move(hover), !found->significant};
    }
    const std::size_t point = plan_.cells[cell].points[arm_];
    const auto& found = analysis_.points[point].measures[measure_];
    if (!found) return {};
    return {found->mean, value_text({.n = 1, .mean = found->mean, .deviation = 0.0, .half_width = {}}, ""),
            where + ": " + value_text(*found, measure.unit), analysis_.points[point].anomalies > 0};
  }

  /// Colours of all panels alike; of gains from a round number to a round number, with 0 among them.
  [[nodiscard]] ColourScale scale() const {
    const Measure& measure = analysis_.measures[measure_];
    if (!of_gain()) {
      return {ColourScale::Kind::kSequential, least_, most_ > least_ ? most_ : least_ + 1.0, title(measure)};
    }
    const double step = figure::nice_step(std::max(1.0, std::max(std::abs(least_), std::abs(most_)) / 5.0));
    const double low = std::floor(std::min(least_, 0.0) / step) * step;
    const double high = std::ceil(std::max(most_, 0.0) / step) * step;
    return {ColourScale::Kind::kDiverging, low, high > low ? high : low + step, "gain [%]"};
  }

  figure::Figure figure_of(const std::string& held, const std::vector<Entry>& entries) const {
    const Grid& grid = study_.grids[grid_];
    const Measure& measure = analysis_.measures[measure_];
    const Factor& across = grid.factors[0];
    const Factor& up = grid.factors[1];
    Cells cells{.x_edges = figure::edges_of_names(across.levels.size()),
                .y_edges = figure::edges_of_names(up.levels.size()),
                .hatched_name = of_gain() ? "no difference can be told" : "ended by an anomaly",
                .scale = scale()};
    for (const Entry& entry : entries) {
      cells.values.push_back(entry.value);
      cells.texts.push_back(entry.text);
      cells.hovers.push_back(entry.hover);
      cells.hatched.push_back(entry.hatched);
    }
    const std::string of_arm = study_.arms.size() > (of_gain() ? 2U : 1U) ? study_.arms[arm_].name + ", " : "";
    figure::Figure figure{
        .title = measure.label + (held.empty() ? "" : ": " + held),
        .subtitle = of_arm + (of_gain() ? "gain against " + study_.arms[*study_.baseline].name : "mean"),
        .x = places_axis(across),
        .y = places_axis(up),
        .layers = {cells}};
    if (of_gain()) figure.layers.emplace_back(contours(cells));
    return figure;
  }

  /// Lines at round gains.
  static Contours contours(const Cells& cells) {
    Contours contours{.values = cells.values, .unit = " %"};
    for (std::size_t i = 0; i + 1 < cells.x_edges.size(); ++i) contours.x.push_back(static_cast<double>(i));
    for (std::size_t i = 0; i + 1 < cells.y_edges.size(); ++i) contours.y.push_back(static_cast<double>(i));
    const double step = figure::nice_step((cells.scale.max - cells.scale.min) / 5.0);
    const auto last = static_cast<int>(std::floor(cells.scale.max / step));
    for (auto i = static_cast<int>(std::ceil(cells.scale.min / step)); i <= last; ++i) {
      const double level = i * step;
      // The line of no gain is drawn where there is loss, too; not through noise around 0.
      const bool drawn = i != 0 || cells.scale.min <= -step;
      if (drawn && level > cells.scale.min && level < cells.scale.max) contours.levels.push_back(level);
    }
    return contours;
  }

  const Study& study_;
  const Plan& plan_;
  const Analysis& analysis_;
  std::size_t grid_;
  std::size_t arm_;
  std::size_t measure_;
  double least_ = std::numeric_limits<double>::infinity();
  double most_ = -std::numeric_limits<double>::infinity();
  std::vector<std::vector<Entry>> entries_;
  std::vector<std::string> titles_;
};

}  // namespace

std::vector<Picture> maps_of(const Study& study, const Plan& plan, const Analysis& analysis) {
  std::vector<Picture> pictures;
  for (std::size_t measure = 0; measure < analysis.measures.size(); ++measure)
    for (std::size_t grid = 0; grid < study.grids.size(); ++grid)
      for (std::size_t arm = 0; arm < study.arms.size(); ++arm) {
        if (study.grids[grid].factors.size() < 2 || study.baseline == arm) continue;
        const auto panels = Map(study, plan, analysis, grid, arm, measure).panels();
        if (panels.empty()) continue;
        const Measure& what = analysis.measures[measure];
        std::string caption = study.baseline ? "Gain in " + what.label + ": how much better " + study.arms[arm].name +
                                                   " is than " + study.arms[*study.baseline].name +
                                                   ", in % of the latter's mean; below 0 it is worse. "
                                                   "Hatched: no difference can be told with a confidence of " +
                                                   fixed(100.0 * study.confidence, 0) + " %."
                                             : "Mean " + title(what) + " of " + study.arms[arm].name + ".";
        std::string name = "map-" + slug(what.path) + "-" + std::to_string(grid + 1);
        if (study.arms.size() > 2) name += "-" + slug(study.arms[arm].name);
        pictures.push_back({std::move(name), what.label, std::move(caption), svg_of(panels, 2)});
      }
  return pictures;
}

}  // namespace lukou::studies
