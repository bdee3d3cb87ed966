#pragma once

#include <filesystem>

#include "common/core/expected.hpp"
#include "common/core/step.hpp"
#include "services/lukou/report/result.hpp"

// Files of trajectories that other programs read. Errors of each: the file is there already, the disk, a record without
// cars. `period`: steps between two instants, as of period_of().

namespace lukou::report {

/// SUMO's floating car data: <fcd-export>. Lanes: W_2 (left) W_1 W_0 (right) before the line, WL_exit_0 behind it.
Expected<Done> write_fcd(const Result& result, Step period, const std::filesystem::path& file);

/// FHWA's SSAM, format 1.04, little endian, metric: links 1 ... 4 are the approaches W S E N with lanes 1 (left) 2 3,
/// 11
/// ... 22 what lies behind the lines of WL ... NR.
Expected<Done> write_ssam(const Result& result, Step period, const std::filesystem::path& file);

/// An MCAP file with /scene for the 3D panel of Foxglove: roads, heads and cars in frame "map", x to the east, y to the
/// north [m].
Expected<Done> write_foxglove(const Result& result, Step period, const std::filesystem::path& file);

}  // namespace lukou::report
