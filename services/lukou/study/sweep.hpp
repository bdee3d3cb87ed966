#pragma once

#include <functional>
#include <string>

#include "services/lukou/study/database.hpp"
#include "services/lukou/study/runner.hpp"

namespace lukou::studies {

/// What makes runs: this computer or a cluster. Returns the signal that stopped it, or 0.
using MakeRuns = std::function<Expected<int>(const StudyFolder& folder, const std::vector<RunKey>& runs)>;

/// Makes the runs that the study's folder lacks, round after round if it has a precision. `begin` is told the runs of
/// each round. Returns the signal that stopped it, or 0.
Expected<int> make_missing_runs(const StudyFolder& folder, const MakeRuns& make);

/// Judges what is in the folder and writes everything that is made of it: study.sqlite, CSV, pictures, report.html.
Expected<Outcome> write_report(const StudyFolder& folder);

}  // namespace lukou::studies
