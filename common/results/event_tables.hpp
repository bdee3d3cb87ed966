#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/core/expected.hpp"
#include "common/measures/rows.hpp"
#include "common/results/manifest.hpp"
#include "common/results/table.hpp"

namespace lukou::results {

inline constexpr const char* kStopsTable = "stops.csv";
inline constexpr const char* kGuidanceTable = "guidance.csv";
inline constexpr const char* kRequestsTable = "requests.csv";
inline constexpr const char* kSafetyTable = "safety.csv";

/// Header lines.
std::string stops_columns();
std::string guidance_columns();
std::string requests_columns();
std::string safety_columns();

/// "accepted", "deferred", "overruled", "refused" or "ended".
std::string_view name_of(RequestOutcome outcome);
/// The rule that deferred, overruled or refused: "min_green", ...; otherwise empty.
std::string_view rule_of(RequestOutcome outcome);

/// The tables that hold a row per event, as far as the scenario asks for them. Rows come in the order of the steps in
/// which they were complete: of a stop its end, of an advice its final fate.
class EventTables {
 public:
  struct Asked {
    bool stops = false;
    bool guidance = false;
    bool requests = false;
    bool safety = false;
  };
  static Expected<EventTables> create(const std::filesystem::path& folder, const Asked& asked);

  /// Rows for a table that was not asked for are dropped.
  void add(const FinishedStop& row);
  void add(const SettledAdvice& row);
  void add(const RequestRow& row);
  void add(const MissedDeadline& row);
  void add(const Encounter& row);

  Expected<Done> flush();
  Expected<Done> sync();
  [[nodiscard]] std::size_t buffered_bytes() const;
  /// Name, hash and rows of each table as flushed, for the manifest.
  [[nodiscard]] std::vector<FileEntry> entries() const;

 private:
  EventTables() = default;

  std::optional<TableWriter> stops_;
  std::optional<TableWriter> guidance_;
  std::optional<TableWriter> requests_;
  std::optional<TableWriter> safety_;
};

}  // namespace lukou::results
