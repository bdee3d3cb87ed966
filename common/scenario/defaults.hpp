#pragma once

// Inside this room, but for fill_fallbacks(), which others need that read a text of their own.

#include "common/scenario/schema.hpp"

namespace lukou::scenario {

/// Fills in the radio's preset, gives every absent field that has one its fallback, and adds the one default RSU to a
/// scenario without RSUs. A demand that names a series or a trace gets no flow, signals with a plan get no preset.
void fill_defaults(Scenario& scenario);

/// Gives every absent field of a message that has one its fallback. An absent message stays absent if it has a rule of
/// its own: its absence means something.
void fill_fallbacks(google::protobuf::Message& message);

}  // namespace lukou::scenario
