#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "common/core/expected.hpp"
#include "common/results/manifest.hpp"

namespace lukou::results {

/// Something that is wrong with a result folder.
struct Fault {
  std::string where;  ///< file or file:line
  std::string what;
  bool repairable = false;  ///< repair() mends it; what it cuts away is lost

  [[nodiscard]] std::string text() const { return where + ": " + what; }
};

/// What a result folder holds.
struct Inspection {
  std::optional<Manifest> manifest;
  Step complete_to_step = 0;  ///< up to which step all tables of steps are whole
  std::vector<Fault> faults;  ///< in the order of the files' names within each kind

  [[nodiscard]] bool sound() const { return faults.empty(); }
  [[nodiscard]] bool repairable() const;
};

/// Looks at a result folder without touching it. Error only if it is no folder that can be read.
Expected<Inspection> inspect(const std::filesystem::path& folder);

/// For a folder whose recorder is gone: cuts torn rows and rows beyond the last step that all tables have, removes
/// files that were being written, and writes the manifest from what is left. Of `facts` the version, hash, seed,
/// planned steps, ended_by and culprit are used. Returns the manifest that it wrote.
Expected<Manifest> repair(const std::filesystem::path& folder, const Manifest& facts);

/// Name, hash and rows of every result file in the folder, sorted by name. The manifest, files about the wall clock
/// (timing.json, operator.log), report.html and unfinished files do not count.
Expected<std::vector<FileEntry>> result_files(const std::filesystem::path& folder);

}  // namespace lukou::results
