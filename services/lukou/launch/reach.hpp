#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "common/core/expected.hpp"
#include "services/lukou/launch/child.hpp"

namespace lukou::launch {

/// Where a run's processes are and how they reach each other.
struct Reach {
  std::vector<std::string> peers;  ///< addresses of the run's hosts; none: loopback
  std::filesystem::path keys;      ///< folder of `lukou keys`, absolute; empty: an unsecured run
  /// By role: words in front of its command, which start it elsewhere ("ip netns exec b", "ssh host").
  std::map<std::string, std::vector<std::string>> prefix_of;

  /// A process of this role finds the others by these variables ("NAME=value").
  [[nodiscard]] std::vector<std::string> environment(const std::string& role) const;
  [[nodiscard]] std::filesystem::path identity(const std::string& role) const;
};

/// Reads "ROLE=COMMAND", each role once. Errors: no such role in a run with so many RSUs, no command, a second one; a
/// role that works in the result folder on another host.
Expected<std::map<std::string, std::vector<std::string>>> prefixes(const std::vector<std::string>& texts,
                                                                   std::uint32_t rsus);

/// The child as its prefix starts it. Behind ssh, `leash` (the program `lukou`) keeps it: it dies with the connection.
ChildSpec behind(const std::vector<std::string>& prefix, const std::filesystem::path& leash, ChildSpec child);

}  // namespace lukou::launch
