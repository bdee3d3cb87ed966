#pragma once

#include <filesystem>
#include <string>

#include "common/core/expected.hpp"
#include "services/lukou/launch/run_request.hpp"

namespace lukou::launch {

/// Makes the result folder and puts the resolved scenario into it.
Expected<std::filesystem::path> create_result(const RunRequest& request);

/// How a run ended, as the launcher saw it.
struct RunEnd {
  int interrupted_by = 0;  ///< signal; 0 = none
  bool io_failed = false;  ///< the record could not be written
  bool anomaly = false;    ///< collision or overflow
  std::string culprit;     ///< role; empty unless somebody was lost or stalled
  std::string text;
  double wall_s = 0.0;
  double start_up_s = 0.0;
  std::uint64_t foreign_samples = 0;  ///< ignored, since nobody of the run had sent them
};

/// Completes the folder (manifest if the recorder could not, timing.json) and derives the exit code.
RunReport finish_result(const RunRequest& request, const std::filesystem::path& folder, const RunEnd& end);

}  // namespace lukou::launch
