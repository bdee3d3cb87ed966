#pragma once

// For this room and for others that read a text of their own by read_text(): what the rules in a schema say.

#include <string>
#include <vector>

#include "common/scenario/schema.hpp"

namespace lukou::scenario {

/// Something wrong with a parsed message.
struct Finding {
  FieldPath path;               ///< the field that it is about
  std::vector<FieldPath> also;  ///< other fields that would mend it
  std::string what;             ///< begins with the path
  std::string where;            ///< place in another file; empty: the place of `path`
};

/// What the rules of its fields say against a message whose defaults have been filled in: a value that is missing, out
/// of range, off the step grid, or no word of its enum.
std::vector<Finding> field_findings(const google::protobuf::Message& message);

}  // namespace lukou::scenario
