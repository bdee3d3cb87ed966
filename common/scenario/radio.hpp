#pragma once

#include "common/radio/link_model.hpp"

namespace lukou::scenario {

class Scenario;  // idl/scenario.proto

/// The radio of a resolved scenario, for the modems. It is modelled as soon as the scenario says anything of a link,
/// of the load or of outages; a link that it does not speak of is then ideal.
RadioParameters radio_parameters(const Scenario& scenario);

}  // namespace lukou::scenario
