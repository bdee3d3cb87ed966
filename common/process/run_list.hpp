#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "common/core/expected.hpp"

namespace lukou::process {

/// A launcher binds the abstract Unix socket "<prefix><run>/<domain>" as long as its run lasts: so runs are found.
inline constexpr std::string_view kRunSocketPrefix = "lukou/run/";

struct ListedRun {
  std::string run;
  int domain = -1;
};
/// Runs of this host (network namespace), by name.
std::vector<ListedRun> list_runs();
/// The run of that name, or the only one whose name begins so. The error lists what there is.
Expected<ListedRun> find_run(const std::string& name);

/// The abstract Unix sockets in this network namespace whose names begin with `prefix`, without it.
std::vector<std::string> bound_names(std::string_view prefix);

}  // namespace lukou::process
