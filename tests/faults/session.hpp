#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "common/lockstep/messages.hpp"
#include "tests/faults/plan.hpp"

namespace lukou::faults {

/// What came of one fault.
struct Done {
  bool hit = false;  ///< there was such a process
  bool forming = true;
  bool over = false;   ///< the run had ended, or was about to
  Step recorded = -1;  ///< what the clock said was recorded just before
  Step seen = -1;      ///< newest step that an observer had seen
  int restarted = -2;  ///< exit code of what was started by hand; -1 = it had to be killed; -2 = none was
  std::string said;    ///< its standard error
};

/// What was seen of a run from outside.
struct Observed {
  std::vector<Done> done;    ///< parallel to the plan's faults
  int code = -1;             ///< exit code of `lukou`; -1: it hung and was killed
  bool interrupted = false;  ///< ended with Ctrl-C at last: it waited for an RSU that never came, as it should
  std::string err;
  double wall_s = 0.0;
  std::vector<std::string> left;  ///< processes, sockets, shared memory, temporary files
};

/// Makes the run of the plan in `folder`, which must not exist, and does what the plan says.
Observed make_run(const Plan& plan, const std::filesystem::path& folder);

}  // namespace lukou::faults
