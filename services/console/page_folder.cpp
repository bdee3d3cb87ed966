#include "services/console/page_folder.hpp"

#include <array>
#include <fstream>
#include <iterator>
#include <optional>
#include <utility>

#include "common/core/hash.hpp"

namespace lukou::console {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kText = "text/plain; charset=utf-8";

/// The path below the folder that a target names; empty if it holds anything but plain names.
std::optional<std::string> plain_path(std::string_view target) {
  const std::string_view path = target.substr(0, target.find_first_of("?#"));
  if (path == "/") return "index.html";
  if (!path.starts_with('/')) return std::nullopt;
  std::string plain;
  for (const char c : path.substr(1)) {
    const bool letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
    if (!letter && c != '.' && c != '-' && c != '_' && c != '/') return std::nullopt;
    const bool begins_a_name = plain.empty() || plain.back() == '/';
    if (begins_a_name && (c == '.' || c == '/')) return std::nullopt;  // hidden, above, or nothing
    plain += c;
  }
  if (plain.empty() || plain.back() == '/') return std::nullopt;
  return plain;
}

std::optional<std::string> content(const fs::path& path) {
  std::error_code error;
  if (!fs::is_regular_file(path, error)) return std::nullopt;
  std::ifstream stream(path, std::ios::binary);
  if (!stream) return std::nullopt;
  return std::string(std::istreambuf_iterator<char>(stream), {});
}

}  // namespace

std::string_view type_of(std::string_view name) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 10> kTypes = {{
      {".html", "text/html; charset=utf-8"},
      {".js", "text/javascript; charset=utf-8"},
      {".css", "text/css; charset=utf-8"},
      {".svg", "image/svg+xml"},
      {".png", "image/png"},
      {".ico", "image/x-icon"},
      {".json", "application/json"},
      {".woff2", "font/woff2"},
      {".webmanifest", "application/manifest+json"},
      {".txt", kText},
  }};
  for (const auto& [end, type] : kTypes) {
    if (name.ends_with(end)) return type;
  }
  return "application/octet-stream";
}

PageFile PageFolder::file(std::string_view target) const {
  const auto path = plain_path(target);
  if (!path) return {.status = 404, .type = std::string(kText), .body = "There is no such file.\n"};
  if (auto body = content(folder_ / *path)) {
    std::string tag = sha256_hex(*body).substr(0, 32);
    return {.status = 200, .type = std::string(type_of(*path)), .body = std::move(*body), .tag = std::move(tag)};
  }
  if (*path != "index.html") return {.status = 404, .type = std::string(kText), .body = "There is no such file.\n"};
  return {.status = 404,
          .type = std::string(kText),
          .body = "The console's page is not built: run launch_scripts/setup.sh, which needs Node 18 or newer.\n"};
}

}  // namespace lukou::console
