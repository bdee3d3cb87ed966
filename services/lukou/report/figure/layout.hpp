#pragma once

#include <string>
#include <vector>

#include "services/lukou/report/figure/svg.hpp"

namespace lukou::figure {

inline constexpr double kMargin_pt = 4.0;  ///< of the paper
inline constexpr double kTitle_pt = 9.0;
inline constexpr double kBold = 1.12;  ///< how much wider bold letters are
inline constexpr double kLabel_pt = 8.0;
inline constexpr double kTick_pt = 7.0;
inline constexpr double kTickLength_pt = 3.0;
inline constexpr double kLineHeight = 1.35;  ///< in type sizes
inline constexpr double kSymbol_pt = 18.0;   ///< width of a legend entry's symbol
inline constexpr double kBar_pt = 9.0;       ///< width of a colour scale's bar
inline constexpr double kTurn_deg = -35.0;   ///< of names that are too wide to stand beside each other

/// An entry of the legend and the layer that it stands for.
struct LegendEntry {
  std::string name;
  const Layer* layer = nullptr;
  bool hatched = false;  ///< it explains the layer's hatching
};

/// Where everything stands on the paper [pt].
struct Layout {
  Frame paper;
  Frame plot;
  std::vector<std::string> title;
  std::vector<std::string> subtitle;
  std::vector<std::vector<LegendEntry>> legend;  ///< by row
  double legend_top = 0.0;
  const ColourScale* scale = nullptr;  ///< whose bar stands at the right
  bool turned_names = false;           ///< of the x axis
  AxisScale x;
  AxisScale y;
  bool clipped = false;  ///< the content reaches beyond an axis that the user has cut

  [[nodiscard]] Point place(Point value) const {
    return {plot.left + x.share(value.x) * plot.width, plot.bottom() - y.share(value.y) * plot.height};
  }
};

Layout layout_of(const Figure& figure);

/// Width of a legend entry with its symbol and the room behind it.
double width_pt(const LegendEntry& entry);

/// About how many ticks a colour scale's bar has.
AxisScale bar_of(const ColourScale& scale);

}  // namespace lukou::figure
