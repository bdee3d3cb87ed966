#include "common/lockstep/roster.hpp"

#include <charconv>

#include "common/lockstep/messages.hpp"

namespace lukou {

std::string rsu_role(std::uint32_t rsu) { return "rsu" + std::to_string(rsu); }

int rsu_index(std::string_view role) {
  if (!role.starts_with("rsu")) return -1;
  int value = -1;
  const auto [end, error] = std::from_chars(role.data() + 3, role.data() + role.size(), value);
  return error == std::errc() && end == role.data() + role.size() ? value : -1;
}

std::vector<std::string> roles_of_a_run(std::uint32_t rsus) {
  std::vector<std::string> roles = {std::string(kEngineRole), std::string(kControllerRole), std::string(kRecorderRole)};
  for (std::uint32_t i = 0; i < rsus; ++i) roles.push_back(rsu_role(i));
  return roles;
}

bool writes(std::string_view role, Topic topic) {
  switch (topic) {
    case Topic::kControl:
      return role == kClockRole;
    case Topic::kUp:
      return role != kClockRole;
    case Topic::kTraffic:
    case Topic::kAir:
      return role == kEngineRole;
    case Topic::kSignal:
      return role == kControllerRole;
    case Topic::kRoadside:
    case Topic::kRequest:
      return rsu_index(role) >= 0;
  }
  return false;
}

bool reads(std::string_view role, Topic topic) {
  const bool is_rsu = rsu_index(role) >= 0;
  switch (topic) {
    case Topic::kControl:
      return role != kClockRole;
    case Topic::kUp:
      return role == kClockRole;
    case Topic::kTraffic:
      return role == kRecorderRole;
    case Topic::kAir:
      return is_rsu;
    case Topic::kSignal:
      return role == kEngineRole || is_rsu || role == kRecorderRole;
    case Topic::kRoadside:
      return role == kEngineRole;
    case Topic::kRequest:
      return role == kControllerRole;
  }
  return false;
}

std::string_view name(RunPhase phase) {
  switch (phase) {
    case RunPhase::kForming:
      return "forming";
    case RunPhase::kRunning:
      return "running";
    case RunPhase::kPaused:
      return "paused";
    case RunPhase::kEnding:
      return "ending";
    case RunPhase::kEnded:
      return "ended";
    case RunPhase::kAborted:
      return "aborted";
  }
  return "unknown";
}

}  // namespace lukou
