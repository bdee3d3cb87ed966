#include "common/scenario/scenario.hpp"
#include "common/scenario/schema.hpp"
#include "common/scenario/wording.hpp"

namespace lukou::scenario {
namespace {

using google::protobuf::FieldDescriptor;

std::string type_text(const FieldDescriptor* field) {
  switch (field->cpp_type()) {
    case FieldDescriptor::CPPTYPE_MESSAGE:
      return "message";
    case FieldDescriptor::CPPTYPE_ENUM:
      return joined(value_names(field->enum_type()), " | ");
    case FieldDescriptor::CPPTYPE_BOOL:
      return "true or false";
    case FieldDescriptor::CPPTYPE_STRING:
      return "text";
    case FieldDescriptor::CPPTYPE_DOUBLE:
      return "number";
    default:
      return "whole number";
  }
}

}  // namespace

std::vector<FieldDoc> field_docs() { return field_docs(*Scenario::descriptor()); }

std::vector<FieldDoc> field_docs(const google::protobuf::Descriptor& type) {
  std::vector<FieldDoc> docs;
  for_each_field(&type, "", [&](const std::string& path, const FieldDescriptor* field) {
    // A message without a rule only groups its fields.
    if (field->message_type() != nullptr && !field->options().HasExtension(rule)) return;
    const FieldRule& said = rule_of(field);
    FieldDoc doc{path, type_text(field), said.unit(), {}, {}, said.fallback(), said.source(), said.live(), false};
    if (said.has_min()) doc.min = said.min();
    if (said.has_max()) doc.max = said.max();
    doc.on_step_grid = on_step_grid(field);
    docs.push_back(std::move(doc));
  });
  return docs;
}

}  // namespace lukou::scenario
