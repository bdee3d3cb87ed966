#pragma once

#include <vector>

#include "services/lukou/report/figure/figure.hpp"

namespace lukou::figure {

/// Where the grid of `contours` has the value `level`, by marching squares with linear interpolation: polylines, each
/// as long as it goes; the first point of a closed one is also its last.
std::vector<std::vector<Point>> isolines(const Contours& contours, double level);

}  // namespace lukou::figure
