#include "tests/system/secured_run.hpp"

#include <sstream>

#include "common/bus/cyclone_config.hpp"
#include "common/bus/surroundings.hpp"

namespace lukou::test {

std::string real_access_control() { return bus::security_plugins().value() + "/libdds_security_ac.so"; }

std::string strangers_config(const std::string& run, bool secured, const std::filesystem::path& identity,
                             const std::string& access_control) {
  const bus::Identity his{.folder = identity};
  std::string config = bus::cyclone_config(
      {.run = run, .identity = identity.empty() ? nullptr : &his, .plugins = bus::security_plugins().value()});
  const auto replace = [&](const std::string& from, const std::string& to) {
    if (const auto at = config.find(from); at != std::string::npos) config.replace(at, from.size(), to);
  };
  if (!access_control.empty()) replace(real_access_control(), access_control);
  // Without an identity he takes the tag from the wire.
  replace("<Tag>" + bus::discovery_tag(run, !identity.empty()), "<Tag>" + bus::discovery_tag(run, secured));
  return config;
}

Foothold foothold(const std::string& output, const std::string& what) {
  Foothold found;
  const auto at = output.find(what + " created ");
  if (at == std::string::npos) return found;
  std::istringstream words(output.substr(at + what.size()));
  std::string word;
  words >> word >> found.created >> word >> found.matched >> word >> found.count;
  return found;
}

}  // namespace lukou::test
