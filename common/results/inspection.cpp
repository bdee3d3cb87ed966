#include "common/results/inspection.hpp"

#include <algorithm>
#include <array>
#include <fstream>
#include <sstream>
#include <system_error>

#include "common/results/event_tables.hpp"
#include "common/results/result_folder.hpp"
#include "common/results/table_reader.hpp"
#include "common/results/tables.hpp"
#include "common/run_log/run_log_reader.hpp"

namespace lukou::results {
namespace {

namespace fs = std::filesystem;

std::string no_check(const std::vector<std::string_view>& /*cells*/, std::int64_t /*row*/) { return ""; }

bool is_table(const std::string& name) { return name.ends_with(".csv"); }

/// Compares a folder with what it should be.
class Inspector {
 public:
  explicit Inspector(fs::path folder) : folder_(std::move(folder)) {}

  Expected<Inspection> run() && {
    read_manifest();
    step_tables();
    table(kCarTable, car_columns(), no_check);
    event_tables();
    required_files();
    log_of_steps();
    const auto files = result_files(folder_);
    if (!files) return files.error();
    if (found_.manifest) compare(*found_.manifest, files.value());
    unfinished_files();
    return std::move(found_);
  }

 private:
  void add(const std::string& where, const std::string& what, bool repairable) {
    found_.faults.push_back({where, what, repairable});
  }

  void read_manifest() {
    std::ifstream stream(folder_ / kManifest, std::ios::binary);
    if (!stream) {
      add(kManifest, "is missing; the run was cut off", true);
      return;
    }
    std::ostringstream content;
    content << stream.rdbuf();
    const auto manifest = parse_manifest(content.str(), kManifest);
    if (manifest) {
      found_.manifest = manifest.value();
    } else {
      add(kManifest, manifest.error().what, false);
    }
  }

  /// Good rows of a table; nothing if it is missing or no such table.
  std::optional<std::int64_t> table(const std::string& name, const std::string& columns, const RowCheck& check) {
    const auto scan = scan_table(folder_ / name, check);
    if (!scan) {
      add(name, "is missing or " + scan.error().what, false);
      return std::nullopt;
    }
    const std::string next_line = name + ":" + std::to_string(scan.value().good_rows + 2);
    if (scan.value().columns != columns) {
      add(name + ":1", "has other columns than " + columns, scan.value().columns.empty());
      return std::nullopt;
    }
    if (!scan.value().wrong.empty()) add(next_line, scan.value().wrong, true);
    if (scan.value().torn_bytes > 0) {
      add(next_line, "the last row is torn, " + std::to_string(scan.value().torn_bytes) + " bytes", true);
    }
    return scan.value().good_rows;
  }

  void step_tables() {
    const std::array<std::pair<std::string, std::string>, 3> tables = {
        {{kRoadTable, road_columns()}, {kStopTable, stop_columns()}, {kStopTimeTable, stop_time_columns()}}};
    std::vector<std::int64_t> rows;
    for (const auto& [name, columns] : tables) {
      rows.push_back(table(name, columns, check_step_row).value_or(0));
    }
    found_.complete_to_step = *std::min_element(rows.begin(), rows.end());
    for (std::size_t i = 0; i < rows.size(); ++i) {
      if (rows[i] == found_.complete_to_step) continue;
      add(tables[i].first,
          "goes to step " + std::to_string(rows[i]) + ", but the tables are complete to step " +
              std::to_string(found_.complete_to_step) + " only",
          true);
    }
  }

  /// Tables that the scenario may leave out: their rows come in the order of their steps, none beyond the last one.
  void event_tables() {
    for (const auto& [name, columns] : {std::pair(kGuidanceTable, guidance_columns()),
                                        {kRequestsTable, requests_columns()},
                                        {kSafetyTable, safety_columns()},
                                        {kStopsTable, stops_columns()}}) {
      std::error_code code;
      if (!fs::is_regular_file(folder_ / name, code)) continue;
      Step before = 0;
      table(name, columns, [&](const std::vector<std::string_view>& cells, std::int64_t /*row*/) {
        return check_event_row(cells, found_.complete_to_step, before);
      });
    }
  }

