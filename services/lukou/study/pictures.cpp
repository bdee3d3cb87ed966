#include "services/lukou/study/pictures.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "services/lukou/study/number_text.hpp"
#include "services/lukou/study/panels.hpp"

namespace lukou::studies {
namespace {

/// Measures that get a picture of pairs and a tornado: the first two.
constexpr std::size_t kMeasures = 2;

/// The pairs of a grid, an own look for each arm.
figure::Figure figure_of_pairs(const Study& study, const Plan& plan, const Outcome& outcome, std::size_t grid,
                               std::size_t measure) {
  const Measure& what = outcome.analysis.measures[measure];
  figure::Figure figure{.title = what.label + ", run by run",
                        .subtitle = study.grids[grid].name,
                        .x = {.label = study.arms[*study.baseline].name, .unit = what.unit},
                        .y = {.label = "the arm, same seed", .unit = what.unit}};
  figure::Extent extent;
  for (std::size_t arm = 0; arm < study.arms.size(); ++arm) {
    figure::Scatter scatter{.name = study.arms[arm].name, .points = {}, .look = static_cast<int>(arm), .size_pt = 3.0};
    for (const Cell& cell : plan.cells) {
      if (cell.grid != grid || arm == *study.baseline) continue;
      const Pairs pairs = pairs_of(outcome.gathered.points[cell.points[arm]],
                                   outcome.gathered.points[cell.points[*study.baseline]], measure);
      for (std::size_t i = 0; i < pairs.arm.size(); ++i) {
        scatter.points.push_back({pairs.baseline[i], pairs.arm[i]});
        extent.take(pairs.baseline[i]);
        extent.take(pairs.arm[i]);
      }
    }
    if (!scatter.points.empty()) figure.layers.emplace_back(std::move(scatter));
  }
  if (!extent.min) return figure;
  const figure::Line equal{.name = "equal",
                           .points = {{*extent.min, *extent.min}, {*extent.max, *extent.max}},
                           .width_pt = 0.8,
                           .colour = figure::kGrey};
  figure.layers.insert(figure.layers.begin(), equal);
  return figure;
}

/// The mean over all cells of a grid at one level of a factor: of the gain [%], or of the measure.
double mean_at(const Study& study, const Plan& plan, const Analysis& analysis, std::size_t grid, std::size_t arm,
               std::size_t measure, std::size_t factor, std::size_t level) {
  double sum = 0.0;
  double count = 0.0;
  for (std::size_t c = 0; c < plan.cells.size(); ++c) {
    const Cell& cell = plan.cells[c];
    if (cell.grid != grid || cell.levels[factor] != level) continue;
    if (study.baseline) {
      const Comparison* found = analysis.find(c, arm, measure);
      if (found == nullptr || !found->gain) continue;
      sum += 100.0 * found->gain->mean;
    } else {
      const auto& found = analysis.points[cell.points[arm]].measures[measure];
      if (!found) continue;
      sum += found->mean;
    }
    count += 1.0;
  }
  return count > 0.0 ? sum / count : std::numeric_limits<double>::quiet_NaN();
}

/// A bar for each factor, the longest on top.
std::optional<figure::Figure> tornado(const Study& study, const Plan& plan, const Analysis& analysis, std::size_t grid,
                                      std::size_t arm, std::size_t measure) {
  struct Reach {
    std::string name;
    double low = std::numeric_limits<double>::infinity();
    double high = -std::numeric_limits<double>::infinity();
  };
  std::vector<Reach> reaches;
  const Grid& of = study.grids[grid];
  for (std::size_t f = 0; f < of.factors.size(); ++f) {
    Reach reach{.name = of.factors[f].name};
    for (std::size_t level = 0; level < of.factors[f].levels.size(); ++level) {
      const double mean = mean_at(study, plan, analysis, grid, arm, measure, f, level);
      if (!std::isfinite(mean)) continue;
      reach.low = std::min(reach.low, mean);
      reach.high = std::max(reach.high, mean);
    }
    if (reach.low <= reach.high) reaches.push_back(reach);
  }
  if (reaches.empty()) return std::nullopt;
  std::ranges::stable_sort(reaches, {}, [](const Reach& reach) { return reach.high - reach.low; });
  const Measure& what = analysis.measures[measure];
  figure::Figure figure{.title = "What moves " + what.label,
                        .subtitle = study.arms[arm].name + (of.name.empty() ? "" : "; " + of.name),
                        .x = study.baseline ? figure::Axis{.label = "gain", .unit = "%"}
                                            : figure::Axis{.label = what.label, .unit = what.unit},
                        .y = {}};
  figure::Bars bars{.bars = {}, .width = 0.6, .horizontal = true};
  for (const Reach& reach : reaches) {
    bars.bars.push_back({static_cast<double>(figure.y.names.size()), reach.low, reach.high});
    figure.y.names.push_back(reach.name);
  }
  figure.layers = {bars};
  return figure;
}

}  // namespace

std::vector<Picture> scatters_of(const Study& study, const Plan& plan, const Outcome& outcome) {
  std::vector<Picture> pictures;
  if (!study.baseline) return pictures;
  for (std::size_t measure = 0; measure < std::min(kMeasures, study.measures.size()); ++measure) {
    std::vector<figure::Figure> panels;
    for (std::size_t grid = 0; grid < study.grids.size(); ++grid) {
      figure::Figure figure = figure_of_pairs(study, plan, outcome, grid, measure);
      if (!figure.layers.empty()) panels.push_back(std::move(figure));
    }
    if (panels.empty()) continue;
    const Measure& what = outcome.analysis.measures[measure];
    pictures.push_back({"pairs-" + slug(what.path), what.label,
                        "Each point is a pair of runs with the same seed, and so the same arrivals; below the line the "
                        "arm's " +
                            what.label + " is less.",
                        svg_of(panels, 2)});
  }
  return pictures;
}

std::vector<Picture> tornados_of(const Study& study, const Plan& plan, const Analysis& analysis) {
  std::vector<Picture> pictures;
  for (std::size_t measure = 0; measure < std::min(kMeasures, study.measures.size()); ++measure)
    for (std::size_t arm = 0; arm < study.arms.size(); ++arm) {
      std::vector<figure::Figure> panels;
      for (std::size_t grid = 0; grid < study.grids.size(); ++grid) {
        if (study.grids[grid].factors.size() < 2 || study.baseline == arm) continue;
        if (auto figure = tornado(study, plan, analysis, grid, arm, measure)) panels.push_back(std::move(*figure));
      }
      if (panels.empty()) continue;
      const Measure& what = analysis.measures[measure];
      std::string name = "tornado-" + slug(what.path);
      if (study.arms.size() > 2) name += "-" + slug(study.arms[arm].name);
      pictures.push_back(
          {std::move(name), what.label,
           "Sensitivities: from the least to the greatest mean over a factor's values, each mean over all "
           "values of the other factors.",
           svg_of(panels, 2)});
    }
  return pictures;
}

std::vector<Picture> pictures_of(const Study& study, const Plan& plan, const Outcome& outcome) {
  std::vector<Picture> pictures;
  for (auto kind : {maps_of(study, plan, outcome.analysis), curves_of(study, plan, outcome.analysis),
                    bars_of(study, plan, outcome.analysis), scatters_of(study, plan, outcome),
                    tornados_of(study, plan, outcome.analysis), courses_of(study, plan, outcome)}) {
    for (Picture& picture : kind) pictures.push_back(std::move(picture));
  }
  return pictures;
}

}  // namespace lukou::studies
