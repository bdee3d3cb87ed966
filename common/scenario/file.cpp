#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <system_error>

#include "common/scenario/scenario.hpp"
#include "common/scenario/wording.hpp"

namespace lukou::scenario {
namespace {

namespace fs = std::filesystem;

/// Largest file that is read [bytes]; far above any scenario or trace.
constexpr std::uintmax_t kFileSizeMax = 256U << 20U;
constexpr const char* kExtension = ".textproto";

}  // namespace

Expected<std::string> read_file(const fs::path& file) {
  std::error_code code;
  const auto status = fs::status(file, code);
  if (code) return Error{"", "cannot read " + file.string() + ": " + code.message()};
  if (!fs::exists(status)) return Error{"", "cannot read " + file.string() + ": there is no such file"};
  if (!fs::is_regular_file(status)) return Error{"", "cannot read " + file.string() + ": it is no file"};
  const auto size = fs::file_size(file, code);
  if (code) return Error{"", "cannot read " + file.string() + ": " + code.message()};
  if (size > kFileSizeMax) return Error{"", "cannot read " + file.string() + ": it is larger than 256 MiB"};
  std::ifstream stream(file, std::ios::binary);
  std::string content(static_cast<std::size_t>(size), '\0');
  stream.read(content.data(), static_cast<std::streamsize>(content.size()));
  if (!stream || stream.gcount() != static_cast<std::streamsize>(content.size())) {
    return Error{"", "cannot read " + file.string() + ": " + std::strerror(errno)};
  }
  return content;
}

std::vector<fs::path> shipped_directories(Shipped kind) {
  std::vector<fs::path> directories;
  if (const char* set = std::getenv("LUKOU_SCENARIOS"); set != nullptr && *set != '\0') directories.emplace_back(set);
  std::error_code code;
  const fs::path program = fs::read_symlink("/proc/self/exe", code);
  if (!code) {
    const fs::path home = program.parent_path();
    directories.push_back((home / "../../launch_scripts/scenarios").lexically_normal());
    directories.push_back((home / "../share/lukou/scenarios").lexically_normal());
  }
  if (kind == Shipped::kScenario) return directories;
  for (fs::path& directory : directories) directory = (directory / "../studies").lexically_normal();
  return directories;
}

std::vector<std::string> shipped_names(Shipped kind) {
  std::vector<std::string> names;
  for (const fs::path& directory : shipped_directories(kind)) {
    std::error_code code;
    for (const auto& entry : fs::directory_iterator(directory, code)) {
      if (entry.path().extension() == kExtension) names.push_back(entry.path().stem().string());
    }
  }
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return names;
}

Expected<fs::path> find_file(const std::string& path_or_name, Shipped kind) {
  std::error_code code;
  if (fs::is_regular_file(path_or_name, code)) return fs::path(path_or_name);
  const bool bare = path_or_name.find('/') == std::string::npos && !path_or_name.ends_with(kExtension);
  if (!bare) return Error{path_or_name, "there is no such file"};
  for (const fs::path& directory : shipped_directories(kind)) {
    const fs::path file = directory / (path_or_name + kExtension);
    if (fs::is_regular_file(file, code)) return file;
  }
  const auto names = shipped_names(kind);
  return Error{path_or_name, std::string("is neither a file nor a shipped ") +
                                 (kind == Shipped::kScenario ? "scenario" : "study") +
                                 (names.empty() ? std::string() : suggestion(path_or_name, names))};
}

}  // namespace lukou::scenario
