#pragma once

#include <string>
#include <vector>

#include "common/bus/identity.hpp"

namespace lukou::bus {

/// What Cyclone has to know of a run.
struct CycloneSettings {
  std::string run;
  std::vector<std::string> peers;      ///< addresses of the run's hosts; none: this host's loopback alone
  std::string own_address;             ///< with peers: of the interface that faces them
  const Identity* identity = nullptr;  ///< null: an unsecured run
  std::string plugins;                 ///< with an identity: folder of the DDS Security plugins
  std::string users_uri;               ///< CYCLONEDDS_URI; "" = not set
};

/// Cyclone's configuration of a run: loopback or the run's hosts only, closed to other runs by a discovery tag, large
/// watermarks (no writer may block inside the loop). What the user's CYCLONEDDS_URI says is appended and
/// wins, the tag and the security excepted.
std::string cyclone_config(const CycloneSettings& settings);

/// Other runs' processes neither see nor hear those of this tag. Everybody on the wire can read it: that of a secured
/// run does not tell the run's id.
std::string discovery_tag(const std::string& run, bool secured);

}  // namespace lukou::bus
