#pragma once

// Inside this room only.

#include "common/scenario/schema.hpp"

namespace lukou::scenario {

/// Fills what the radio's links leave open from the preset that it names. A link that has a latency of one form gets
/// nothing of a preset's other form. Car to car is filled if the scenario speaks of it. IDEAL, an unknown preset and
/// none leave the links as they are.
void apply_radio_preset(Radio& radio);
/// True for constant_ms, uniform and gamma of a latency: one of them, never two.
bool is_latency_arm(const google::protobuf::FieldDescriptor* field);
/// True for a value without a fallback whose absence means something.
bool may_be_absent(const google::protobuf::FieldDescriptor* field);

}  // namespace lukou::scenario
