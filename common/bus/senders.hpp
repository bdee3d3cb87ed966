#pragma once

#include <cstdint>
#include <map>
#include <set>

#include "common/lockstep/messages.hpp"

namespace lukou::bus {

/// A writer as DDS names it to a reader; never used again for another.
using WriterHandle = std::uint64_t;

/// Which process stands behind each writer of a topic. The samples themselves only say so; what counts is the
/// incarnation in the USER_DATA of the writer's own endpoint, and of several writers that claim the same one the first.
class Senders {
 public:
  /// Remembers a writer. `incarnation`: as its endpoint says, 0 if it says none.
  void add(WriterHandle writer, Incarnation incarnation) {
    if (writers_.contains(writer)) return;
    const bool first = incarnation != 0 && claimed_.insert(incarnation).second;
    writers_.emplace(writer, first ? incarnation : 0);
  }
  [[nodiscard]] bool knows(WriterHandle writer) const { return writers_.contains(writer); }
  /// Whose writer it is; 0 if that is not known, or if it claims to be somebody who has another one.
  [[nodiscard]] Incarnation of(WriterHandle writer) const {
    const auto found = writers_.find(writer);
    return found == writers_.end() ? 0 : found->second;
  }

 private:
  std::map<WriterHandle, Incarnation> writers_;
  std::set<Incarnation> claimed_;
};

}  // namespace lukou::bus
