#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "common/core/expected.hpp"
#include "common/core/step.hpp"
#include "services/lukou/study/statistics/warm_up.hpp"

namespace lukou::studies {

/// How a run went on over time: what the warm-up is judged by, taken from its tables before they are dropped.
struct RunSeries {
  double interval_s = 0.0;              ///< a fifth of the signal's cycle, so that five are a whole one
  statistics::Series standing_veh;      ///< standing cars, mean over the steps of each interval
  statistics::Series crossed_veh;       ///< cars that crossed a stop line in each interval
  statistics::Series mean_stop_time_s;  ///< per car that has entered, since step 0, at the end of each interval
};

inline constexpr const char* kSeriesFile = "series.csv";

/// When the running mean stop time came within 5 % of its last value for good [s]: how the paper's figure 6 is read.
/// None of an empty series.
std::optional<double> settling_time_s(const RunSeries& series);

/// The series of a run from stop.csv, road.csv and stop_time.csv in its result folder; an interval that the end cuts
/// short is left out. Requires interval >= 1 step.
Expected<RunSeries> series_of(const std::filesystem::path& result, Step interval);

/// As a table: from_s,standing_veh,crossed_veh,mean_stop_time_s.
std::string text(const RunSeries& series);
/// Reads text() from a file.
Expected<RunSeries> read_series(const std::filesystem::path& file);

}  // namespace lukou::studies
