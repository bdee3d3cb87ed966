#pragma once

// Inside this room only.

#include <string>
#include <vector>

#include "common/scenario/schema.hpp"

namespace lukou::scenario {

/// Something wrong with a parsed scenario.
struct Finding {
  FieldPath path;               ///< the field that it is about
  std::vector<FieldPath> also;  ///< other fields that would mend it
  std::string what;             ///< begins with the path
  std::string where;            ///< place in another file; empty: the place of `path`
};

/// Everything that is wrong, field by field, with a scenario whose defaults have been filled in; crossing streams that
/// are green together and the contents of traces included.
std::vector<Finding> check(const Scenario& scenario);

}  // namespace lukou::scenario
