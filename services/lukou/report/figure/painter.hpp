#pragma once

#include <vector>

#include "services/lukou/report/figure/layout.hpp"

namespace lukou::figure {

/// Draws a figure's layers into its plot, the first first.
void draw_layers(Svg& svg, const Layout& layout, const std::vector<Layer>& layers);

/// Draws what stands before a name in the legend.
void draw_symbol(Svg& svg, const Frame& frame, const LegendEntry& entry);

}  // namespace lukou::figure
