#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "common/core/step.hpp"

namespace lukou::faults {

enum class Action : std::uint8_t {
  kKill,
  kTerminate,
  kInterrupt,  ///< SIGINT
  kHangUp,     ///< SIGHUP: the terminal is closed
  kStop,       ///< for ever
  kStopFor,    ///< stops it once and lets it go on
  kSlow,       ///< stops it again and again for moments
};

/// One thing that is done to a process of a run.
struct Fault {
  std::string victim;  ///< role, "console" or "lukou"
  Action action = Action::kKill;
  Step at = 0;                             ///< done once this step is seen ...
  double after_s = -1.0;                   ///< ... or, if not below 0, this long after the launch: while the run forms
  double stop_s = 0.0;                     ///< kStopFor, kSlow: length of a stop
  int stops = 1;                           ///< kSlow
  double restart_s = -1.0;                 ///< if not below 0: another one is started by hand this long afterwards
  [[nodiscard]] std::string text() const;  ///< "KILL rsu0 @312, again after 0.4 s"
};

/// A run and what is done to it, all of it drawn from one number.
struct Plan {
  std::uint64_t seed = 0;
  std::string scenario;  ///< shipped name
  std::string policy;    ///< run.on_rsu_loss
  std::string pace;
  Step steps = 0;
  std::uint32_t rsus = 1;
  bool console = false;
  std::vector<Fault> faults;  ///< in the order in which they are done

  /// Arguments of `lukou run` but for --out and --run-id.
  [[nodiscard]] std::vector<std::string> arguments() const;
};

Plan draw(std::uint64_t seed);

/// A well-mixed number for every place of a sequence (SplitMix64).
std::uint64_t mixed(std::uint64_t state);

}  // namespace lukou::faults
