#pragma once

#include <functional>
#include <vector>

#include "services/lukou/study/study_folder.hpp"

namespace lukou::studies {

struct RunnerOptions {
  int jobs = 1;     ///< runs at a time, at least 1
  bool pin = true;  ///< each to a processor of its own, as far as there are enough
};

/// What a progress display gets to see, a few times a second.
struct SweepNews {
  std::size_t done = 0;  ///< runs that are over in this session, failed ones too
  std::size_t total = 0;
  std::size_t failed = 0;
  std::size_t anomalies = 0;
  double wall_s = 0.0;
  double left_s = 0.0;  ///< going by the pace so far; 0 before the first run is over
};
using SweepListener = std::function<void(const SweepNews&)>;

/// Runs each in a `lukou run` of its own: what becomes of one does not touch the others. A run that crashed or hung is
/// tried once more; then it is marked as failed. Returns the signal that stopped it early, or 0; the runs that it
/// stopped have no marker. Errors: the folder cannot be written.
Expected<int> run_all(const StudyFolder& folder, const std::vector<RunKey>& runs, const RunnerOptions& options,
                      const SweepListener& listener);

}  // namespace lukou::studies
