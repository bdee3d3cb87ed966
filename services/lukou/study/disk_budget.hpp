#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "services/lukou/study/study_folder.hpp"

namespace lukou::studies {

/// Bytes that a study will write, estimated from its scenarios: so many a simulated step, so many a car. They are those
/// measured of full tables at 1800 veh/h on every approach, rounded up.
struct DiskNeed {
  double kept = 0.0;     ///< of all runs, once they are over
  double at_work = 0.0;  ///< of those at work at the same time, with all of their tables

  [[nodiscard]] double total() const { return kept + at_work; }
};
DiskNeed disk_need(const Study& study, const Plan& plan, const std::vector<RunKey>& runs, int jobs);

/// Error if the disk has less room than that. `said`: one line for people about need and room.
Expected<Done> check_disk(const StudyFolder& folder, const std::vector<RunKey>& runs, int jobs, std::string& said);

}  // namespace lukou::studies
