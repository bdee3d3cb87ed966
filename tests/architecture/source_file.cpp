#include "tests/architecture/source_file.hpp"

#include <algorithm>
#include <cctype>
#include <fstream>
#include <regex>
#include <sstream>

namespace lukou::architecture {
namespace {

/// Code of a line; `in_comment` tells whether a /* comment is open at its begin, and then at its end.
std::string code_of(const std::string& raw, bool& in_comment) {
  std::string code;
  char quote = '\0';
  for (std::size_t i = 0; i < raw.size(); ++i) {
    const char next = i + 1 < raw.size() ? raw[i + 1] : '\0';
    if (in_comment) {
      if (raw[i] == '*' && next == '/') in_comment = false, ++i;
    } else if (quote != '\0') {
      if (raw[i] == '\\') {
        ++i;
      } else if (raw[i] == quote) {
        quote = '\0';
        code += raw[i];
      }
    } else if (raw[i] == '/' && next == '/') {
      break;
    } else if (raw[i] == '/' && next == '*') {
      in_comment = true, ++i;
    } else {
      // An apostrophe between digits or letters parts a number: 10'000.
      const bool apart = raw[i] == '\'' && i > 0 && std::isalnum(static_cast<unsigned char>(raw[i - 1])) != 0;
      if (raw[i] == '"' || (raw[i] == '\'' && !apart)) quote = raw[i];
      code += raw[i];
    }
  }
  return code;
}

/// What a tool has written: installed packages, generated code, a built page, a lock file.
bool is_made(const std::filesystem::path& path) {
  const std::filesystem::path name = path.filename();
  return name == "node_modules" || name == "generated" || name == "dist" || name == "package-lock.json";
}

}  // namespace

SourceFile source_file(const std::string& path, const std::string& text) {
  SourceFile file{path, {}};
  std::istringstream stream(text);
  bool in_comment = false;
  for (std::string raw; std::getline(stream, raw);) {
    std::string code = code_of(raw, in_comment);
    file.lines.push_back({file.lines.size() + 1, raw, std::move(code)});
  }
  return file;
}

std::vector<Include> SourceFile::includes() const {
  static const std::regex kInclude(R"(^\s*#\s*include\s*([<"])([^>"]+)[>"])");
  std::vector<Include> found;
  for (const Line& line : lines) {
    std::smatch parts;
    // Comments must be gone, quotes must not.
    if (line.code.find("include") == std::string::npos || !std::regex_search(line.raw, parts, kInclude)) continue;
    found.push_back({line.number, parts[2], parts[1] == "\""});
  }
  return found;
}

std::vector<SourceFile> read_tree(const std::filesystem::path& root, const std::vector<std::string>& folders) {
  std::vector<SourceFile> files;
  for (const std::string& folder : folders) {
    if (!std::filesystem::exists(root / folder)) continue;
    const std::filesystem::recursive_directory_iterator tree(root / folder);
    for (auto entry = begin(tree); entry != end(tree); ++entry) {
      if (is_made(entry->path())) entry.disable_recursion_pending();
      if (!entry->is_regular_file() || is_made(entry->path())) continue;
      std::ifstream stream(entry->path(), std::ios::binary);
      std::ostringstream text;
      text << stream.rdbuf();
      if (text.str().find('\0') != std::string::npos) continue;  // a picture
      files.push_back(source_file(entry->path().lexically_relative(root).generic_string(), text.str()));
    }
  }
  std::ranges::sort(files, {}, &SourceFile::path);
  return files;
}

}  // namespace lukou::architecture
