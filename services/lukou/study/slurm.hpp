#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "services/lukou/study/runner.hpp"

namespace lukou::studies {

struct SlurmOptions {
  int array_size = 20;               ///< tasks of the job array; each makes its share of the runs, one after the other
  std::vector<std::string> options;  ///< for sbatch: "--partition=day"
};

/// What was handed to Slurm: an array that makes the runs, and a job that gathers once the array is over, well or not.
struct SlurmJobs {
  std::string array;
  std::string gathering;
  std::filesystem::path folder;  ///< of lists, script and logs, in the study's folder
};

/// Submits the runs as a job array. All nodes must see the study's folder and this program under the same paths. No
/// accounting database is needed: what a task has made is told by the markers of its runs. Errors: Slurm does not
/// answer, or jobs of an earlier submission still are at work.
Expected<SlurmJobs> submit(const StudyFolder& folder, const std::vector<RunKey>& runs, const SlurmOptions& options);

/// Waits until the gathering job is over. Returns the signal that stopped the waiting, not the jobs, or 0.
Expected<int> follow(const StudyFolder& folder, const SlurmJobs& jobs, const std::vector<RunKey>& runs,
                     const SweepListener& listener);

/// The runs that a task's list names and that have no result yet.
Expected<std::vector<RunKey>> runs_of_task(const StudyFolder& folder, const std::filesystem::path& list);

}  // namespace lukou::studies
