#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>

#include "common/scenario/scenario.hpp"
#include "services/lukou/launch/reach.hpp"
#include "services/rsu/process/run_rsu.hpp"

namespace lukou::launch {

class ConsoleProcess;

/// One run as the command line asks for it.
struct RunRequest {
  scenario::Resolved scenario;
  std::string name;    ///< of the scenario, for the run id
  std::string run_id;  ///< empty: made from name, seed and a random part
  bool in_process = false;
  std::string pace = "max";
  std::filesystem::path out;                    ///< empty: result/<stamp>-<pace>
  std::string rsu;                              ///< "" = the shipped one, "wait" = started by hand, otherwise a command
  std::map<std::uint32_t, std::string> rsu_of;  ///< the same for single RSUs, by index
  /// In one process, by RSU: makes its algorithm; without one it runs that of the scenario.
  std::map<std::uint32_t, MakeAlgorithm> make_rsu;
  bool start_paused = false;
  bool watchdog = true;
  std::string stall_limit_s;          ///< empty: the clock's default
  std::filesystem::path replay;       ///< directives.textproto; empty: none
  bool observe = true;                ///< attach to the run's picture, for the progress bar
  ConsoleProcess* console = nullptr;  ///< shows the run; null: none
  std::optional<int> core;            ///< processor for the run's processes; empty: follows the domain id
  Reach reach;                        ///< hosts and keys
};

/// What is started as RSU number `rsu`, as in RunRequest::rsu.
inline const std::string& rsu_program(const RunRequest& request, std::uint32_t rsu) {
  const auto own = request.rsu_of.find(rsu);
  return own == request.rsu_of.end() ? request.rsu : own->second;
}

/// What happened.
struct RunReport {
  int exit_code = 0;
  std::filesystem::path folder;
  std::string ended;    ///< for people: "done", "stopped by the operator", "aborted: rsu0 was killed ..."
  long long steps = 0;  ///< executed and recorded
  double wall_s = 0.0;  ///< from step 0 to the end
  double start_up_s = 0.0;
  std::optional<std::uint64_t> restart;  ///< a viewer of the console wants the run anew, with this seed
};

/// What a progress display gets to see, a few times a second.
struct RunNews {
  std::string run;
  std::string phase;
  long long step = 0;
  long long end = 0;
  double wall_s = 0.0;            ///< since step 0
  long long cars_in_system = -1;  ///< -1: not known
  double pace = 0.0;              ///< asked; 0 = as fast as possible
};
using Listener = std::function<void(const RunNews&)>;

/// The run as processes on the bus.
RunReport run_processes(const RunRequest& request, const Listener& listener);
/// The same step functions in this process, by direct calls.
RunReport run_in_process(const RunRequest& request, const Listener& listener);

}  // namespace lukou::launch
