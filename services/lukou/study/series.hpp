#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "common/core/expected.hpp"
#include "common/core/step.hpp"
#include "services/lukou/study/statistics/warm_up.hpp"

namespace lukou::studies {

/// How a run went on over time: what the warm-up is judged by, taken from its tables before they are dropped.
struct RunSeries {
  double interval_s = 0.0;          ///< a fifth of the signal's cycle, so that five are a whole one
  statistics::Series standing_veh;  ///< standing cars, mean over the steps of each interval
  statistics::Series crossed_veh;   ///< cars that crossed a stop line in each interval
};

inline constexpr const char* kSeriesFile = "series.csv";

/// The series of a run from stop.csv and road.csv in its result folder; an interval that the end cuts short is left
/// out. Requires interval >= 1 step.
Expected<RunSeries> series_of(const std::filesystem::path& result, Step interval);

/// As a table: from_s,standing_veh,crossed_veh.
std::string text(const RunSeries& series);
/// Reads text() from a file.
Expected<RunSeries> read_series(const std::filesystem::path& file);

}  // namespace lukou::studies
