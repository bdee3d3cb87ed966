#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace lukou::bus {

/// Topics of the bus that a role may write and read, by their names there.
struct Rights {
  std::vector<std::string> publish;
  std::vector<std::string> subscribe;
};
Rights rights_of(std::string_view role);

}  // namespace lukou::bus
