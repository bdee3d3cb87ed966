#pragma once

#include <string>
#include <vector>

#include "tests/system/program.hpp"

namespace lukou::test {

/// A short run whose bytes are known.
struct GoldenRun {
  std::string name;
  std::vector<std::string> arguments;  ///< of `lukou run`, the result folder excepted
  std::string golden;                  ///< what fingerprint() must give
};

/// The paper's scenario, and those that go where the paper does not.
const std::vector<GoldenRun>& golden_runs();

/// Runs `program` in one process and gives a line `NAME SHA256` for each result file, in the order of their names; the
/// manifest and the files about the wall clock do not count. If the run fails: what it said.
std::string fingerprint(const GoldenRun& run, const std::vector<std::string>& environment = {},
                        const std::string& program = LUKOU_PROGRAM);

}  // namespace lukou::test
