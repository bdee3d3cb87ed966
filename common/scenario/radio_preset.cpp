#include "common/scenario/radio_preset.hpp"

#include <google/protobuf/text_format.h>

#include "common/core/contract.hpp"

namespace lukou::scenario {
namespace {

using google::protobuf::FieldDescriptor;

constexpr double kAwareness_m = 150.0;  // assumed: cars that matter to each other

/// What a preset says of each link, in text format; null: nothing. Sources: docs/radio.md.
const char* link_text(RadioPreset preset) {
  switch (preset) {
    case PC5_MODE4:
      return "latency { uniform { min_ms: 4 max_ms: 100 } redraw: RESERVATION } path_loss { law: TR_37885 } "
             "half_duplex: true collisions: true";
    case NR_V2X:
      return "latency { uniform { min_ms: 2 max_ms: 20 } redraw: RESERVATION } path_loss { law: TR_37885 } "
             "half_duplex: true collisions: true";
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

bool is_latency_arm(const FieldDescriptor* field) {
  return field->containing_type() == Latency::descriptor() && field->name() != "redraw";
}

bool may_be_absent(const FieldDescriptor* field) {
  return field == Outage::descriptor()->FindFieldByName("rsu") ||
         field == Radio::descriptor()->FindFieldByName("awareness_m") ||
         field == Computing::descriptor()->FindFieldByName("declared_ms");
}

void apply_radio_preset(Radio& radio) {
  if (radio.has_vehicle_to_vehicle() && !radio.has_awareness_m()) radio.set_awareness_m(kAwareness_m);
  const char* text = link_text(radio.preset());
  if (text == nullptr) return;
  Link preset;
  LUKOU_EXPECT(google::protobuf::TextFormat::ParseFromString(text, &preset));
  fill_link(*radio.mutable_uplink(), preset);
  fill_link(*radio.mutable_downlink(), preset);
  if (radio.has_vehicle_to_vehicle()) fill_link(*radio.mutable_vehicle_to_vehicle(), preset);
  if (preset.collisions()) radio.mutable_load();  // of the defaults, where the scenario says nothing
}

}  // namespace lukou::scenario
