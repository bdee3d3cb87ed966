#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "common/core/expected.hpp"

namespace lukou::results {

/// The folder of one run's results.
class ResultFolder {
 public:
  /// The folder that the user named: it must not exist, or be empty. Folders above it are made.
  static Expected<ResultFolder> create(const std::filesystem::path& folder);
  /// A new folder `<base>/<stamp>-<pace>`, or `...-2`, `...-3` if that name is taken. `stamp` is the time of the start,
  /// YYYYmmdd-HHMMSS; runs that start in the same second get folders of their own.
  static Expected<ResultFolder> create_new(const std::filesystem::path& base, std::string_view stamp,
                                           std::string_view pace);

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  /// Writes a whole file, or leaves the old one: under a temporary name, synced, then renamed.
  [[nodiscard]] Expected<Done> write_file(const std::string& name, std::string_view content) const;

 private:
  explicit ResultFolder(std::filesystem::path path) : path_(std::move(path)) {}
  std::filesystem::path path_;
};

/// Ending of a file that is being written.
inline constexpr std::string_view kUnfinished = ".unfinished";

/// As ResultFolder::write_file, for any folder.
Expected<Done> write_file(const std::filesystem::path& file, std::string_view content);

}  // namespace lukou::results
