#pragma once

#include <cstdint>
#include <functional>
#include <memory>

#include "services/rsu/sdk/rsu_algorithm.hpp"

namespace lukou {

/// What an RSU knows before its first step.
struct RsuSetup {
  std::uint32_t index = 0;  ///< in the scenario's list `rsus`
  MapView map;
  double acceleration_max_mps2 = 0.0;  ///< of every car, both signs: a car refuses what is beyond
};

/// Makes the mind of an RSU. Never returns null; what it throws ends the process with code 1.
using MakeAlgorithm = std::function<std::unique_ptr<RsuAlgorithm>(const RsuSetup&)>;

/// The main function of an RSU that is a process of its own: joins the run that the command line or the environment
/// names (`lukou run SCENARIO --rsu PROGRAM` sets LUKOU_RUN, LUKOU_DOMAIN and LUKOU_RSU), executes its steps with the
/// algorithm, and leaves. Returns the exit code: 0 if the run ended well. An exception of the algorithm is printed and
/// ends the process with code 1; the run then ends as `run.on_rsu_loss` says.
int run_rsu(int argc, char** argv, const MakeAlgorithm& make);

/// The same, but an exception of the algorithm leaves as it is: for callers that print it themselves.
int run_rsu_throwing(int argc, char** argv, const MakeAlgorithm& make);

/// The same with the shipped algorithm that the scenario names.
int run_shipped_rsu(int argc, char** argv);

}  // namespace lukou
