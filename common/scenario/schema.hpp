#pragma once

// Inside this room only: what the schema says about a field.

#include <google/protobuf/descriptor.h>
#include <google/protobuf/message.h>

#include <functional>
#include <string>
#include <vector>

#include "scenario.pb.h"

namespace lukou::scenario {

/// One step of a path into a scenario.
struct PathSegment {
  const google::protobuf::FieldDescriptor* field = nullptr;
  int index = -1;  ///< place in a repeated field; -1 in a singular one

  friend bool operator==(const PathSegment&, const PathSegment&) = default;
};
using FieldPath = std::vector<PathSegment>;

FieldPath extended(const FieldPath& path, const google::protobuf::FieldDescriptor* field, int index = -1);
/// The field of that name in the message type at the end of `path`. Requires that it exists.
FieldPath extended(const FieldPath& path, const char* field, int index = -1);
/// The path of these names from the root, all singular. Requires that they exist.
FieldPath path_to(const std::vector<const char*>& names);
/// "rsus[0].arrive_on_green.headway_s"; "" for the root.
std::string text(const FieldPath& path);
bool begins_with(const FieldPath& path, const FieldPath& prefix);

const FieldRule& rule_of(const google::protobuf::FieldDescriptor* field);
bool has_fallback(const google::protobuf::FieldDescriptor* field);
/// True for a field that must be a multiple of a step, 0.1 s.
bool on_step_grid(const google::protobuf::FieldDescriptor* field);
/// True for flow_veh_per_h, flow_series and arrivals_csv of a demand: one of them, never two.
bool is_demand_arm(const google::protobuf::FieldDescriptor* field);
/// Whether a singular field is present or a repeated one is not empty.
bool has(const google::protobuf::Message& message, const google::protobuf::FieldDescriptor* field);
/// Number of elements of a repeated field, 1 or 0 of a singular message.
int count(const google::protobuf::Message& message, const google::protobuf::FieldDescriptor* field);
/// Element of a message field; index is -1 in a singular one.
const google::protobuf::Message& element(const google::protobuf::Message& message,
                                         const google::protobuf::FieldDescriptor* field, int index);

std::vector<std::string> field_names(const google::protobuf::Descriptor* type);
/// Names of an enum without its first, the unspecified one.
std::vector<std::string> value_names(const google::protobuf::EnumDescriptor* type);
/// What a field takes: "a number [m]", "one of RED, YELLOW, GREEN".
std::string expectation(const google::protobuf::FieldDescriptor* field);
/// " veh/h", or nothing for a field without a unit.
std::string unit_text(const google::protobuf::FieldDescriptor* field);

using FieldVisitor = std::function<void(const std::string& path, const google::protobuf::FieldDescriptor* field)>;
/// Every field below a message type in the order of the schema, messages before their fields; "rsus[].algorithm".
void for_each_field(const google::protobuf::Descriptor* type, const std::string& prefix, const FieldVisitor& visit);

}  // namespace lukou::scenario
