#include "common/scenario/radio_preset.hpp"

#include <google/protobuf/text_format.h>

#include "common/core/contract.hpp"

namespace lukou::scenario {
namespace {

using google::protobuf::FieldDescriptor;

/// What a preset says of each link, in text format; null: nothing. Sources: docs/radio.md.
const char* link_text(RadioPreset preset) {
  switch (preset) {
    case PC5_MODE4:
      return "latency { uniform { min_ms: 4 max_ms: 100 } }";
    case DSRC_SNS:
      return "latency { uniform { min_ms: 0.4 max_ms: 2.4 } } range_m: 509.4";
    case UU_4G_EDGE:
      return "latency { gamma { min_ms: 15 mean_ms: 30 } }";
    case UU_5G_EDGE:
      return "latency { gamma { min_ms: 5 mean_ms: 12 } }";
    case HARSH:
      return "latency { gamma { min_ms: 50 mean_ms: 150 } } loss { burst { rate: 0.2 mean_length: 8 } } "
             "duplicate_rate: 0.01";
    default:
      return nullptr;
  }
}

const FieldDescriptor* arm_of(const Latency& latency) {
  const auto* type = Latency::descriptor();
  for (int i = 0; i < type->field_count(); ++i) {
    if (is_latency_arm(type->field(i)) && has(latency, type->field(i))) return type->field(i);
  }
  return nullptr;
}

void fill_link(Link& link, const Link& preset) {
  Link filled = preset;
  const FieldDescriptor* given = arm_of(link.latency());
  if (given != nullptr && given != arm_of(preset.latency())) filled.clear_latency();
  filled.MergeFrom(link);
  link = filled;
}

}  // namespace

bool is_latency_arm(const FieldDescriptor* field) { return field->containing_type() == Latency::descriptor(); }

void apply_radio_preset(Radio& radio) {
  const char* text = link_text(radio.preset());
  if (text == nullptr) return;
  Link preset;
  LUKOU_EXPECT(google::protobuf::TextFormat::ParseFromString(text, &preset));
  fill_link(*radio.mutable_uplink(), preset);
  fill_link(*radio.mutable_downlink(), preset);
}

}  // namespace lukou::scenario
