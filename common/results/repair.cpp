#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <system_error>

#include "common/core/contract.hpp"
#include "common/results/event_tables.hpp"
#include "common/results/inspection.hpp"
#include "common/results/result_folder.hpp"
#include "common/results/table_reader.hpp"
#include "common/results/tables.hpp"
#include "common/run_log/repair.hpp"
#include "common/run_log/run_log.hpp"

namespace lukou::results {
namespace {

namespace fs = std::filesystem;

struct StepTable {
  const char* name;
  std::string columns;
};

std::vector<StepTable> step_tables() {
  return {{kStopTable, stop_columns()}, {kRoadTable, road_columns()}, {kStopTimeTable, stop_time_columns()}};
}

Expected<Done> cut(const fs::path& file, std::int64_t bytes) {
  const int handle = ::open(file.c_str(), O_WRONLY | O_CLOEXEC);
  const bool cut_off = handle >= 0 && ::ftruncate(handle, bytes) == 0 && ::fsync(handle) == 0;
  const int code = errno;
  if (handle >= 0) ::close(handle);
  if (!cut_off) return Error{file.string(), std::string("cannot be cut: ") + std::strerror(code)};
  return Done{};
}

/// Gives a table that has no whole first line one; it has no rows then.
Expected<Done> with_columns(const fs::path& file, const std::string& columns) {
  std::error_code code;
  if (fs::is_regular_file(file, code)) {
    const auto scan = scan_table(file, [](const auto&, std::int64_t) { return std::string("is not read"); });
    if (!scan) return scan.error();
    if (scan.value().columns == columns) return Done{};
    if (!scan.value().columns.empty()) {
      return Error{file.string() + ":1", "has other columns than " + columns + "; it cannot be repaired"};
    }
  }
  return write_file(file, columns + "\n");
}

/// Cuts everything from the first row that is torn, wrong or not to be kept.
Expected<Done> keep_rows(const fs::path& file, const RowCheck& keep) {
  const auto scan = scan_table(file, keep);
  if (!scan) return scan.error();
  return cut(file, scan.value().good_bytes);
}

/// Wrong if the number in a cell is above the limit, or no number. An empty cell is not known and stays.
std::string above(std::string_view cell, double limit) {
  if (cell.empty()) return "";
  double number = 0.0;
  const auto result = std::from_chars(cell.data(), cell.data() + cell.size(), number);
  const bool fits = result.ec == std::errc{} && result.ptr == cell.data() + cell.size() && number <= limit;
  return fits ? "" : "is beyond the last step";
}

/// Which rows of a table may stay if the run is complete to `last`.
RowCheck kept_until(const std::string& name, const std::string& columns, Step last) {
  // Tables list what happened in the order of the steps, so what lies beyond the last one stands at the end.
  if (name == kCarTable) {
    // left_s is rounded to six decimals.
    constexpr std::size_t kLeft = 11;
    return [last](const auto& cells, std::int64_t) { return above(cells[kLeft], time_s(last) + 1e-6); };
  }
  if (columns.starts_with("step,")) {
    return [last](const auto& cells, std::int64_t) { return above(cells.front(), static_cast<double>(last)); };
  }
  return [](const auto&, std::int64_t) { return std::string(); };
}

Expected<Done> cut_tables(const fs::path& folder, const std::vector<std::string>& names, Step last) {
  for (const std::string& name : names) {
    if (!name.ends_with(".csv")) continue;
    const auto columns =
        scan_table(folder / name, [](const auto&, std::int64_t) { return std::string("is not read"); });
    if (!columns) return columns.error();
    const auto done = keep_rows(folder / name, kept_until(name, columns.value().columns, last));
    if (!done) return done;
  }
  return Done{};
}

}  // namespace

Expected<Manifest> repair(const fs::path& folder, const Manifest& facts) {
  LUKOU_EXPECT(is_ended_by(facts.ended_by));
  std::error_code code;
  if (!fs::is_directory(folder, code)) return Error{folder.string(), "is no result folder"};

  std::vector<Step> complete;
  for (const StepTable& table : step_tables()) {
    const auto done = with_columns(folder / table.name, table.columns);
    if (!done) return done.error();
    const auto scan = scan_table(folder / table.name, check_step_row);
    if (!scan) return scan.error();
    complete.push_back(scan.value().good_rows);
  }
  const auto cars = with_columns(folder / kCarTable, car_columns());
  if (!cars) return cars.error();
  for (const auto& [name, columns] : {std::pair(kStopsTable, stops_columns()),
                                      {kGuidanceTable, guidance_columns()},
                                      {kRequestsTable, requests_columns()},
                                      {kSafetyTable, safety_columns()}}) {
    if (!fs::is_regular_file(folder / name, code)) continue;  // the scenario did not ask for it
    if (auto named = with_columns(folder / name, columns); !named) return named.error();
  }

  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder, code)) names.push_back(entry.path().filename().string());
  if (code) return Error{folder.string(), "cannot be read: " + code.message()};
  for (const std::string& name : names) {
    if (name.ends_with(kUnfinished)) fs::remove(folder / name, code);
  }

  Manifest manifest = facts;
  manifest.complete_to_step = *std::min_element(complete.begin(), complete.end());
  const auto done = cut_tables(folder, names, manifest.complete_to_step);
  if (!done) return done.error();
  if (fs::is_regular_file(folder / run_log::kRunLog, code)) {
    if (auto log = run_log::repair(folder / run_log::kRunLog, manifest.complete_to_step); !log) return log.error();
  }
  auto files = result_files(folder);
  if (!files) return files.error();
  manifest.files = std::move(files).value();
  const auto written = write_file(folder / kManifest, text(manifest));
  if (!written) return written.error();
  return manifest;
}

}  // namespace lukou::results
