#include <google/protobuf/text_format.h>

#include "common/scenario/scenario.hpp"
#include "common/scenario/schema.hpp"

namespace lukou::scenario {
namespace {

using google::protobuf::FieldDescriptor;
using google::protobuf::Message;
using google::protobuf::TextFormat;

/// A plan is one value: it changes as a whole.
bool is_one_value(const FieldDescriptor* field) { return field->message_type() == SignalPlan::descriptor(); }

std::string value_text(const Message& message, const FieldDescriptor* field) {
  if (!has(message, field)) return "";
  TextFormat::Printer printer;
  printer.SetUseUtf8StringEscaping(true);
  printer.SetSingleLineMode(true);
  std::string text;
  printer.PrintFieldValueToString(message, field, -1, &text);
  return field->message_type() == nullptr ? text : "{" + text + "}";
}

LiveValue value_of(const Message& message, const FieldDescriptor* field, const FieldPath& path) {
  const FieldRule& said = rule_of(field);
  LiveValue live;
  live.path = text(path);
  live.unit = said.unit();
  live.value = value_text(message, field);
  if (said.has_min()) live.min = said.min();
  if (said.has_max()) live.max = said.max();
  live.source = said.source();
  if (field->enum_type() != nullptr) live.words = value_names(field->enum_type());
  if (field->cpp_type() == FieldDescriptor::CPPTYPE_BOOL) live.words = {"true", "false"};
  return live;
}

void collect(const Message& message, const FieldPath& path, bool live, std::vector<LiveValue>& values) {
  const auto* type = message.GetDescriptor();
  const auto* reflection = message.GetReflection();
  for (int i = 0; i < type->field_count(); ++i) {
    const FieldDescriptor* field = type->field(i);
    const bool this_live = live || rule_of(field).live();
    if (field->message_type() == nullptr || is_one_value(field)) {
      if (this_live && !field->is_repeated()) values.push_back(value_of(message, field, extended(path, field)));
    } else if (field->is_repeated()) {
      for (int n = 0; n < reflection->FieldSize(message, field); ++n) {
        collect(reflection->GetRepeatedMessage(message, field, n), extended(path, field, n), this_live, values);
      }
    } else {
      collect(reflection->GetMessage(message, field), extended(path, field), this_live, values);
    }
  }
}

}  // namespace

std::vector<LiveValue> live_values(const Resolved& scenario) {
  std::vector<LiveValue> values;
  collect(scenario.message(), {}, false, values);
  return values;
}

std::vector<NamedPlan> signal_presets() {
  const auto named = [](SignalPreset preset, lukou::SignalPlan plan) {
    return NamedPlan{SignalPreset_Name(preset), std::move(plan)};
  };
  return {named(PAPER, paper_plan()), named(PAPER_YELLOW, paper_yellow_plan()),
          named(PROTECTED_LEFT, protected_left_plan())};
}

}  // namespace lukou::scenario
