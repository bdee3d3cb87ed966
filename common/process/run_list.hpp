#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "common/bus/participant.hpp"
#include "common/core/expected.hpp"

namespace lukou::process {

/// A run that a launcher on this host (network namespace) keeps going.
struct ListedRun {
  std::string run;
  int domain = -1;
  Incarnation clock = 0;
  bool secured = false;  ///< only who has an identity reaches it
  bool hosts = false;    ///< spread over several hosts: only who names its peers reaches it
};
/// A launcher binds the abstract Unix socket of this name as long as its run lasts: so runs are found, and
/// whoever takes part on this host knows whom to believe.
std::string socket_name(const ListedRun& run);

/// Runs of this host (network namespace), by name.
std::vector<ListedRun> list_runs();
/// Where the run of that name is, or the only one whose name begins so. `given`: identity, peers and domain (-1: not
/// given) of who wants to reach it; with a domain, a run that is not listed here is one of another host.
/// Errors: what runs there are; a secured run and no identity, or the reverse; a run on several hosts and no peers.
Expected<bus::Address> find_run(const std::string& name, const bus::Address& given);

/// The clock of a run that was started on this host; 0 if there is none.
Incarnation clock_of(const bus::Address& address);

/// The abstract Unix sockets in this network namespace whose names begin with `prefix`, without it.
std::vector<std::string> bound_names(std::string_view prefix);

}  // namespace lukou::process
