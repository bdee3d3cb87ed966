#pragma once

// Inside this room only: Protobuf's text format with errors for people.

#include <google/protobuf/text_format.h>

#include <string>
#include <vector>

#include "common/scenario/schema.hpp"

namespace lukou::scenario {

/// Something that the parser did not like.
struct ParseIssue {
  int line = 0;    ///< from 1; 0 if it concerns the whole
  int column = 0;  ///< from 1
  std::string what;
};

/// Parses `text` into `message` and notes in `places` where each field stands. Empty if all is well; every unknown
/// field is reported, but only the first error of syntax.
std::vector<ParseIssue> parse(const std::string& text, google::protobuf::Message& message,
                              google::protobuf::TextFormat::ParseInfoTree& places);

/// Parses one value, in text format, into a field: sets a singular field, appends to a repeated one.
std::vector<ParseIssue> parse_value(const std::string& value, const google::protobuf::FieldDescriptor* field,
                                    google::protobuf::Message& message);

}  // namespace lukou::scenario
