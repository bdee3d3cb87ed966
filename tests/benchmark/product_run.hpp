#pragma once

#include <sys/types.h>

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "tests/system/program.hpp"

namespace lukou::test {

/// Arguments of `lukou run paper` with one flow on every approach, without progress, its report as JSON; warm-up 2000
/// s.
std::vector<std::string> paper_arguments(const std::string& mode, double flow_veh_per_h, double equipped_ratio,
                                         double duration_s, int seed);

/// What `lukou run --json` printed. Ends this program with code 1 and the run's own words if the run did not end well.
nlohmann::json report_of(Program& ended, int exit_code);

/// Runs `lukou` with these arguments into a folder that is removed afterwards; its report. At most an hour.
nlohmann::json run_product(std::vector<std::string> arguments);

/// Memory of a process in kB by the kernel's name ("VmRSS": now, "VmHWM": its peak); 0 if the process is gone.
double memory_kb(pid_t process, const std::string& name);

}  // namespace lukou::test
