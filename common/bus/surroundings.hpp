#pragma once

#include <string>

#include "common/core/expected.hpp"

namespace lukou::bus {

/// Address of this host's interface that faces `peer` (an address or a name; this host itself too).
/// Errors: the name is unknown, or no route.
Expected<std::string> own_address_towards(const std::string& peer);

/// Folder of Cyclone's DDS Security plugins: they lie beside the library itself. Errors: not installed.
Expected<std::string> security_plugins();

}  // namespace lukou::bus
