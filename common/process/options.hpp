#pragma once

#include <map>
#include <string>
#include <vector>

#include "common/bus/participant.hpp"
#include "common/core/expected.hpp"

namespace lukou::process {

/// An option of a member program beside --run, --domain, --identity and --peers.
struct OptionRule {
  std::string name;  ///< "--out"
  std::string help;
  bool flag = false;  ///< takes no value
};

/// Every member's way into a debugger.
inline const OptionRule kNoWatchdog = {"--no-watchdog", "no deadline: wait for the clock for ever", true};

struct MemberOptions {
  bus::Address address;
  std::map<std::string, std::string> values;  ///< by name; flags that were given have the value "true"

  [[nodiscard]] bool has(const std::string& name) const { return values.contains(name); }
  [[nodiscard]] std::string value(const std::string& name) const { return has(name) ? values.at(name) : ""; }
};

/// Reads the command line of a member program. --run, --domain, --identity and --peers default to LUKOU_RUN,
/// LUKOU_DOMAIN, LUKOU_IDENTITY and LUKOU_PEERS.
/// Prints the help or the usage error itself: then the error holds the exit code as text.
Expected<MemberOptions> member_options(int argc, char** argv, const std::string& about,
                                       const std::vector<OptionRule>& rules);

}  // namespace lukou::process
