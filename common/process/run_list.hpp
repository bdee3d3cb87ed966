#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "common/bus/participant.hpp"
#include "common/core/expected.hpp"

namespace lukou::process {

/// A launcher binds the abstract Unix socket "<prefix><run>/<domain>/<clock>" as long as its run lasts: so runs are
/// found, and whoever takes part on this host knows whom to believe.
inline constexpr std::string_view kRunSocketPrefix = "lukou/run/";
std::string run_socket_name(const std::string& run, int domain, Incarnation clock);

struct ListedRun {
  std::string run;
  int domain = -1;
  Incarnation clock = 0;
};
/// Runs of this host (network namespace), by name.
std::vector<ListedRun> list_runs();
/// The run of that name, or the only one whose name begins so. The error lists what there is.
Expected<ListedRun> find_run(const std::string& name);

/// The clock of a run that was started on this host; 0 if there is none.
Incarnation clock_of(const bus::Address& address);

/// The abstract Unix sockets in this network namespace whose names begin with `prefix`, without it.
std::vector<std::string> bound_names(std::string_view prefix);

}  // namespace lukou::process
