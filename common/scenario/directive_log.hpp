#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "common/core/directive.hpp"
#include "common/core/expected.hpp"

namespace lukou::scenario {

/// From this engine step on, the engine hears this start (epoch) of the RSU; 0 = it is silent.
struct Hearing {
  std::uint32_t rsu = 0;
  Step from = 0;
  std::uint32_t epoch = 0;
};

/// What makes a run differ from its scenario: with the scenario it reproduces the run byte for byte.
struct DirectiveLog {
  std::vector<Directive> sets;           ///< in the order in which they were accepted
  std::vector<Hearing> hearings;         ///< in the order of their steps
  std::optional<Step> stop;              ///< last step, if the operator ended the run
  std::vector<ComputingDelay> computed;  ///< of RSUs whose time is measured, those above 0, in the order of their steps
};

/// directives.textproto of a result folder. Errors: `file:line:column: what`.
Expected<DirectiveLog> load_directives(const std::filesystem::path& file);
std::string text(const DirectiveLog& log);

}  // namespace lukou::scenario
