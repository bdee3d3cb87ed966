#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "common/core/expected.hpp"
#include "common/measures/rows.hpp"
#include "common/results/manifest.hpp"
#include "common/results/table.hpp"

namespace lukou::results {

inline constexpr const char* kStopsTable = "stops.csv";
inline constexpr const char* kGuidanceTable = "guidance.csv";

/// Header lines.
std::string stops_columns();
/// `kinds`: with what kind each advice is and which speed it asks for.
std::string guidance_columns(bool kinds = false);
/// Those that the folder's guidance.csv has; without kinds if it is not whole.
std::string guidance_columns_in(const std::filesystem::path& folder);

/// The tables that hold a row per event, as far as the scenario asks for them. Rows come in the order of the steps in
/// which they were complete: of a stop its end, of an advice its final fate.
class EventTables {
 public:
  struct Asked {
    bool stops = false;
    bool guidance = false;
    bool advice_kinds = false;
  };
  static Expected<EventTables> create(const std::filesystem::path& folder, const Asked& asked);

  /// Rows for a table that was not asked for are dropped.
  void add(const FinishedStop& row);
  void add(const SettledAdvice& row);
  void add(const MissedDeadline& row);

  Expected<Done> flush();
  Expected<Done> sync();
  [[nodiscard]] std::size_t buffered_bytes() const;
  /// Name, hash and rows of each table as flushed, for the manifest.
  [[nodiscard]] std::vector<FileEntry> entries() const;

 private:
  EventTables() = default;

  std::optional<TableWriter> stops_;
  std::optional<TableWriter> guidance_;
  bool advice_kinds_ = false;
};

}  // namespace lukou::results
