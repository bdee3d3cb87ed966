#pragma once

#include <cstddef>
#include <span>
#include <vector>

// When a simulation has settled.

namespace lukou::statistics {

/// Observations of one replication at equal distances.
using Series = std::vector<double>;

/// The mean over replications of each observation; as long as the shortest. Requires at least one.
Series mean_over_replications(std::span<const Series> replications);

/// What MSER-5 says of a series.
struct Truncation {
  std::size_t observations = 0;  ///< to leave out from the beginning, a multiple of 5
  bool settled = false;          ///< false: the cut lies in the second half, so the series is too short to tell
};

/// MSER-5: of the means Z of five observations each, leaves out the d first that make
/// sum over i > d of (Z_i - mean)^2 / (n - d)^2 the least. The last five means do not stand as a rest of their own.
/// Fewer than ten means: not settled, nothing left out. White, Cobb, Spratt (2000), Proc. Winter Simulation Conf. 755;
/// its judge among many: Hoad, Robinson, Davies (2010), J. Oper. Res. Soc. 61, 1577.
Truncation mser5(std::span<const double> series);

/// Welch's picture: a moving average over 2 window + 1 observations, over fewer, symmetrically, near the beginning; as
/// long as the series less window. Welch (1983), in: The Computer Performance Modeling Handbook.
Series welch_average(std::span<const double> series, std::size_t window);

}  // namespace lukou::statistics
