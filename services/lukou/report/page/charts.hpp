#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>

#include "services/lukou/report/figure/figure.hpp"

namespace lukou::report {

/// A figure as data for the page's interactive charts, with its texts in both languages: lines over a common axis.
/// Empty: it shows what a chart of lines cannot. Requires that both are the same figure.
///
///     {"title": T, "subtitle": T, "x": T, "y": T, "yMin": number, "xMin": number, "xMax": number,
///      "lines": [{"name": T, "colour": "#0072b2", "dash": [5, 2], "steps": false, "x": [...], "y": [...]}],
///      "marks": [{"name": T, "at": number, "colour": "#..."}]}     with T = {"en": "...", "zh": "..."}
///
/// A null in y interrupts a line. Bounds that the figure leaves open are null.
std::optional<nlohmann::ordered_json> chart_of(const figure::Figure& english, const figure::Figure& chinese);

}  // namespace lukou::report
