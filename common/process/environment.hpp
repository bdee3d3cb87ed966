#pragma once

#include <string>

#include "common/lockstep/messages.hpp"

// The only wall clock, sleep, signals and random device of the project.

namespace lukou::process {

/// Exit codes of every program (docs/results.md).
enum ExitCode : int {
  kExitDone = 0,
  kExitInternal = 1,       ///< also: `verify`, `redrive` or `compare` found a difference
  kExitUsage = 2,          ///< usage or scenario error
  kExitAborted = 3,        ///< a participant was lost or stalled
  kExitAnomaly = 4,        ///< collision or overflow: the simulation itself ended the run
  kExitIo = 5,             ///< input or output failed
  kExitFailedRuns = 6,     ///< a sweep with failed runs
  kExitInterrupted = 130,  ///< Ctrl-C
  kExitTerminated = 143,   ///< SIGTERM
};

/// Monotonic wall time [s], any origin.
double wall_s();
/// Wall time as "20261122-093015", local time.
std::string wall_stamp();
void sleep_s(double duration_s);
/// A number that no other process start will have.
Incarnation new_incarnation();

/// From now on SIGINT, SIGTERM, SIGHUP and launcher_died_signal() only set a flag.
void catch_stop_signals();
/// By this signal the launcher tells a run's processes that their clock has died.
int clock_died_signal();
/// By this signal the kernel tells a run's processes that their launcher has died.
int launcher_died_signal();
/// From now on SIGINT is ignored (children of the launcher: Ctrl-C is the launcher's business); SIGTERM,
/// clock_died_signal() and launcher_died_signal() set a flag.
void catch_terminate_signal();
/// The last stop signal received, 0 if none.
int stop_signal();
/// Whether a SIGTERM came from the process that started this one. Known after catch_terminate_signal().
bool terminated_by_launcher();

}  // namespace lukou::process
