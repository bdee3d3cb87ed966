#pragma once

#include <map>
#include <string>
#include <vector>

namespace lukou::test {

/// Peak memory by program [kB].
using Peaks = std::map<std::string, double>;

struct Timed {
  double steps_per_s = 0.0;
  double start_up_s = 0.0;
  double mean_vehicles = 0.0;     ///< on the road, mean over the run
  double vehicles_left = 0.0;     ///< by the end
  double advice_per_step = 0.0;   ///< sent by the RSU
  double memory_growth_kb = 0.0;  ///< of the process that grew most from a tenth of the wall time to the end
  Peaks peaks;
};

/// The paper's scenario at `flow_veh_per_h` on every approach, ratio 0.5; mode "processes" or "in-process"; `more`:
/// further arguments. The words that start it.
std::vector<std::string> speed_arguments(const std::string& mode, double duration_s,
                                         const std::vector<std::string>& more = {}, double flow_veh_per_h = 1800.0);

/// A run of those words on one core, from its start to its end. Ends this program with code 1 if the run does not end
/// well.
Timed timed_run(const std::vector<std::string>& arguments, int core);

/// Two such runs at once, one on each core: the sum of their steps per second.
double two_runs_steps_per_s(const std::vector<std::string>& arguments, int core, int other_core);

/// Vehicle updates per second of the traffic engine alone, one thread, 1800 veh/h on every approach, with noise.
double engine_updates_per_s(double duration_s);

}  // namespace lukou::test
