#include "services/lukou/study/series.hpp"

#include <charconv>
#include <cmath>

#include "common/core/contract.hpp"
#include "common/results/table.hpp"
#include "common/results/table_reader.hpp"
#include "common/results/tables.hpp"

namespace lukou::studies {
namespace {

namespace fs = std::filesystem;
using Cells = std::vector<std::string_view>;

constexpr const char* kColumns = "from_s,standing_veh,crossed_veh,mean_stop_time_s";

double number(std::string_view cell) {
  double value = 0.0;
  std::from_chars(cell.data(), cell.data() + cell.size(), value);
  return value;
}

Expected<Done> scan(const fs::path& table, const results::RowCheck& take) {
  const auto scanned = results::scan_table(table, take);
  if (!scanned) return scanned.error();
  if (!scanned.value().wrong.empty() || scanned.value().torn_bytes > 0) {
    return Error{table.string() + ":" + std::to_string(scanned.value().good_rows + 2),
                 scanned.value().wrong.empty() ? "the row is torn" : scanned.value().wrong};
  }
  return Done{};
}

}  // namespace

Expected<RunSeries> series_of(const fs::path& result, Step interval) {
  LUKOU_EXPECT(interval >= 1);
  RunSeries series;
  series.interval_s = time_s(interval);
  // Columns by their place from the end: step,time_s,<12 lanes>,system_total,mean_per_vehicle,standing_now
  // and step,time_s,<12 lanes>,left_lanes_total,mean_per_lane,left_system_total
  // and step,time_s,<12 lanes>,system_total_s,mean_per_vehicle_s.
  double standing = 0.0;
  const auto stops = scan(result / results::kStopTable, [&](const Cells& cells, std::int64_t row) {
    standing += number(cells.back());
    if (row % interval == 0) {
      series.standing_veh.push_back(standing / static_cast<double>(interval));
      standing = 0.0;
    }
    return std::string();
  });
  if (!stops) return stops.error();
  double before = 0.0;
  const auto crossings = scan(result / results::kRoadTable, [&](const Cells& cells, std::int64_t row) {
    if (row % interval == 0) {
      const double crossed = number(cells[cells.size() - 3]);
      series.crossed_veh.push_back(crossed - before);
      before = crossed;
    }
    return std::string();
  });
  if (!crossings) return crossings.error();
  const auto times = scan(result / results::kStopTimeTable, [&](const Cells& cells, std::int64_t row) {
    if (row % interval == 0) series.mean_stop_time_s.push_back(number(cells.back()));
    return std::string();
  });
  if (!times) return times.error();
  return series;
}

std::optional<double> settling_time_s(const RunSeries& series) {
  constexpr double kBand = 0.05;
  const statistics::Series& running = series.mean_stop_time_s;
  if (running.empty()) return std::nullopt;
  std::size_t settled = running.size();
  while (settled > 0 && std::abs(running[settled - 1] - running.back()) <= kBand * std::abs(running.back())) --settled;
  return static_cast<double>(settled + 1) * series.interval_s;
}

std::string text(const RunSeries& series) {
  std::string text = std::string(kColumns) + "\n";
  for (std::size_t i = 0; i < series.standing_veh.size(); ++i) {
    text += results::real_text(static_cast<double>(i) * series.interval_s) + "," +
            results::real_text(series.standing_veh[i]) + "," + results::real_text(series.crossed_veh[i]) + "," +
            results::real_text(series.mean_stop_time_s[i]) + "\n";
  }
  return text;
}

Expected<RunSeries> read_series(const fs::path& file) {
  RunSeries series;
  const auto read = scan(file, [&](const Cells& cells, std::int64_t row) {
    if (row == 2) series.interval_s = number(cells[0]);
    series.standing_veh.push_back(number(cells[1]));
    series.crossed_veh.push_back(number(cells[2]));
    series.mean_stop_time_s.push_back(number(cells[3]));
    return std::string();
  });
  if (!read) return read.error();
  return series;
}

}  // namespace lukou::studies
