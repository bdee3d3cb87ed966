#include "common/scenario/defaults.hpp"

#include "common/core/contract.hpp"
#include "common/scenario/parse.hpp"
#include "common/scenario/radio_preset.hpp"

namespace lukou::scenario {
namespace {

using google::protobuf::Descriptor;
using google::protobuf::FieldDescriptor;
using google::protobuf::Message;

/// Whether something else that is present stands in the place of an absent field.
bool is_replaced(const Message& message, const FieldDescriptor* field) {
  if (field == Signals::descriptor()->FindFieldByName("preset")) {
    return has(message, Signals::descriptor()->FindFieldByName("plan"));
  }
  if (!is_demand_arm(field)) return false;
  const Descriptor* demand = Demand::descriptor();
  for (int i = 0; i < demand->field_count(); ++i) {
    if (is_demand_arm(demand->field(i)) && has(message, demand->field(i))) return true;
  }
  return false;
}

/// A message is created when it is absent, unless it has a rule of its own: then its absence means something. The
/// parameters of an RSU's algorithm bear its name and are created if it is chosen.
bool is_created(const Message& message, const FieldDescriptor* field) {
  if (!field->options().HasExtension(rule)) return true;
  return message.GetDescriptor() == Rsu::descriptor() &&
         message.GetReflection()->GetString(message, Rsu::descriptor()->FindFieldByName("algorithm")) == field->name();
}

}  // namespace

void fill_fallbacks(Message& message) {
  const Descriptor* type = message.GetDescriptor();
  const auto* reflection = message.GetReflection();
  for (int i = 0; i < type->field_count(); ++i) {
    const FieldDescriptor* field = type->field(i);
    const bool is_message = field->message_type() != nullptr;
    if (field->is_repeated()) {
      for (int n = 0; is_message && n < reflection->FieldSize(message, field); ++n) {
        fill_fallbacks(*reflection->MutableRepeatedMessage(&message, field, n));
      }
    } else if (is_message) {
      if (has(message, field) || is_created(message, field))
        fill_fallbacks(*reflection->MutableMessage(&message, field));
    } else if (!has(message, field) && has_fallback(field) && !rule_of(field).kept_absent() &&
               !is_replaced(message, field)) {
      LUKOU_EXPECT(parse_value(rule_of(field).fallback(), field, message).empty());
    }
  }
}

void fill_defaults(Scenario& scenario) {
  if (scenario.rsus_size() == 0) scenario.add_rsus();
  if (scenario.has_radio()) apply_radio_preset(*scenario.mutable_radio());
  fill_fallbacks(scenario);
}

}  // namespace lukou::scenario
