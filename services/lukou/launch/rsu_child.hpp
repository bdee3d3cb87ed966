#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "services/lukou/launch/child.hpp"

namespace lukou::launch {

/// A user's command as RSU number `rsu`, by way of a shell. `variables`: where it finds its run ("NAME=value"); beside
/// them it learns its number, and where Python finds the module `lukou`.
ChildSpec rsu_child(std::uint32_t rsu, const std::string& command, std::vector<std::string> variables);

}  // namespace lukou::launch
