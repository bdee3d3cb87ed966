#include "services/lukou/keys/key_folder.hpp"

#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>

#include "common/lockstep/roster.hpp"

namespace lukou::keys {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kAuthorityFolder = "authority";
constexpr double kAuthorityDays = 3650.0;
constexpr double kSoonDays = 14.0;
/// Computers of one run may disagree on the time.
constexpr double kClockSkewDays = 1.0 / 24.0;

bool is_role(const std::string& name) {
  const int rsu = rsu_index(name);
  if (rsu >= 0) return name == rsu_role(static_cast<std::uint32_t>(rsu));
  const auto fixed = roles(0);
  return std::ranges::find(fixed, name) != fixed.end();
}

/// A folder that only its owner may enter.
Expected<Done> make_folder(const fs::path& folder) {
  if (::mkdir(folder.c_str(), 0700) == 0) return Done{};
  return Error{folder.string(), std::string("cannot be made: ") + std::strerror(errno)};
}

Expected<Done> issue_with(const Authority& authority, const fs::path& folder, const std::string& role,
                          const Validity& validity) {
  // Beside the old one, so that a role never stands there half made.
  const fs::path fresh = folder / ("." + role + "-new");
  std::error_code failed;
  fs::remove_all(fresh, failed);
  if (auto done = make_folder(fresh); !done) return done;
  if (auto done = authority.issue(fresh, role, {validity.from - kClockSkewDays, validity.until}); !done) return done;
  fs::remove_all(folder / role, failed);
  fs::rename(fresh, folder / role, failed);
  if (failed) return Error{(folder / role).string(), "cannot be replaced: " + failed.message()};
  return Done{};
}

}  // namespace

std::vector<std::string> roles(std::uint32_t rsus) {
  std::vector<std::string> all = {std::string(kClockRole)};
  for (const std::string& role : roles_of_a_run(0)) all.push_back(role);
  all.emplace_back(kObserverRole);
  for (std::uint32_t rsu = 0; rsu < rsus; ++rsu) all.push_back(rsu_role(rsu));
  return all;
}

Expected<Done> may_make(const fs::path& folder) {
  std::error_code failed;
  if (!fs::exists(folder, failed) || (fs::is_directory(folder, failed) && fs::is_empty(folder, failed))) return Done{};
  return Error{folder.string(), "exists and is not an empty folder: keys are never overwritten"};
}

Expected<Done> make_keys(const fs::path& folder, std::uint32_t rsus, const Validity& validity) {
  if (auto free = may_make(folder); !free) return free;
  std::error_code failed;
  if (fs::create_directories(folder, failed); failed) return Error{folder.string(), failed.message()};
  if (::chmod(folder.c_str(), 0700) != 0) return Error{folder.string(), std::strerror(errno)};
  const auto authority = Authority::create({-kClockSkewDays, kAuthorityDays});
  if (!authority) return authority.error();
  if (auto done = make_folder(folder / kAuthorityFolder); !done) return done;
  if (auto done = authority.value().save(folder / kAuthorityFolder); !done) return done;
  for (const std::string& role : roles(rsus)) {
    if (auto done = issue_with(authority.value(), folder, role, validity); !done) return done;
  }
  return Done{};
}

Expected<Done> may_issue(const fs::path& folder, const std::string& role) {
  if (!is_role(role)) {
    std::string known;
    for (const std::string& one : roles(2)) known += one + ", ";
    return Error{role, "is no role; there are " + known + "..."};
  }
  const auto authority = Authority::open(folder / kAuthorityFolder);
  if (!authority) return authority.error();
  return Done{};
}

Expected<Done> issue(const fs::path& folder, const std::string& role, const Validity& validity) {
  if (auto may = may_issue(folder, role); !may) return may;
  const auto authority = Authority::open(folder / kAuthorityFolder);
  if (!authority) return authority.error();
  return issue_with(authority.value(), folder, role, validity);
}

Expected<std::vector<Found>> show(const fs::path& folder) {
  std::vector<std::string> names;
  std::error_code failed;
  for (const auto& entry : fs::directory_iterator(folder, failed)) {
    if (is_role(entry.path().filename())) names.push_back(entry.path().filename());
  }
  if (names.empty()) return Error{folder.string(), "is no folder of keys; `lukou keys init " + folder.string() + "`"};
  const auto fixed = roles(0);
  std::ranges::sort(names, {}, [&](const std::string& name) {
    return std::pair(std::ranges::find(fixed, name) - fixed.begin(), rsu_index(name));
  });
  std::vector<Found> found;
  for (const std::string& name : names) found.push_back({name, bus::open_identity(folder / name)});
  return found;
}

Expected<std::vector<std::string>> check(const fs::path& folder, std::uint32_t rsus) {
  std::vector<std::string> warnings;
  std::string authority;
  for (const std::string& role : roles(rsus)) {
    std::error_code failed;
    if (!fs::is_directory(folder / role, failed)) {
      return Error{(folder / role).string(), "is missing; `lukou keys issue " + folder.string() + " " + role +
                                                 "` makes it, `lukou keys init` a whole folder"};
    }
    const auto identity = bus::open_identity(folder / role);
    if (!identity) return identity.error();
    if (identity.value().role != role) {
      return Error{(folder / role).string(), "is the identity of " + identity.value().role};
    }
    if (authority.empty()) authority = identity.value().authority;
    if (identity.value().authority != authority) {
      return Error{(folder / role).string(),
                   "was signed by " + identity.value().authority + ", others by " + authority};
    }
    if (identity.value().days_left < kSoonDays) {
      warnings.push_back((folder / role).string() + " expires in " +
                         std::to_string(std::lround(std::floor(identity.value().days_left))) + " days");
    }
  }
  return warnings;
}

}  // namespace lukou::keys
