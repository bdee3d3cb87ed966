#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/core/expected.hpp"
#include "common/core/step.hpp"

namespace lukou::results {

inline constexpr const char* kManifest = "manifest.json";
/// What `lukou report` makes of a result folder, inside it: no part of the result.
inline constexpr const char* kReportPage = "report.html";

/// A file of a result folder.
struct FileEntry {
  std::string name;
  std::string sha256;
  std::optional<std::int64_t> rows;  ///< of a table, its header not counted

  friend bool operator==(const FileEntry&, const FileEntry&) = default;
};

/// What a result folder is: manifest.json.
struct Manifest {
  std::string lukou_version;
  std::string scenario_hash;
  std::uint64_t seed = 0;
  Step steps_planned = 0;
  Step complete_to_step = 0;     ///< every table is whole up to and with this step
  std::string ended_by;          ///< done, stopped, interrupted, anomaly:<what>, lost:<role>, stalled:<role> or disk
  std::string culprit;           ///< for people; empty if nobody is to blame
  std::vector<FileEntry> files;  ///< sorted by name; not the manifest, timing.json, operator.log and report.html

  friend bool operator==(const Manifest&, const Manifest&) = default;
};

bool is_ended_by(std::string_view text);

/// manifest.json: keys in a fixed order, numbers exact.
std::string text(const Manifest& manifest);
/// Reads text(). `origin` names it in errors.
Expected<Manifest> parse_manifest(const std::string& text, const std::string& origin);

}  // namespace lukou::results