  /// A log that a death has cut off may end before the tables, a whole one goes as far as they do.
  void log_of_steps() {
    std::error_code code;
    if (!fs::is_regular_file(folder_ / run_log::kRunLog, code)) return;
    const auto log = run_log::RunLogReader::open(folder_);
    if (!log) return add(run_log::kRunLog, log.error().what, false);
    if (!log.value().file().finished()) {
      add(run_log::kRunLog, "has no end; the run was cut off", true);
    }
    const Step last = log.value().last_step();
    if (last > found_.complete_to_step || (ended_whole() && last < found_.complete_to_step)) {
      add(run_log::kRunLog,
          "goes to step " + std::to_string(last) + ", the tables to step " + std::to_string(found_.complete_to_step),
          last > found_.complete_to_step);
    }
  }

  /// Whether the recorder could close everything.
  [[nodiscard]] bool ended_whole() const {
    return found_.manifest && (found_.manifest->ended_by == "done" || found_.manifest->ended_by == "stopped");
  }

  void required_files() {
    std::vector<std::string> names = {"scenario.textproto"};
    if (ended_whole()) names.insert(names.end(), {"directives.textproto", "summary.json"});
    std::sort(names.begin(), names.end());
    for (const std::string& name : names) {
      std::error_code code;
      if (!fs::is_regular_file(folder_ / name, code)) add(name, "is missing", false);
    }
  }

  void compare(const Manifest& manifest, const std::vector<FileEntry>& files) {
    if (manifest.complete_to_step != found_.complete_to_step) {
      add(kManifest,
          "says complete to step " + std::to_string(manifest.complete_to_step) + ", the tables are to step " +
              std::to_string(found_.complete_to_step),
          false);
    }
    if (manifest.ended_by == "done" && manifest.complete_to_step != manifest.steps_planned) {
      add(kManifest,
          "says done, but " + std::to_string(manifest.complete_to_step) + " of " +
              std::to_string(manifest.steps_planned) + " steps are there",
          false);
    }
    const auto named = [](const std::vector<FileEntry>& list, const std::string& name) {
      return std::find_if(list.begin(), list.end(), [&](const FileEntry& entry) { return entry.name == name; });
    };
    for (const FileEntry& entry : manifest.files) {
      const auto found = named(files, entry.name);
      if (found == files.end()) {
        add(entry.name, "stands in the manifest, but is missing", false);
      } else if (found->sha256 != entry.sha256) {
        add(entry.name, "is not what was written: its SHA-256 is not the manifest's", false);
      } else if (found->rows != entry.rows) {
        add(entry.name, "has another number of rows than the manifest says", false);
      }
    }
    for (const FileEntry& entry : files) {
      if (named(manifest.files, entry.name) == manifest.files.end()) {
        add(entry.name, "does not stand in the manifest", false);
      }
    }
  }

  void unfinished_files() {
    std::vector<std::string> names;
    std::error_code code;
    for (const auto& entry : fs::directory_iterator(folder_, code)) {
      if (entry.path().string().ends_with(kUnfinished)) names.push_back(entry.path().filename().string());
    }
    std::sort(names.begin(), names.end());
    for (const std::string& name : names) add(name, "was being written when the run was cut off", true);
  }

  fs::path folder_;
  Inspection found_;
};

}  // namespace

bool Inspection::repairable() const {
  return std::all_of(faults.begin(), faults.end(), [](const Fault& fault) { return fault.repairable; });
}

Expected<std::vector<FileEntry>> result_files(const fs::path& folder) {
  std::vector<FileEntry> files;
  std::error_code code;
  std::error_code ignored;  // what cannot be looked at is no result file
  for (const auto& entry : fs::directory_iterator(folder, code)) {
    const std::string name = entry.path().filename().string();
    const bool of_the_wall_clock = name == "timing.json" || name == "operator.log";
    const bool no_result = of_the_wall_clock || name == kManifest || name == kReportPage || name.ends_with(kUnfinished);
    if (no_result || !entry.is_regular_file(ignored)) continue;
    const auto hash = file_sha256(entry.path());
    if (!hash) return hash.error();
    FileEntry file{name, hash.value(), std::nullopt};
    if (is_table(name)) {
      const auto scan = scan_table(entry.path(), no_check);
      if (!scan) return scan.error();
      file.rows = scan.value().good_rows;
    }
    files.push_back(std::move(file));
  }
  if (code) return Error{folder.string(), "cannot be read: " + code.message()};
  std::sort(files.begin(), files.end(), [](const FileEntry& a, const FileEntry& b) { return a.name < b.name; });
  return files;
}

Expected<Inspection> inspect(const fs::path& folder) {
  std::error_code code;
  if (!fs::is_directory(folder, code)) return Error{folder.string(), "is no result folder"};
  return Inspector(folder).run();
}

}  // namespace lukou::results
