#include "common/scenario/schema.hpp"

#include <algorithm>

#include "common/core/contract.hpp"
#include "common/scenario/wording.hpp"

namespace lukou::scenario {

using google::protobuf::Descriptor;
using google::protobuf::EnumDescriptor;
using google::protobuf::FieldDescriptor;
using google::protobuf::Message;

FieldPath extended(const FieldPath& path, const FieldDescriptor* field, int index) {
  FieldPath longer = path;
  longer.push_back({field, index});
  return longer;
}

FieldPath extended(const FieldPath& path, const char* field, int index) {
  const Descriptor* type = path.empty() ? Scenario::descriptor() : path.back().field->message_type();
  LUKOU_EXPECT(type != nullptr);
  const FieldDescriptor* found = type->FindFieldByName(field);
  LUKOU_EXPECT(found != nullptr);
  return extended(path, found, index);
}

FieldPath path_to(const std::vector<const char*>& names) {
  FieldPath path;
  for (const char* name : names) path = extended(path, name);
  return path;
}

std::string text(const FieldPath& path) {
  std::string text;
  for (const PathSegment& segment : path) {
    if (!text.empty()) text += '.';
    text += segment.field->name();
    if (segment.index >= 0) text += "[" + std::to_string(segment.index) + "]";
  }
  return text;
}

bool begins_with(const FieldPath& path, const FieldPath& prefix) {
  return path.size() >= prefix.size() && std::equal(prefix.begin(), prefix.end(), path.begin());
}

const FieldRule& rule_of(const FieldDescriptor* field) { return field->options().GetExtension(rule); }

bool has_fallback(const FieldDescriptor* field) { return !rule_of(field).fallback().empty(); }

bool on_step_grid(const FieldDescriptor* field) {
  static const std::vector<const FieldDescriptor*> kFields = {
      Run::descriptor()->FindFieldByName("duration_s"),
      Run::descriptor()->FindFieldByName("warmup_s"),
      SignalPlan::descriptor()->FindFieldByName("cycle_s"),
      SignalPlan::descriptor()->FindFieldByName("offset_s"),
      TimedAspect::descriptor()->FindFieldByName("duration_s"),
      Actuation::descriptor()->FindFieldByName("min_green_s"),
      Actuation::descriptor()->FindFieldByName("yellow_s"),
      Actuation::descriptor()->FindFieldByName("all_red_s"),
      Actuation::descriptor()->FindFieldByName("max_wait_s"),
      Outage::descriptor()->FindFieldByName("from_s"),
      Outage::descriptor()->FindFieldByName("to_s"),
  };
  return std::find(kFields.begin(), kFields.end(), field) != kFields.end();
}

bool is_demand_arm(const FieldDescriptor* field) {
  return field->containing_type() == Demand::descriptor() && field->name() != "shares";
}

bool has(const Message& message, const FieldDescriptor* field) {
  const auto* reflection = message.GetReflection();
  return field->is_repeated() ? reflection->FieldSize(message, field) > 0 : reflection->HasField(message, field);
}

int count(const Message& message, const FieldDescriptor* field) {
  const auto* reflection = message.GetReflection();
  if (field->is_repeated()) return reflection->FieldSize(message, field);
  return reflection->HasField(message, field) ? 1 : 0;
}

const Message& element(const Message& message, const FieldDescriptor* field, int index) {
  const auto* reflection = message.GetReflection();
  return index < 0 ? reflection->GetMessage(message, field) : reflection->GetRepeatedMessage(message, field, index);
}

std::vector<std::string> field_names(const Descriptor* type) {
  std::vector<std::string> names;
  for (int i = 0; i < type->field_count(); ++i) names.push_back(type->field(i)->name());
  return names;
}

std::vector<std::string> value_names(const EnumDescriptor* type) {
  std::vector<std::string> names;
  for (int i = 1; i < type->value_count(); ++i) names.push_back(type->value(i)->name());
  return names;
}

std::string expectation(const FieldDescriptor* field) {
  const std::string unit = rule_of(field).unit().empty() ? "" : " [" + rule_of(field).unit() + "]";
  switch (field->cpp_type()) {
    case FieldDescriptor::CPPTYPE_MESSAGE:
      return "{field: value ...}";
    case FieldDescriptor::CPPTYPE_ENUM:
      return "one of " + joined(value_names(field->enum_type()), ", ");
    case FieldDescriptor::CPPTYPE_BOOL:
      return "true or false";
    case FieldDescriptor::CPPTYPE_STRING:
      return "a text";
    case FieldDescriptor::CPPTYPE_DOUBLE:
      return "a number" + unit;
    default:
      return "a whole number of at least 0" + unit;
  }
}

std::string unit_text(const FieldDescriptor* field) {
  return rule_of(field).unit().empty() ? "" : " " + rule_of(field).unit();
}

void for_each_field(const Descriptor* type, const std::string& prefix, const FieldVisitor& visit) {
  for (int i = 0; i < type->field_count(); ++i) {
    const FieldDescriptor* field = type->field(i);
    const std::string path = prefix + field->name() + (field->is_repeated() ? "[]" : "");
    visit(path, field);
    if (field->message_type() != nullptr) for_each_field(field->message_type(), path + ".", visit);
  }
}

}  // namespace lukou::scenario
