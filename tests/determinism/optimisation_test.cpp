#include <gtest/gtest.h>

#include <filesystem>

#include "tests/determinism/golden.hpp"

namespace lukou::test {
namespace {

TEST(Optimisation, BytesOfTheBuildWithoutOptimisationAreTheKnownOnes) {
  ASSERT_TRUE(std::filesystem::exists(LUKOU_DEBUG_PROGRAM))
      << LUKOU_DEBUG_PROGRAM << " is missing; build it with\n"
      << "  cmake --preset debug && cmake --build build-debug --target lukou\n(launch_scripts/test.sh --full does)";
  for (const GoldenRun& run : golden_runs()) {
    EXPECT_EQ(fingerprint(run, {}, LUKOU_DEBUG_PROGRAM), run.golden) << run.name;
  }
}

}  // namespace
}  // namespace lukou::test
