#pragma once

#include <optional>
#include <span>

namespace lukou {

/// When a running mean has settled: the first value from which on all lie within `share` of the last one, as its place
/// in the series. Values that are not finite (no car yet) lie outside. Empty: there is no last value. Requires a share
/// above 0. Source: the paper, figure 6, where the mean stop time has settled after about 1500 s; 5 % by the study.
std::optional<std::size_t> settled_from(std::span<const double> series, double share = 0.05);

}  // namespace lukou
