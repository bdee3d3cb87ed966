#pragma once

#include <map>
#include <set>
#include <string>

#include "common/bus/participant.hpp"
#include "common/lockstep/roster.hpp"

namespace lukou::process {

/// Who takes part in a run beside this process, as the clock's rosters and fences say; so whose samples count.
class Fellows {
 public:
  using Roster = std::map<Incarnation, std::string>;  ///< roles

  /// Those who take part from now on; whoever was there before and is not now has taken part.
  void take(const Roster& roster);
  /// The run goes on without the RSU that has this role.
  void fence(const std::string& role);
  /// This one sends what nobody can use: not one more of its samples counts. False if that was known.
  bool distrust(Incarnation incarnation) { return distrusted_.insert(incarnation).second; }

  [[nodiscard]] const Roster& roster() const { return roster_; }
  /// Empty if it does not take part.
  [[nodiscard]] std::string role_of(Incarnation incarnation) const;
  /// What a reader of the topic does with what this one says.
  [[nodiscard]] bus::Belief belief(Topic topic, Incarnation incarnation) const;

 private:
  Roster roster_;
  std::set<Incarnation> former_;
  std::set<Incarnation> distrusted_;
  bool known_ = false;  ///< a roster has come
};

}  // namespace lukou::process
