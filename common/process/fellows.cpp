#include "common/process/fellows.hpp"

namespace lukou::process {

void Fellows::take(const Roster& roster) {
  for (const auto& [incarnation, role] : roster_)
    if (!roster.contains(incarnation)) former_.insert(incarnation);
  roster_ = roster;
  known_ = true;
}

void Fellows::fence(const std::string& role) {
  std::erase_if(roster_, [&](const auto& fellow) {
    if (fellow.second != role) return false;
    former_.insert(fellow.first);
    return true;
  });
}

std::string Fellows::role_of(Incarnation incarnation) const {
  const auto found = roster_.find(incarnation);
  return found == roster_.end() ? "" : found->second;
}

bus::Belief Fellows::belief(Topic topic, Incarnation incarnation) const {
  // Before it knows the others a process has no part in what they say.
  if (!known_ || former_.contains(incarnation) || distrusted_.contains(incarnation)) return bus::Belief::kIgnored;
  return writes(role_of(incarnation), topic) ? bus::Belief::kYes : bus::Belief::kForeign;
}

}  // namespace lukou::process
