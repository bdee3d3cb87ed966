#include "services/lukou/study/panels.hpp"

#include <algorithm>

namespace lukou::studies {

std::vector<Panel> panels_of(const Grid& grid, const std::vector<std::size_t>& drawn) {
  std::vector<Panel> panels = {{"", std::vector<std::size_t>(grid.factors.size(), 0)}};
  for (std::size_t f = 0; f < grid.factors.size(); ++f) {
    if (std::ranges::find(drawn, f) != drawn.end()) continue;
    std::vector<Panel> more;
    for (const Panel& panel : panels)
      for (std::size_t level = 0; level < grid.factors[f].levels.size(); ++level) {
        more.push_back(panel);
        more.back().levels[f] = level;
        more.back().title += (panel.title.empty() ? "" : ", ") + text(grid.factors[f], level);
      }
    panels = std::move(more);
  }
  return panels;
}

figure::Axis places_axis(const Factor& factor) {
  figure::Axis axis{.label = factor.name, .unit = factor.unit};
  for (const Level& level : factor.levels) axis.names.push_back(level.text);
  return axis;
}

figure::Axis numbers_axis(const Factor& factor) {
  if (!factor.numeric()) return places_axis(factor);
  return {.label = factor.name, .unit = factor.unit};
}

double place_of(const Factor& factor, std::size_t level) {
  return factor.numeric() ? *factor.levels[level].number : static_cast<double>(level);
}

std::string svg_of(const std::vector<figure::Figure>& panels, int columns) {
  return figure::svg_of(panels, std::min(columns, static_cast<int>(panels.size())));
}

std::string slug(const std::string& text) {
  std::string plain;
  for (const char c : text) {
    const bool letter =
        (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
    plain += letter ? c : '-';
  }
  return plain;
}

}  // namespace lukou::studies
