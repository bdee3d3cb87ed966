#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tests/faults/session.hpp"

namespace lukou::faults {

/// In which way a run was not as it should be; the kinds are counted.
enum class Wrong : std::uint8_t {
  kHang,      ///< did not end by itself
  kExitCode,  ///< not the one that the scenario and the fault ask for, or the wrong culprit
  kOrphan,    ///< something was left behind
  kUnsound,   ///< `lukou inspect` finds the folder unsound, or the manifest says something else
  kLostRows,  ///< less in the tables than was recorded
  kTables,    ///< not the rows of the undisturbed run up to the stated step
  kReplay,    ///< the record does not reproduce the run
  kByHand,    ///< what was started by hand did not do as it should
};
inline constexpr int kWrongs = 8;
std::string name(Wrong wrong);

struct Complaint {
  Wrong wrong;
  std::string text;
};

struct Verdict {
  std::vector<Complaint> complaints;
  std::string ended;  ///< "done", "lost:rsu0", ...: what the manifest says
  Step complete_to = 0;
  Step planned = 0;
  std::uint32_t returned = 0;  ///< RSUs that were lost and heard again
};

/// Looks at a run and its folder. `scratch`: an empty folder for replays.
Verdict judge(const Plan& plan, const Observed& observed, const std::filesystem::path& folder,
              const std::filesystem::path& scratch);

}  // namespace lukou::faults
