#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace lukou::architecture {

/// One line of a file as the rules see it.
struct Line {
  std::size_t number = 0;  ///< from 1
  std::string raw;
  std::string code;  ///< without comments and without what stands in quotes
};

/// What an #include names.
struct Include {
  std::size_t line = 0;
  std::string name;
  bool quoted = false;  ///< "name", not <name>
};

struct SourceFile {
  std::string path;  ///< from the root of the project, with '/'
  std::vector<Line> lines;

  [[nodiscard]] bool in(const std::string& folder) const { return path.starts_with(folder + "/"); }
  [[nodiscard]] bool is_code() const { return path.ends_with(".cpp") || path.ends_with(".hpp"); }
  [[nodiscard]] std::vector<Include> includes() const;
};

SourceFile source_file(const std::string& path, const std::string& text);

/// Every text file under the named folders of the project, sorted by path.
std::vector<SourceFile> read_tree(const std::filesystem::path& root, const std::vector<std::string>& folders);

}  // namespace lukou::architecture
